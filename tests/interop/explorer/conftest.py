"""The explorer's page in a real browser."""

import pytest
from browser import start
from explorer_page import Page
from stickslip.generation.compiler import CompilerError

from cosim.cli import main
from cosim.fmu import web

#: Longest that a run of these tests may take in the page, s; they take a hundredth of that.
PATIENCE = 60.0


@pytest.fixture(scope="session")
def chromium(tmp_path_factory):
    """Chromium by Selenium, without a window; downloads go to ``driver.downloads``."""
    downloads = tmp_path_factory.mktemp("downloads")
    # a page that plays would draw for nobody all the time
    flags = "--window-size=1400,1000", "--force-prefers-reduced-motion"
    driver = start(*flags, downloads=downloads).driver
    driver.set_script_timeout(PATIENCE)
    driver.downloads = downloads
    yield driver
    driver.quit()


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
    """The page on any case, for who asks for one; the browser has nothing to complain of."""
    yield opened
    assert opened.faults() == []


@pytest.fixture
def reference(page):
    """The page on the reference case, which takes as long as the case of a test."""
    page.ended("#preset=reference")
    return page
