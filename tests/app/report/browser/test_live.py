"""The page of a comparison that runs: `pssmlt compare --live` itself, on a room of 32 x 24 pixels."""
import os
import re
import signal
import subprocess
import tempfile
import time

from support import GENERATOR, WAIT, PageTest

ROOM = """Film "rgb" "integer xresolution" 32 "integer yresolution" 24
LookAt 0 -3 1  0 0 .8  0 0 1
Camera "perspective" "float fov" 50
Sampler "sobol"
Integrator "path" "integer maxdepth" 4
WorldBegin
AttributeBegin
Translate 0 0 2
AreaLightSource "diffuse" "rgb L" [ 6 5 4 ] "bool twosided" true
Shape "disk" "float radius" .7
AttributeEnd
Material "diffuse" "rgb reflectance" [ .6 .5 .4 ]
Shape "disk" "float radius" 5
"""


class Running(PageTest):
    """Starts a comparison that lasts until it is stopped."""
    ARGUMENTS = ()

    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="pssmlt-live-page-")
        self.addCleanup(temporary.cleanup)
        self.written = os.path.join(temporary.name, "report")
        self.said = os.path.join(temporary.name, "said")
        scene = os.path.join(temporary.name, "room.txt")
        with open(scene, "w", encoding="ascii") as file:
            file.write(ROOM)
        command = [os.path.join(os.path.dirname(GENERATOR), "pssmlt"), "compare", scene, "--live",
                   "--techniques", "path,bdpt", "--reference-techniques", "bdpt,path",
                   "--reference-time", "100ms", "--threads", "2", "-o", self.written,
                   *self.ARGUMENTS]
        environment = {**os.environ, "XDG_CACHE_HOME": os.path.join(temporary.name, "cache")}
        with open(self.said, "wb") as said:
            self.process = subprocess.Popen(command, stdout=said, stderr=said, env=environment)
        self.addCleanup(self.process.wait)
        self.addCleanup(self.process.kill)
        super().setUp()
        # Or the page would look for its server in other tests' consoles.
        self.addCleanup(self.driver.get, "about:blank")

    def url(self):
        end = time.time() + WAIT
        while time.time() < end:
            with open(self.said, encoding="utf-8") as file:
                found = re.search(r"http://127\.0\.0\.1:\d+/", file.read())
            if found:
                return found[0]
            time.sleep(0.02)
        self.fail("no address is printed")

    def open(self):
        self.driver.get(self.url())
        self.until("R.viewerOn && !document.querySelector('main').hidden")

    def errors(self, kind="mean"):
        """What the chart shows, by technique."""
        return self.get("R.chartOf(R.byId('chart')).data.datasets"
                        ".filter((d) => d.kind === %r).map((d) => d.data.map((p) => p.y))" % kind)

    def until_newer(self):
        version = self.get("R.live.version()")
        self.until(f"R.live.version() > {version}")

    def until_over(self):
        self.until("R.live.closed()")
        self.assertEqual(130, self.process.wait(60))

    def picture(self):
        """The bytes of the left pane's pixels."""
        self.until("R.panesShown().every((n) => !R.shownImage(n).pending)")
        return self.get("(() => { const c = R.byId('view'); return c.toDataURL() })()")


