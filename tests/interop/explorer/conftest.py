"""The explorer's page in a real browser."""

import shutil

import pytest
from explorer_page import Page
from stickslip.generation.compiler import CompilerError

from cosim.cli import main
from cosim.fmu import web

#: Longest that a run of these tests may take in the page, s; they take a hundredth of that.
PATIENCE = 60.0


@pytest.fixture(scope="session")
def chromium(tmp_path_factory):
    """Chromium by Selenium, without a window; downloads go to ``driver.downloads``."""
    webdriver = pytest.importorskip("selenium.webdriver", reason="needs selenium, from PyPI")
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    driver = shutil.which("chromedriver")
    if browser is None or driver is None:
        pytest.skip("needs chromium and its driver: apt-get install chromium chromium-driver")
    downloads = tmp_path_factory.mktemp("downloads")
    options = webdriver.ChromeOptions()
    options.binary_location = browser
    for argument in ("headless=new", "no-sandbox", "disable-gpu", "window-size=1400,1000"):
        options.add_argument(f"--{argument}")
    # a page that plays would draw for nobody all the time
    options.add_argument("--force-prefers-reduced-motion")
    options.add_experimental_option("prefs", {"download.default_directory": str(downloads)})
    options.set_capability("goog:loggingPrefs", {"browser": "ALL"})
    made = webdriver.Chrome(options=options, service=webdriver.ChromeService(driver))
    made.set_script_timeout(PATIENCE)
    made.downloads = downloads
    yield made
    made.quit()


@pytest.fixture(scope="session")
def explorer_file(tmp_path_factory):
    """The page as the command writes it."""
    try:
        web.module()
    except CompilerError as error:
        pytest.skip(str(error))
    file = tmp_path_factory.mktemp("explorer") / "explorer.html"
    assert main(["explore", "--no-open", "-o", str(file)]) == 0
    return file


@pytest.fixture(scope="session")
def opened(chromium, explorer_file):
    """The page, opened once: that takes longer than most of what is done with it."""
    made = Page(chromium, explorer_file)
    made.open()
    return made


@pytest.fixture
def page(opened):
    """The page on the reference case; the browser has nothing to complain of."""
    opened.ended("#preset=reference")
    yield opened
    assert opened.faults() == []
