"""Zoom and pan, the linked panes, insets, replaced and missing pictures."""
import os

from support import ActionChains, Keys, PageTest, Picture


class Moving(PageTest):
    def view(self):
        return self.get("R.state.view")

    def test_zoom_by_buttons_and_keys(self):
        for selector, scale in (("#zoom-in", 2), ("#zoom-in", 4), ("#zoom-out", 2),
                                ("#zoom-fit", 1)):
            self.click(selector)
            self.assertAlmostEqual(scale, self.view()["scale"])
        self.keys("+")
        self.keys("+")
        self.keys("-")
        self.assertAlmostEqual(2, self.view()["scale"])
        self.assertEqual("2.0 ×", self.text("#zoom-text"))
        self.click("#zoom-one")
        self.assertEqual(1, self.view()["scale"], "a small picture is never smaller than its pane")
        self.keys("+", "r")
        self.assertEqual(1, self.view()["scale"])

    def test_wheel_zooms_at_the_cursor_once_clicked(self):
        place = self.place_of(40, 20)
        wheel = ("const c = document.querySelector('#view'), b = c.getBoundingClientRect();"
                 "const e = new WheelEvent('wheel', {deltaY: -480, cancelable: true, clientX:"
                 " b.left + arguments[0], clientY: b.top + arguments[1]});"
                 "c.dispatchEvent(e); return e.defaultPrevented")
        self.assertFalse(self.js(wheel, *place), "the page scrolls")
        self.pointer("#view", *place).click().perform()
        self.assertTrue(self.js(wheel, *place))
        self.assertAlmostEqual(4, self.view()["scale"], places=5)
        for before, after in zip(place, self.place_of(40, 20)):
            self.assertAlmostEqual(before, after, delta=4, msg="what is under the cursor stays")

    def test_down_to_single_pixels(self):
        self.js("pssmltReport.set({insets: [], a: 0, b: 0, split: 1});"
                "pssmltReport.setView(1000, 30.5 / 160, 60.5 / 90)")
        self.settle()
        self.assertGreater(self.get("R.geometry(R.mainPane(), R.viewedImage()).scale"), 90)
        reference, shot = Picture(self.folder, "0-reference"), self.screenshot("#view")
        for x in range(28, 33):
            x0, y0 = self.place_of(x, 60)
            for offset in (-35, 35):  # the whole square has the pixel's colour
                self.assert_colour(reference.display(x, 60),
                                   shot.getpixel((int(x0 + offset), int(y0 + 20))))

    def test_drag_and_arrows_pan(self):
        self.click("#zoom-in")
        self.click("#zoom-in")
        before = self.place_of(80, 45)
        self.pointer("#view", 250, 150).click_and_hold().move_by_offset(60, 40).release().perform()
        self.settle()
        after = self.place_of(80, 45)
        self.assertAlmostEqual(60, after[0] - before[0], delta=1.5)
        self.assertAlmostEqual(40, after[1] - before[1], delta=1.5)
        self.keys(Keys.ARROW_RIGHT, on="#view")
        self.assertLess(self.place_of(80, 45)[0], after[0])
        self.assertIn("pixel", self.text("#readout caption"))
        x = self.get("R.state.cursor.x")
        ActionChains(self.driver).key_down(Keys.SHIFT).send_keys(Keys.ARROW_LEFT) \
            .key_up(Keys.SHIFT).perform()
        self.assertEqual(x - 1, self.get("R.state.cursor.x"))

    def test_all_panes_share_the_view(self):
        self.js("pssmltReport.set({insets: []})")
        self.click("#mode-grid")
        self.assertEqual(4, len(self.all("#grid canvas")))
        self.pointer("#grid canvas:nth-child(2)", 100, 60).double_click().perform()
        self.settle()
        self.assertAlmostEqual(2, self.view()["scale"])
        x, y = self.get("[Math.floor(R.state.view.x * 160), Math.floor(R.state.view.y * 90)]")
        for i, name in enumerate(("0-0-5", "0-1-5", "0-2-5", "0-reference")):
            selector = f"#grid canvas:nth-child({i + 1})"
            self.assert_colour(Picture(self.folder, name).display(x, y),
                               self.colour(x, y, selector), name)
        self.keys("m")
        self.assertEqual("slider", self.get("R.state.mode"))

    def test_insets_lie_where_techniques_differ_and_lead_there(self):
        insets = self.get("R.state.insets")
        self.assertEqual(3, len(insets))
        # About the ring, whose centre is at (0.68, 0.74) of the picture, there is room for one.
        self.assertAlmostEqual(0.68 * 160, insets[0]["x"] + insets[0]["size"] / 2, delta=25)
        self.assertAlmostEqual(0.74 * 90, insets[0]["y"] + insets[0]["size"] / 2, delta=20)
        for i, a in enumerate(insets):
            for b in insets[:i]:
                self.assertGreater(max(abs(a["x"] - b["x"]), abs(a["y"] - b["y"])), a["size"])
        self.assertEqual(12, len(self.all(".inset")))
        shot = self.screenshot("tr:nth-child(1) .inset canvas")
        colours = shot.getcolors(100000)
        self.assertGreater(len(colours), 50, "noise has many colours")
        self.js("document.querySelector('.insets tr:nth-child(1) td:nth-child(3) button').click()")
        self.settle()
        self.assertEqual(2, self.get("R.state.a"))
        self.assertGreater(self.view()["scale"], 1.5)
        x, y = self.place_of(insets[0]["x"] + insets[0]["size"] // 2,
                             insets[0]["y"] + insets[0]["size"] // 2)
        size = self.find("#view").size
        self.assertTrue(0 < x < size["width"] and 0 < y < size["height"])
        before = self.screenshot("tr:nth-child(1) .inset canvas").tobytes()
        self.keys(Keys.HOME, on="#time")
        self.until("R.panesShown().every((n) => !R.shownImage(n).pending)")
        self.assertNotEqual(before, self.screenshot("tr:nth-child(1) .inset canvas").tobytes(),
                            "insets follow time")

    def test_data_and_pictures_are_replaced_at_run_time(self):
        self.click("#provenance summary")
        self.keys("+")
        self.js("const d = structuredClone(pssmltReport.data); d.partial = true;"
                "d.why_partial = 'still running'; d.techniques[0].name = 'renamed';"
                "d.scenes[0].techniques[0].name = 'renamed'; pssmltReport.update(d)")
        self.settle()
        self.assertIn("still running", self.text("#banners"))
        self.assertIn("renamed", self.text("#legend"))
        self.assertAlmostEqual(2, self.view()["scale"], msg="the view stays")
        self.assertEqual(3, len(self.get("R.state.insets")), "insets stay")
        self.assertIn("renamed", self.text("#insets"))
        self.assertTrue(self.get("document.querySelector('#provenance details').open"))
        self.js("pssmltReport.set({insets: [], a: 0, b: 0});")
        self.settle()
        self.driver.execute_async_script(  # a black picture: all codes 0
            "const done = arguments[0], n = 160 * 90 * 3, bytes = new Uint8Array(n);"
            "new Response(new Blob([bytes]).stream().pipeThrough(new CompressionStream('deflate')))"
            ".arrayBuffer().then((b) => pssmltReport.image({id: '0-reference', width: 160,"
            " height: 90, precision: 'logarithmic', low: 0, step: .1, clamped: 0, non_finite: 0,"
            " data: btoa(String.fromCharCode(...new Uint8Array(b)))})).then(done)")
        self.settle()
        self.assert_colour((0, 0, 0), self.colour(80, 45))


class Missing(PageTest):
    SETTINGS = ("width=64", "height=36", "snapshots=3", "runs=1")

    def test_a_missing_picture_is_said(self):
        os.rename(os.path.join(self.folder, "images", "0-1-0.js"),
                  os.path.join(self.folder, "images", "gone"))
        self.open()
        self.js("pssmltReport.set({a: 2, snapshot: 0})")
        self.until("R.shownImage(2).error")
        self.assertIn("missing", self.get("R.shownImage(2).error"))
        self.driver.get_log("browser")  # the browser itself reports the file
        self.keys("1")
        self.assertIsNone(self.get("R.shownImage(1).error"))
