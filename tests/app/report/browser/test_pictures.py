"""Every control of the pictures, held against the images decoded in support.py."""
from support import ActionChains, Keys, PageTest, Picture

# Of 160 x 90: away from insets' outlines; the second is in A's half, the third in B's.
LEFT, RIGHT = (30, 60), (150, 80)


class Pictures(PageTest):
    def setUp(self):
        super().setUp()
        self.js("pssmltReport.set({insets: []})")  # their outlines are in the way of colours

    def picture(self, technique, snapshot=5):
        return Picture(self.folder, f"0-{technique}-{snapshot}")

    reference = property(lambda self: Picture(self.folder, "0-reference"))

    def test_slider_shows_a_left_and_b_right(self):
        self.assertEqual([1, 3], self.get("[R.state.a, R.state.b]"))
        shot = self.screenshot("#view")
        self.assert_colour(self.picture(0).display(*LEFT), self.colour(*LEFT, shot=shot))
        self.assert_colour(self.picture(2).display(*RIGHT), self.colour(*RIGHT, shot=shot))

    def test_all_values_are_those_of_the_file(self):
        for name in ("0-0-5", "0-1-2"):
            picture = Picture(self.folder, name)
            found = self.driver.execute_async_script(
                "pssmltReport.loadImage(arguments[0]).then((i) => arguments[1]("
                "  Array.from(i.codes.subarray(0, 3000), (c) => i.values[c])))", name)
            expected = [v for i in range(1000) for v in picture.value(i % 160, i // 160)]
            for e, f in zip(expected, found):
                self.assertTrue((f is None and e != e) or abs(e - f) <= 1e-6 * abs(e))

    def test_digits_flip_techniques(self):
        self.click("#mode-flip")
        for key, picture in ((2, self.picture(1)), (3, self.picture(2)), (1, self.picture(0)),
                             (0, self.reference)):
            self.keys(str(key))
            self.assertEqual(key, self.get("R.state.a"))
            shot = self.screenshot("#view")
            for place in (LEFT, RIGHT):
                self.assert_colour(picture.display(*place), self.colour(*place, shot=shot), key)
        self.keys("7")
        self.assertEqual(0, self.get("R.state.a"), "there is no seventh technique")

    def test_shift_digit_space_and_selects(self):
        ActionChains(self.driver).key_down(Keys.SHIFT).send_keys("2").key_up(Keys.SHIFT).perform()
        self.assertEqual([1, 2], self.get("[R.state.a, R.state.b]"))
        self.keys(" ")
        self.assertEqual([2, 1], self.get("[R.state.a, R.state.b]"))
        self.click("#swap")
        self.choose("#a", "0 reference")
        self.choose("#b", "1 path")
        shot = self.screenshot("#view")
        self.assert_colour(self.reference.display(*LEFT), self.colour(*LEFT, shot=shot))
        self.assert_colour(self.picture(0).display(*RIGHT), self.colour(*RIGHT, shot=shot))

    def test_split_is_dragged_and_set(self):
        x = self.find("#view").size["width"]
        self.pointer("#view", x / 2, 200).click_and_hold().move_by_offset(-round(x * 0.4), 0) \
            .release().perform()
        self.settle()
        self.assertAlmostEqual(0.1, self.get("R.state.split"), delta=0.02)
        self.assertEqual(1, self.get("R.state.view.scale"))
        self.assert_colour(self.picture(2).display(*LEFT), self.colour(*LEFT))
        self.keys(Keys.END, on="#split")
        self.assertEqual("100 %", self.text("#split-text"))
        self.assert_colour(self.picture(0).display(*RIGHT), self.colour(*RIGHT))
        self.click("#split-reset")
        self.assertEqual(0.5, self.get("R.state.split"))

    def test_exposure_works_on_the_float_data(self):
        self.choose("#a", "0 reference")
        lamp = (120, 11)  # 12 or so, far beyond white
        self.keys(Keys.ARROW_LEFT * 16, on="#exposure")
        self.assertEqual("−4 stops", self.text("#exposure-text"))
        self.choose("#b", "0 reference")
        shot = self.screenshot("#view")
        for place in (LEFT, lamp):
            self.assert_colour(self.reference.display(*place, stops=-4),
                               self.colour(*place, shot=shot))
        self.assertLess(self.reference.display(*lamp, stops=-4)[2], 255)
        self.keys("e")
        self.assertEqual(-3.5, self.get("R.state.exposure"))
        self.keys("d")
        self.click("#exposure-reset")
        self.assertEqual(0, self.get("R.state.exposure"))

    def test_time_shows_earlier_snapshots_marked_as_8_bit(self):
        self.keys(Keys.HOME, on="#time")
        self.assertEqual(0, self.get("R.snapshotIndex()"))
        self.assertIn("8 bit", self.text("#time-text"))
        self.assertRegex(self.text("#marks"), "path: 8-bit logarithmic snapshot, values ±")
        shot = self.screenshot("#view")
        self.assert_colour(self.picture(0, 0).display(*LEFT), self.colour(*LEFT, shot=shot))
        self.assert_colour(self.picture(2, 0).display(*RIGHT), self.colour(*RIGHT, shot=shot))
        self.keys("]")
        self.assertEqual(1, self.get("R.snapshotIndex()"))
        self.assert_colour(self.picture(0, 1).display(*LEFT), self.colour(*LEFT))
        self.keys("[")
        self.assertEqual(0, self.get("R.snapshotIndex()"))

    def test_play_runs_to_the_end(self):
        self.click("#play")
        self.assertEqual("Stop", self.text("#play"))
        self.until("R.snapshotIndex() === 5 && !R.playing")
        self.assertEqual("Play", self.text("#play"))

    def test_insets_are_outlined_on_request(self):
        self.js("pssmltReport.set({insets: [{x: 40, y: 50, size: 20}], split: 1})")
        outlined = self.screenshot("#view").tobytes()
        self.keys("i")
        self.assertNotEqual(outlined, self.screenshot("#view").tobytes())
        self.click("#frames")
        self.assertEqual(outlined, self.screenshot("#view").tobytes())

    def test_error_maps(self):
        self.choose("#a", "1 path")
        self.choose("#b", "1 path")
        picture, reference = self.picture(0), self.reference
        mean = sum(reference.luminance(x, y) for x in range(160) for y in range(90)) / 14400
        places = [(x, y) for x in range(96, 122, 5) for y in (58, 63, 70, 75)]
        self.choose("#show", "signed error")
        shot = self.screenshot("#view")
        signs = 0
        for x, y in places:
            error = picture.luminance(x, y) - reference.luminance(x, y)
            if 0.05 < abs(error):
                r, _, b = self.colour(x, y, shot=shot)
                self.assertEqual(error > 0, r > b, (x, y, error))
                signs += 1
        self.assertGreater(signs, 5)
        self.assertIn("luminance − reference", self.text("#scale"))
        for show in ("absolute", "relative"):
            self.choose("#show", show + " error")
            shot = self.screenshot("#view")
            measured = []
            for x, y in places:
                error = abs(picture.luminance(x, y) - reference.luminance(x, y))
                if show == "relative":
                    error /= reference.luminance(x, y) + 0.01 * mean
                measured.append((min(error, 1.0), self.colour(x, y, shot=shot)[1]))
            # Viridis: green grows all the way.
            measured.sort()
            for (e0, g0), (e1, g1) in zip(measured, measured[1:]):
                self.assertLessEqual(g0, g1 + 2, (show, e0, e1))
            self.assertGreater(measured[-1][1], measured[0][1] + 20)
        self.keys("s")
        self.assertEqual("picture", self.get("R.state.show"))
        self.assertFalse(self.find("#scale").is_displayed())

    def test_values_under_the_cursor(self):
        for x, y in (LEFT, (0, 0)):
            self.pointer("#view", *self.place_of(x, y)).perform()
            self.settle()
            readout = self.text("#readout")
            self.assertIn(f"pixel {x}, {y}", readout)
            value = self.get("R.number(%r, 4)" % self.reference.value(x, y)[1])
            self.assertIn(value, readout)
        self.assertIn("unknown", readout, "the pixel of path that is not a number")
        self.assertRegex(self.text("#marks"), "path: 1 value not finite")
        self.assert_colour((255, 0, 255), self.colour(0, 0))
