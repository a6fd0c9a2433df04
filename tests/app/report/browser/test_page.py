"""Charts, tables, texts, keyboard, themes and sizes."""
from support import ActionChains, By, Keys, PageTest


class Page(PageTest):
    def chart(self, kind="mean"):
        return self.get("R.chartOf(R.byId('chart')).data.datasets.filter((d) => d.kind === %r)"
                        ".map((d) => d.data.map((p) => [p.x, p.y]))" % kind)

    def test_first_paint(self):
        paint = self.get("performance.getEntriesByType('paint').map((e) => [e.name, e.startTime])")
        print("\n  paint, ms:", {name: round(t) for name, t in paint})
        self.assertTrue(paint)
        self.assertIn("bdpt has the lowest error", self.text("#headline"))
        self.assertIn("door-ajar", self.driver.title)

    def test_metric_changes_chart_and_tables(self):
        before, table = self.chart(), self.text("#tables")
        self.choose("#metric", "HDR-FLIP")
        self.assertNotEqual(before, self.chart())
        data = self.get("R.data.scenes[0].techniques[0].curve.flip.mean")
        self.assertEqual(data, [p[1] for p in self.chart()[0]])
        self.assertEqual("HDR-FLIP", self.get("R.chartOf(R.byId('chart')).scales.y.options.title.text"))
        self.assertIn("HDR-FLIP after 59.5 s", self.text("#tables"))
        self.assertNotEqual(table, self.text("#tables"))

    def test_axes_are_logarithmic_and_curves_are_painted(self):
        self.assertEqual(["logarithmic", "logarithmic"], self.get(
            "['x', 'y'].map((a) => R.chartOf(R.byId('chart')).scales[a].type)"))
        shot = self.screenshot("#chart")
        colours = {colour for _, colour in shot.getcolors(1000000)}
        for i in range(3):
            wanted = self.get(f"R.look({i}).colour")
            self.assertIn(tuple(int(wanted[k:k + 2], 16) for k in (1, 3, 5)), colours)

    def test_what_the_chart_shows_is_chosen(self):
        self.assertEqual([2, 0, 1, 1], [len(self.chart("low")[0]) // 3, len(self.chart("fit")),
                                        len(self.chart("floor")), len(self.chart("guide"))])
        self.click("#bands")
        self.click("#fits")
        self.click("#guide")
        self.assertEqual([], self.chart("low")[0])
        self.assertEqual([3, 0], [len(self.chart("fit")), len(self.chart("guide"))])
        self.click("#legend button:nth-child(2)")
        self.assertEqual(2, len(self.chart()))
        self.assertEqual("false", self.find("#legend button:nth-child(2)").get_attribute("aria-pressed"))
        self.keys(Keys.ENTER, on="#legend button:nth-child(2)")
        self.assertEqual(3, len(self.chart()))

    def test_points_near_the_floor_are_hollow(self):
        fills = self.get("R.chartOf(R.byId('chart')).data.datasets.filter((d) => d.kind === 'mean')"
                         ".map((d) => d.data.map((p, i) => [p.near, d.pointBackgroundColor[i]]))")
        page = self.get("R.css('--page')")
        flat = [p for technique in fills for p in technique]
        self.assertTrue(any(near for near, _ in flat))
        for near, fill in flat:
            self.assertEqual(near, fill == page)
        self.assertIn("Dotted line: the reference’s own error", self.text("#chart-caption"))

    def test_hover_and_keys_tell_values(self):
        x, y = self.get("(({x, y}) => [x, y])(R.chartOf(R.byId('chart')).getDatasetMeta(2).data[3])")
        self.pointer("#chart", x, y).perform()
        self.until("R.chartOf(R.byId('chart')).tooltip.opacity > 0")
        body = self.get("R.chartOf(R.byId('chart')).tooltip.body[0].lines[0]")
        value = self.get("R.number(R.data.scenes[0].techniques[0].curve.relmse.mean[3])")
        self.assertTrue(body.startswith(f"path: {value} ["), body)
        self.keys(Keys.ARROW_RIGHT, on="#chart")
        first = self.find("#chart-spoken").get_attribute("textContent")
        self.assertTrue(first.startswith("path: "), first)
        self.press(Keys.ARROW_DOWN)
        self.assertTrue(self.find("#chart-spoken").get_attribute("textContent").startswith("bdpt: "))

    def test_tables_hold_what_the_data_hold(self):
        text = self.text("#numbers")
        for expected in ("speed-up", "not reached", "has not mixed", "steeper", "1.20 M", "no chains",
                         "relative MSE after 59.5 s", "≤ ", "near the reference’s own error",
                         "dropped samples", "2.86 MiB",
                         "large 0.21, small 0.58", "488 MiB", "relative error 0.002", "bias of the mean"):
            self.assertIn(expected, text)
        self.assertRegex(self.text("#calibration-table"),
                         r"mlt\s+0\.700 \[0\.600, 1\.20\]\s+agrees within its interval")
        self.click("#curves details summary")
        self.assertEqual(18, len(self.all("#curve-table tbody tr")))
        details = self.text("#details")
        for expected in ("An invented processor", "Embree 3.13.5", "made by bdpt, mlt", "seed 0"):
            self.assertIn(expected, details)
        self.click("#provenance details:nth-of-type(2) summary")
        self.assertIn("largestepprobability", self.text("#provenance details:nth-of-type(2)"))

    # Of 15 points of a technique those near the reference's own error have no true error.
    def test_calibration_chart_has_every_known_estimate_away_from_the_floor(self):
        away = self.get("R.results().map(([, t]) => t.runs.flatMap((r) => r.points).filter((p) =>"
                        " p.estimate.known"
                        " && p.metrics.relmse > 4 * R.scene().reference.floor.relmse).length)")
        points = self.get("R.chartOf(R.byId('calibration-chart')).data.datasets"
                          ".filter((d) => d.kind === 'mean').map((d) => d.data.length)")
        self.assertEqual(away, points)
        self.assertEqual([15, 6, 6], points)

    def test_the_command_is_copied(self):
        self.assertTrue(self.text("#command").startswith("pssmlt compare"))
        self.click("#copy")
        self.until("/Copied/.test(R.byId('copy').textContent)")

    def test_help_lists_the_keys(self):
        self.keys("?")
        self.assertTrue(self.find("#help").is_displayed())
        for key in ("1 … 9", "Space", "Wheel", "[ or ,"):
            self.assertIn(key, self.text("#help-text"))
        self.press(Keys.ESCAPE)
        self.assertFalse(self.find("#help").is_displayed())
        self.click("#help-open")
        self.click("#help form button")
        self.assertFalse(self.find("#help").is_displayed())

    def test_dark_and_light(self):
        background = "getComputedStyle(document.body).backgroundColor"
        self.addCleanup(self.js, "try { localStorage.clear() } catch {}")
        light = self.get(background)
        grid = self.get("R.chartOf(R.byId('chart')).options.scales.x.grid.color")
        self.click("#theme")
        self.assertNotEqual(light, self.get(background))
        self.assertNotEqual(grid, self.get("R.chartOf(R.byId('chart')).options.scales.x.grid.color"))
        self.assertEqual("true", self.find("#theme").get_attribute("aria-pressed"))
        self.keys("t")
        self.assertEqual(light, self.get(background))
        self.js("try { localStorage.clear() } catch {}")
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": "dark"}]})
        self.driver.refresh()
        self.assertNotEqual(light, self.get(background), "the system's choice")
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {"features": []})

    def test_contrast_of_the_techniques_colours(self):
        def luminance(hexadecimal):
            parts = [int(hexadecimal[i:i + 2], 16) / 255 for i in (1, 3, 5)]
            linear = [p / 12.92 if p <= 0.04045 else ((p + 0.055) / 1.055) ** 2.4 for p in parts]
            return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]
        for theme in ("light", "dark"):
            self.js("document.documentElement.dataset.theme = arguments[0]", theme)
            page = luminance(self.get("R.css('--page')"))
            for name in ["--text", "--faint"] + [f"--t{i}" for i in range(1, 9)]:
                light, dark = sorted((luminance(self.get(f"R.css('{name}')")), page), reverse=True)
                self.assertGreaterEqual((light + 0.05) / (dark + 0.05),
                                        4.5 if name in ("--text", "--faint") else 3, (theme, name))
        looks = self.get("[...Array(8).keys()].map((i) => R.look(i).dash + R.look(i).marker)")
        self.assertEqual(8, len(set(looks)), "told apart without colour")

    def test_keyboard_reaches_everything_and_focus_is_seen(self):
        unnamed = self.get("[...document.querySelectorAll('button, input, select')].filter((e) =>"
                           "!(e.textContent.trim() || e.getAttribute('aria-label') || e.labels?.length))"
                           ".map((e) => e.outerHTML)")
        self.assertEqual([], unnamed)
        seen, unseen = [], []
        self.js("document.activeElement.blur()")
        for _ in range(60):
            ActionChains(self.driver).send_keys(Keys.TAB).perform()
            seen.append(self.get("document.activeElement.id"))
            unseen += self.get("[document.activeElement].filter((e) => e !== document.body &&"
                               "getComputedStyle(e).outlineStyle === 'none').map((e) => e.outerHTML)")
        for wanted in ("theme", "help-open", "metric", "bands", "chart", "a", "b", "show", "view",
                       "time", "exposure", "split", "zoom-in", "play", "mode-flip"):
            self.assertIn(wanted, seen)
        self.assertEqual([], unseen)


