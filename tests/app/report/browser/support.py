"""A browser on invented reports, and what the tests ask of it. Debian's chromium, chromium-driver,
python3-selenium and python3-pil."""
import base64
import io
import os
import re
import struct
import subprocess
import tempfile
import time
import unittest
import zlib

import json
import shutil

from PIL import Image
from selenium import webdriver
from selenium.webdriver.chrome.options import Options
from selenium.webdriver.chrome.service import Service
from selenium.webdriver.common.action_chains import ActionChains
from selenium.webdriver.common.by import By
from selenium.webdriver.common.keys import Keys
from selenium.webdriver.support.ui import Select

GENERATOR = os.environ["PSSMLT_SAMPLE_REPORT"]
WAIT = 20.0  # seconds; nothing is asserted about how fast things are


class Shared:
    """One browser and one folder for all tests."""
    driver = None
    folder = None
    reports = {}


def start():
    options = Options()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--hide-scrollbars",
                     "--force-device-scale-factor=1", "--window-size=1280,1000"):
        options.add_argument(argument)
    options.binary_location = shutil.which("chromium")
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    Shared.driver = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
    Shared.folder = tempfile.TemporaryDirectory(prefix="pssmlt-page-")


def stop():
    Shared.driver.quit()
    Shared.folder.cleanup()


def report(*settings):
    """The folder of an invented report, made once."""
    if settings not in Shared.reports:
        path = os.path.join(Shared.folder.name, str(len(Shared.reports)))
        subprocess.run([GENERATOR, path, *settings], check=True)
        Shared.reports[settings] = path
    return Shared.reports[settings]


def half(bits):
    return struct.unpack("<e", struct.pack("<H", bits))[0]


class Picture:
    """A packed image, decoded here on its own: value(x, y) is (r, g, b)."""

    def __init__(self, folder, name):
        with open(os.path.join(folder, "images", name + ".js"), encoding="ascii") as file:
            self.head = json.loads(re.fullmatch(r"pssmltReport\.image\((.*)\);\n", file.read())[1])
        self.width, self.height = self.head["width"], self.head["height"]
        self.bytes = zlib.decompress(base64.b64decode(self.head["data"]))
        self.exact = self.head["precision"] == "exact"

    def value(self, x, y):
        pixels, i = self.width * self.height, y * self.width + x
        if self.exact:
            g, r, b = (self.bytes[2 * c * pixels + i] | self.bytes[(2 * c + 1) * pixels + i] << 8
                       for c in range(3))
            codes = ((r + g) % 65536, g, (b + g) % 65536)
            return tuple(half(c) * 2.0 ** -self.head["exponent"] for c in codes)
        g, r, b = (self.bytes[c * pixels + i] for c in range(3))
        return tuple(0.0 if c == 0 else 2.0 ** (self.head["low"] + (c - 1) * self.head["step"])
                     for c in ((r + g) % 256, g, (b + g) % 256))

    def luminance(self, x, y):
        r, g, b = self.value(x, y)
        return 0.2126 * r + 0.7152 * g + 0.0722 * b

    def display(self, x, y, stops=0.0):
        def encode(v):
            v *= 2.0 ** stops
            v = 12.92 * v if v <= 0.0031308 else 1.055 * min(v, 1.0) ** (1 / 2.4) - 0.055
            return round(255 * min(max(v, 0.0), 1.0))
        return tuple(encode(v) for v in self.value(x, y))


class PageTest(unittest.TestCase):
    """Opens SETTINGS' report before each test and looks at the console after it."""
    SETTINGS = ("width=160", "height=90", "snapshots=6")
    SIZE = (1280, 1000)
    maxDiff = None

    def setUp(self):
        self.driver = Shared.driver
        self.folder = report(*self.SETTINGS)
        self.resize(*self.SIZE)
        self.open()

    def tearDown(self):
        errors = [e for e in self.driver.get_log("browser") if e["level"] in ("SEVERE", "WARNING")]
        self.assertEqual([], errors, "the console has errors")

    def open(self):
        self.driver.get("file://" + os.path.join(self.folder, "index.html"))
        self.until("pssmltReport.viewerOn")
        self.settle()

    def resize(self, width, height):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "deviceScaleFactor": 1, "mobile": False})

    def js(self, script, *arguments):
        return self.driver.execute_script(script, *arguments)

    def get(self, expression):
        return self.js("const R = window.pssmltReport; return " + expression)

    def until(self, expression):
        end = time.time() + WAIT
        while not self.get(expression):
            if time.time() > end:
                self.fail("never true: " + expression)
            time.sleep(0.02)

    def settle(self):
        """Pictures that are seen have been loaded and drawn."""
        self.until("R.panesShown().every((n) => !R.shownImage(n).pending)")
        self.until("!R.snapshot(0) || !/Looking/.test(R.byId('insets-note').textContent)")
        self.driver.execute_async_script(
            "requestAnimationFrame(() => requestAnimationFrame(arguments[0]))")

    def find(self, selector):
        return self.driver.find_element(By.CSS_SELECTOR, selector)

    def all(self, selector):
        return self.driver.find_elements(By.CSS_SELECTOR, selector)

    def text(self, selector):
        return self.find(selector).text

    def choose(self, selector, text):
        Select(self.find(selector)).select_by_visible_text(text)
        self.settle()

    def click(self, selector):
        element = self.find(selector)
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        element.click()
        self.settle()

    def keys(self, *keys, on="body"):
        self.find(on).send_keys(*keys)
        self.settle()

    def press(self, key):
        """To whatever has the focus."""
        ActionChains(self.driver).send_keys(key).perform()
        self.settle()

    def screenshot(self, selector):
        element = self.find(selector)
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        self.settle()
        return Image.open(io.BytesIO(element.screenshot_as_png)).convert("RGB")

    def place_of(self, x, y, selector="#view"):
        """CSS pixels, from the canvas' corner, of the middle of a picture's pixel."""
        return self.js("const c = document.querySelector(arguments[0]), R = pssmltReport;"
                       "const g = R.geometry(c, R.viewedImage());"
                       "return [g.x + (arguments[1] + .5) * g.scale,"
                       "        g.y + (arguments[2] + .5) * g.scale]", selector, x, y)

    def colour(self, x, y, selector="#view", shot=None):
        place = self.place_of(x, y, selector)
        return (shot or self.screenshot(selector)).getpixel((int(place[0]), int(place[1])))

    def pointer(self, selector, x, y):
        """The pointer at (x, y) from the element's left upper corner."""
        element = self.find(selector)
        self.js("arguments[0].scrollIntoView({block: 'center'})", element)
        size = element.size
        return ActionChains(self.driver).move_to_element_with_offset(
            element, round(x - size["width"] / 2), round(y - size["height"] / 2))

    def assert_colour(self, expected, found, what=""):
        self.assertTrue(all(abs(a - b) <= 2 for a, b in zip(expected, found)),
                        f"{what}: expected {expected}, found {found}")
