"""Pages in a real browser: Chromium, driven by Selenium; axe-core from where npm put it."""

import shutil
import time
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
#: As `.ci/run` installs it: npm install --no-save --prefix .npm axe-core
AXE = ROOT / ".npm" / "node_modules" / "axe-core" / "axe.min.js"
WIDE, PHONE = 1280, 390
FLAGS = ("--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage")
FINDINGS = """
const done = arguments[arguments.length - 1];
axe.run(document, {resultTypes: ["violations"]}).then((found) => done(found.violations.map(
  (each) => [each.impact, each.id, each.nodes.map((node) => node.html.slice(0, 150))]
).concat([["passed", found.passes.length, []]])));
"""
#: Seconds that a page may take to do something; it takes milliseconds.
PATIENCE = 20.0


class Browser:
    """A browser window with a page in it."""

    def __init__(self, driver):
        self.driver = driver
        self.width = WIDE

    def resize(self, width: int):
        self.width = width
        self.command(
            "Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1,
            mobile=width == PHONE,
        )  # fmt: skip

    def open(self, path: Path, width: int = WIDE):
        self.resize(width)
        self.driver.get(path.as_uri())

    def command(self, name: str, **values):
        return self.driver.execute_cdp_cmd(name, values)

    def js(self, script: str, *values):
        return self.driver.execute_script(script, *values)

    def all(self, selector: str):
        return self.driver.find_elements("css selector", selector)

    def one(self, selector: str):
        return self.driver.find_element("css selector", selector)

    def errors(self) -> list[str]:
        """What the page complained of since the last time; advice on speed is none of it."""
        messages = [entry["message"] for entry in self.driver.get_log("browser")]
        return [message for message in messages if "willReadFrequently" not in message]

    def outside(self) -> list[str]:
        """What the page asked for beside itself."""
        names = self.js("return performance.getEntriesByType('resource').map((each) => each.name)")
        return [name for name in names if not name.startswith("data:")]

    def overhang(self) -> int:
        """Pixels by which the page is wider than the window."""
        return self.js("return document.documentElement.scrollWidth") - self.width

    def until(self, condition):
        end = time.monotonic() + PATIENCE
        while not (found := condition()):
            assert time.monotonic() < end, "the page does not do it"
            time.sleep(0.02)
        return found

    def barriers(self) -> list:
        """What axe-core calls serious or critical; the test is skipped where there is no axe."""
        if not AXE.is_file():
            pytest.skip(f"no {AXE.relative_to(ROOT)}: npm install --no-save --prefix .npm axe-core")
        self.js(AXE.read_text(encoding="utf-8"))
        *found, (_, passed, _) = self.driver.execute_async_script(FINDINGS)
        assert passed > 5  # it has looked
        return [each for each in found if each[0] in ("serious", "critical")]


def start(*flags: str, downloads: Path | None = None) -> Browser:
    """A browser with more flags; the test is skipped where there is none."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="no selenium")
    program = shutil.which("chromium") or shutil.which("chromium-browser")
    driver = shutil.which("chromedriver")
    if program is None or driver is None:
        pytest.skip("no chromium with chromedriver: apt-get install chromium chromium-driver")
    options = webdriver.ChromeOptions()
    options.binary_location = program
    for flag in (*FLAGS, *flags):
        options.add_argument(flag)
    if downloads is not None:
        options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    service = webdriver.ChromeService(driver)
    return Browser(webdriver.Chrome(options=options, service=service))