class Suite(PageTest):
    SETTINGS = ("width=64", "height=36", "snapshots=3", "techniques=4", "scenes=3", "partial=1",
                "biased=1", "gaps=1")

    def test_warnings_stand_first(self):
        banners = self.text("#banners")
        self.assertIn("Partial results. Interrupted after 2 of 3 runs.", banners)
        self.assertIn("glass-caustics: bdpt and mlt disagree by 2.1 % in the upper right", banners)
        self.assertIn("chains <hardly> move", banners)
        self.assertIn("media contradict", banners)
        self.assertLess(self.find("#banners").location["y"], self.find("#curves").location["y"])

    def test_scenes_as_small_charts_lead_to_the_scene(self):
        self.assertEqual(3, len(self.all("#multiples canvas")))
        self.click("#multiples figure:nth-child(2) button")
        self.assertEqual(1, self.get("R.state.scene"))
        self.assertEqual("1", self.find("#scene").get_property("value"))
        self.assertTrue(self.get("R.shownImage(1).image.id").startswith("1-0-"))
        self.assertIn("All scenes", self.text("#tables"))
        self.choose("#scene", "bidir-room")
        self.assertIn("bidir-room", self.text("#details"))

    def test_missing_numbers_are_said(self):
        self.assertIn("unknown", self.text("#tables"))
        self.assertNotRegex(self.text("main"), "NaN|undefined|null")
        self.assertIn("The reference’s own error is unknown", self.text("#chart-caption"))

    def test_nothing_is_wider_than_the_window(self):
        for width in (360, 768, 1280, 3840):
            self.resize(width, 900)
            self.settle()
            self.assertLessEqual(self.get("document.documentElement.scrollWidth"), width)
            for mode in ("grid", "slider"):
                self.click(f"#mode-{mode}")
                self.assertLessEqual(self.get("document.documentElement.scrollWidth"), width)
        small, large = 15, self.get("R.textSize()")
        self.assertGreater(large, 1.5 * small, "readable on 4k")