class FirstRun(Running):
    ARGUMENTS = ("--time", "40s", "--snapshots", "20", "--runs", "1000")

    def test_curves_and_pictures_grow_and_the_button_stops(self):
        self.until("R.snapshotTimes().length > 1 && R.shownImage(1).image")
        self.until("R.chartOf(R.byId('chart')).data.datasets.some((d) => d.kind === 'mean' &&"
                   " d.data.length)")
        curves, picture = self.errors(), self.picture()
        times = self.get("R.snapshotTimes().length")
        self.until(f"R.snapshotTimes().length > {times + 1}")
        self.assertGreater(sum(map(len, self.errors())), sum(map(len, curves)))
        self.assertNotEqual(picture, self.picture(), "without a choice the newest one is shown")
        self.assertIn("run 1 of 1000", self.text("#live-state"))
        self.assertIn("bdpt: ", self.text("#live-numbers"))
        self.assertIn("relMSE", self.text("#live-numbers"))
        self.assertIn("still running", self.text("#banners"))

        chosen = {"snapshot": 0, "exposure": 1.5, "mode": "flip", "show": "relative", "a": 2,
                  "metric": "smape", "view": {"scale": 2, "x": 0.4, "y": 0.5}}
        self.js("pssmltReport.set(arguments[0])", chosen)
        self.until_newer()
        self.until_newer()
        self.assertEqual(chosen, {key: self.get(f"R.state.{key}") for key in chosen})
        self.assertEqual("smape", self.find("#metric").get_attribute("value"))

        self.js("R = pssmltReport; R.set({snapshot: Infinity, mode: 'slider', show: 'picture'})")
        self.find("#live-stop").click()
        self.assertTrue(self.find("#live-confirm").is_displayed())
        self.find("#live-no").click()
        self.assertFalse(self.find("#live-confirm").is_displayed())
        self.assertIsNone(self.process.poll())
        self.find("#live-stop").click()
        self.find("#live-yes").click()
        self.until_over()
        self.assertIn("Stopped; the report is in", self.text("#live-state"))
        self.assertFalse(self.find("#live-stop").is_enabled())
        self.assertIn("interrupted in scene 1 of 1", self.text("#banners"))

        # A plain report from here on: the server is gone, the pictures are here.
        self.assertEqual("exact", self.get("R.lastSnapshot(1).precision"))
        self.until("R.shownImage(1).image?.precision === 'exact'")
        for technique in ("1", "2"):
            for snapshot in range(self.get("R.snapshotTimes().length")):
                self.js("pssmltReport.set({a: Number(arguments[0]), snapshot: arguments[1]})",
                        technique, snapshot)
                self.settle()
                self.assertIsNone(self.get("R.shownImage(R.state.a).error"))
        self.choose("#metric", "relMSE")
        self.assertTrue(all(self.errors()))


class LaterRuns(Running):
    ARGUMENTS = ("--time", "300ms", "--runs", "10000")

    def test_a_picture_that_is_written_anew_is_loaded_anew(self):
        self.until("R.scene().techniques[0].runs.length > 1")
        self.js("pssmltReport.set({mode: 'flip', a: 1, insets: []})")
        before = self.picture()
        one, other = self.get("[1, 2].map((n) => R.lastSnapshot(n).image)")
        files = [os.path.join(self.written, "images", name + ".js") for name in (one, other)]
        with open(files[1], encoding="ascii") as file:
            text = file.read()
        with open(files[0], "w", encoding="ascii") as file:
            file.write(text.replace(other, one))
        self.js("const R = pssmltReport; R.forget(arguments[0]); R.update(R.data)", one)
        self.until("!R.shownImage(1).pending")
        self.assertNotEqual(before, self.picture())
        self.process.send_signal(signal.SIGINT)
        self.until_over()

    def test_two_pages_follow_all_runs(self):
        first = self.driver.current_window_handle
        self.driver.switch_to.new_window("window")
        self.addCleanup(self.driver.switch_to.window, first)
        self.addCleanup(self.driver.close)
        self.open()
        for page in (self.driver.current_window_handle, first):
            self.driver.switch_to.window(page)
            self.until("R.scene().techniques[0].runs.length > 2")
            self.assertTrue(all(self.errors()))
            self.assertRegex(self.text("#chart-caption"), r"Mean of \d+ runs; bands")
            self.until("R.chartOf(R.byId('chart')).data.datasets.some((d) =>"
                       " d.kind === 'running' && d.data.length)")
        self.process.send_signal(signal.SIGINT)
        self.until_over()
        self.assertIn("Stopped; the report is in", self.text("#live-state"))
        self.assertEqual([], self.errors("running"))
        self.driver.switch_to.window(self.driver.window_handles[-1])
        self.until("R.live.closed()")
