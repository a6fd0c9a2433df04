#!/usr/bin/python3
"""page_in_browser.py URL [SCREENSHOT]: uses every control of the live page in headless Chromium.

The render has to run until it is stopped. Exit code 0: all is as it should be; 1: the first thing
that is not; 77: there is no browser to test with.
"""
import sys
import time

try:
    from selenium import webdriver
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
    from selenium.common.exceptions import WebDriverException
except ImportError:
    print("python3-selenium is not installed")
    sys.exit(77)


def start_browser():
    options = webdriver.ChromeOptions()
    for argument in ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--window-size=1200,900"):
        options.add_argument(argument)
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    return webdriver.Chrome(options=options)


class Page:
    def __init__(self, browser):
        self.browser = browser

    def find(self, name):
        return self.browser.find_element(By.ID, name)

    def text(self, name):
        return self.find(name).text

    def script(self, code):
        return self.browser.execute_script("return " + code)

    def wait(self, what, condition, seconds=60):
        """Waits until condition() holds; a timeout is a failure that says `what`."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return
            time.sleep(0.05)
        raise AssertionError(f"not within {seconds} s: {what}; state: {self.text('state')}")

    def mean(self):
        """Mean byte of the picture as it is shown."""
        return self.script("(() => { const c = document.getElementById('picture'), d = "
                           "c.getContext('2d').getImageData(0, 0, c.width, c.height).data;"
                           "let s = 0; for (let i = 0; i < d.length; i += 4) s += d[i] + d[i+1] + d[i+2];"
                           "return s / (0.75 * d.length); })()")


def check_numbers(page):
    page.wait("a picture", lambda: page.script("view.version") > 0)
    page.wait("numbers", lambda: "elapsed" in page.text("numbers"))
    page.wait("an error estimate", lambda: page.text("error").startswith("relMSE"))
    page.wait("acceptance rates", lambda: "acceptance" in page.text("layers"))
    assert page.text("state") == "rendering", page.text("state")
    assert 0 < page.mean() < 255
    version = page.script("view.version")
    page.wait("a newer picture", lambda: page.script("view.version") > version)
    errors = page.script("view.errors.length")
    page.wait("a newer error", lambda: page.script("view.errors.length") > errors)


def check_exposure(page):
    page.find("picture").click()
    before = page.mean()
    ActionChains(page.browser).send_keys("eeee").perform()
    assert page.text("stops") == "2.0", page.text("stops")
    assert page.mean() > before * 1.2, "brighter by the key"
    ActionChains(page.browser).send_keys("dddddd").perform()
    assert page.text("stops") == "-1.0" and page.mean() < before
    ActionChains(page.browser).send_keys("0").perform()
    assert page.text("stops") == "0.0"
    slider = page.find("exposure")
    slider.send_keys(Keys.ARROW_RIGHT)
    assert page.text("stops") == "0.1", page.text("stops")
    page.find("picture").click()
    ActionChains(page.browser).send_keys("0").perform()


def check_cross(page):
    page.find("picture").click()
    x, y = page.script("view.cross.x"), page.script("view.cross.y")
    page.find("picture").send_keys(Keys.ARROW_RIGHT, Keys.ARROW_DOWN)
    assert [page.script("view.cross.x"), page.script("view.cross.y")] == [x + 1, y + 1]
    page.find("picture").send_keys(Keys.SHIFT + Keys.ARROW_LEFT)
    assert page.script("view.cross.x") == max(x + 1 - 10, 0)
    assert page.text("pixel").startswith(f"{max(x - 9, 0)}, {y + 1}:") and "R " in page.text("pixel")


def check_looks(page):
    width = page.script("document.getElementById('picture').clientWidth")
    page.find("zoom").click()
    assert page.script("document.getElementById('picture').clientWidth") == page.script("view.width")
    assert page.find("zoom").get_attribute("aria-pressed") == "true"
    page.find("zoom").click()
    assert page.script("document.getElementById('picture').clientWidth") == width
    ground = "getComputedStyle(document.body).backgroundColor"
    before = page.script(ground)
    page.find("theme").click()
    assert page.script(ground) != before, "theme"
    page.find("picture").click()
    ActionChains(page.browser).send_keys("t").perform()
    assert page.script(ground) == before, "theme by key"
    page.browser.set_window_size(360, 800)
    overflow = page.script("document.documentElement.scrollWidth - innerWidth")
    assert overflow <= 0, f"{overflow} pixels too wide"
    page.browser.set_window_size(1200, 900)


def check_stop(page):
    ActionChains(page.browser).send_keys("s").perform()
    assert page.find("confirm").is_displayed()
    page.find("no").click()
    assert not page.find("confirm").is_displayed() and page.find("stop").is_enabled()
    page.find("stop").click()
    page.find("yes").click()
    page.wait("the end", lambda: page.text("state").startswith("stopped; wrote"))
    page.wait("the last picture", lambda: page.script("view.version >= view.wanted"))
    assert page.script("source.readyState") == 2, "the stream is closed"
    assert not page.find("stop").is_enabled()


def main(url, screenshot):
    try:
        browser = start_browser()
    except WebDriverException as error:
        print(error)
        return 77
    try:
        browser.get(url)
        page = Page(browser)
        check_numbers(page)
        check_exposure(page)
        check_cross(page)
        check_looks(page)
        if screenshot:
            browser.save_screenshot(screenshot)
        check_stop(page)
        errors = [e for e in browser.get_log("browser") if e["level"] == "SEVERE"]
        assert not errors, errors
        return 0
    finally:
        browser.quit()


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2] if len(sys.argv) > 2 else ""))