class Hostile(PageTest):
    SETTINGS = ("width=64", "height=36", "snapshots=3", "hostile=1", "scenes=2")

    def test_names_are_text(self):
        self.click("#mode-grid")
        self.assertIsNone(self.get("window.hostile"))
        self.assertIn("<script>window.hostile = 1</script>", self.text("#legend"))
        self.assertIn("</script><script>window.hostile = 3</script>", self.text("#title") +
                      self.text("#multiples"))
        self.assertEqual([], self.driver.find_elements(By.CSS_SELECTOR, "main img, main script"))


class Bare(PageTest):
    SETTINGS = ("width=64", "height=36", "snapshots=1", "techniques=1", "bare=1")

    def test_pictures_without_anything_else(self):
        self.assertEqual("flip", self.get("R.state.mode"))
        self.assertEqual("0-0-0", self.get("R.shownImage(1).image.id"))
        self.assertIn("Without a reference", self.text("#insets-note"))
        self.assertFalse(self.find("#calibration").is_displayed())
        self.assertNotRegex(self.text("main"), "NaN|undefined|null")


class Empty(PageTest):
    SETTINGS = ("techniques=0", "scenes=0")

    def test_a_page_without_data_stands(self):
        self.assertEqual("No error is known yet.", self.text("#headline"))
