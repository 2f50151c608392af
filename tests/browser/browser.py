"""A headless Chromium with one report in it, and what the checks ask of it."""

import base64
import os
import pathlib
import shutil
import sys

PICTURES = "LANELIGHT_SCREENSHOTS" in os.environ  # as sharp as a phone has them
SKIPPED = 77  # what CTest takes for "skipped"
# The headless shell takes 40 % less processor time than Chromium. chromedriver cannot end it
# when it starts as /usr/bin/chromium-headless-shell, a script that does not exec it.
SHELL = "/usr/lib/chromium/chromium-headless-shell"

FLAGS = [
    "--headless=new", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
    "--disable-background-networking", "--disable-component-update", "--disable-sync",
    "--hide-scrollbars", "--disable-dev-shm-usage", "--force-device-scale-factor=1",
]

# What is drawn on a canvas, or as SVG with the styles that the page gives it.
PLOT_INK = """
  const drawn = async (shown) => {
    const copy = shown.cloneNode(true), nodes = copy.querySelectorAll('*');
    shown.querySelectorAll('*').forEach((node, i) => {
      for (const name of ['fill', 'stroke', 'stroke-width', 'stroke-dasharray', 'opacity',
                          'display', 'font-size'])
        nodes[i].style.setProperty(name, getComputedStyle(node).getPropertyValue(name));
    });
    const picture = new Image();
    picture.src = 'data:image/svg+xml;charset=utf-8,' +
      encodeURIComponent(new XMLSerializer().serializeToString(copy));
    await picture.decode();
    return picture;
  };
  return (async (shown) => {
    const picture = shown.tagName === 'svg' ? await drawn(shown) : shown;
    const copy = document.createElement('canvas');
    copy.width = picture.width, copy.height = picture.height;
    const context = copy.getContext('2d', {willReadFrequently: true});
    context.drawImage(picture, 0, 0);
    const d = context.getImageData(0, 0, copy.width, copy.height).data;
    let ink = 0, coloured = 0, hash = 0;
    const shades = new Set();
    for (let i = 0; i < d.length; i += 4) {
      if (d[i + 3] > 40) ++ink;
      if (d[i + 3] > 120 && Math.max(d[i], d[i + 1], d[i + 2]) -
          Math.min(d[i], d[i + 1], d[i + 2]) > 60) ++coloured;
      shades.add(d[i]);
      hash = (Math.imul(hash, 31) + d[i] * 7 + d[i + 1] * 3 + d[i + 2] + d[i + 3]) | 0;
    }
    return {ink, coloured, hash, shades: shades.size, pixels: d.length / 4};
  })(arguments[0]);
"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


# Drawn by the processor, where the tests have no graphics card.
WEBGL_FLAGS = [flag for flag in FLAGS if flag != "--disable-gpu"] + [
    "--enable-unsafe-swiftshader"]


def start(flags=FLAGS, logs=("browser", "performance")):
    """A driver, or the end of the process with SKIPPED where there is none. The log
    "performance" has each message of each socket in it."""
    try:
        from selenium import webdriver
        from selenium.webdriver.chrome.service import Service
    except ImportError:
        skip("python3-selenium is not installed")
    chromium = SHELL if os.path.exists(SHELL) else shutil.which("chromium")
    driver_path = shutil.which("chromedriver")
    if not chromium or not driver_path:
        skip("chromium or chromium-driver is not installed")
    options = webdriver.ChromeOptions()
    options.binary_location = chromium
    for flag in flags:
        options.add_argument(flag)
    options.set_capability("goog:loggingPrefs", {log: "ALL" for log in logs})
    return webdriver.Chrome(service=Service(driver_path), options=options)


class Page:
    """The open report. `find` and `all` take CSS selectors."""

    def __init__(self, driver, path, folder, window=(1280, 900)):
        self.driver = driver
        self.url = path if "://" in path else pathlib.Path(path).resolve().as_uri()
        self.folder = pathlib.Path(folder)
        self.folder.mkdir(parents=True, exist_ok=True)
        self.messages = []
        self.is_used = False
        self.window = window
        self.resize(*window)
        self.prefer("light")

    def resize(self, width, height, mobile=False):
        self.driver.execute_cdp_cmd("Emulation.setDeviceMetricsOverride", {
            "width": width, "height": height, "mobile": mobile,
            "deviceScaleFactor": 2 if mobile and PICTURES else 1})

    def prefer(self, scheme):
        """Sets the system's colours. It prefers no motion, so scrolling is instant."""
        self.driver.execute_cdp_cmd("Emulation.setEmulatedMedia", {
            "features": [{"name": "prefers-color-scheme", "value": scheme},
                         {"name": "prefers-reduced-motion", "value": "reduce"}]})

    def open(self, fragment=""):
        self.is_used = False
        self.driver.get("about:blank")
        self.driver.get(self.url + fragment)
        self.settle()

    def reset(self):
        """Has the page opened anew before its next use, unless that opens it itself."""
        self.is_used = True

    def open_if_used(self):
        if self.is_used:
            self.open()

    def js_async(self, script, *arguments):
        """Returns what the script gives to its last argument."""
        self.open_if_used()
        return self.driver.execute_async_script(script, *arguments)

    def js(self, script, *arguments):
        self.open_if_used()
        return self.driver.execute_script(script, *arguments)

    def find(self, selector):
        return self.js("return document.querySelector(arguments[0])", selector)

    def text(self, selector="body"):
        """What can be seen, without what is folded away; read in one step, so that the
        element may be drawn anew at any time."""
        return self.js("return document.querySelector(arguments[0]).innerText", selector)

    def all(self, selector):
        return self.js("return [...document.querySelectorAll(arguments[0])]", selector)

    def settle(self, frames=4):
        """Waits for that many frames. Observers and debounced painting of a page take at
        most one frame each."""
        self.js_async(
            "const done = arguments[1]; let left = arguments[0];"
            "const step = () => left-- > 0 ? requestAnimationFrame(step) : done();"
            "step();", frames)

    def show(self, selector):
        self.js("document.querySelector(arguments[0])"
                ".scrollIntoView({behavior: 'instant'})", selector)
        self.settle()

    def scroll_through(self):
        """Scrolls to the end and back, so that everything draws itself that does so when it
        comes near the screen."""
        self.js_async("""
            const done = arguments[0], root = document.documentElement;
            const frame = () => new Promise(requestAnimationFrame);
            (async () => {
              for (let y = 0; y < root.scrollHeight; y += innerHeight) {
                scrollTo(0, y);
                await frame(), await frame();
              }
              scrollTo(0, 0);
              for (let i = 0; i < 4; ++i) await frame();
            })().then(done);""")

    def draw_all(self):
        """Draws everything at once, as before printing."""
        self.js("dispatchEvent(new Event('beforeprint'));"
                "dispatchEvent(new Event('afterprint'))")
        self.settle()

    def click(self, selector, index=0):
        self.js("document.querySelectorAll(arguments[0])[arguments[1]].click()", selector, index)
        self.settle()

    def box(self, selector):
        """Left, top, right, bottom in the window."""
        return self.js("const b = document.querySelector(arguments[0]).getBoundingClientRect();"
                       "return [b.left, b.top, b.right, b.bottom]", selector)

    def ink(self, canvas):
        return self.js(PLOT_INK, canvas)

    def console(self):
        """Messages since the page was opened first, that are not mere information."""
        self.messages += [entry for entry in self.driver.get_log("browser")
                          if entry["level"] != "INFO"]
        return [entry["message"] for entry in self.messages]

    def screenshot(self, name, selector=None):
        if not PICTURES:
            return
        clip = {}
        if selector:
            x, y = self.js("return [scrollX, scrollY]")
            left, top, right, bottom = self.box(selector)
            clip = {"clip": {"x": max(0, left + x - 12), "y": max(0, top + y - 8), "scale": 1,
                             "width": right - left + 24, "height": bottom - top + 16}}
        image = self.driver.execute_cdp_cmd("Page.captureScreenshot", {
            "format": "png", "captureBeyondViewport": bool(selector), **clip})
        (self.folder / f"{name}.png").write_bytes(base64.b64decode(image["data"]))
