"""The examples run and say what they should; of what they draw and of its pages the site is built.

Both in one file: what an example drew is in the site without being computed twice. Cells of the
notebooks are executed before the build, and hidden ones among them assert what the pages say.
"""

import contextlib
import json
import re
import subprocess
from html.parser import HTMLParser
from math import exp, pi
from pathlib import Path

import pytest
import rendered
from browser import PHONE, WIDE
from build_site import build
from gallery import EXAMPLES, NAMES, SLOW
from gallery import ran as run_example
from notebooks import PAGES, is_notebook
from sessions import fences, timeless
from stickslip.reference.coulomb_oscillator import CoulombOscillator

SOURCES = Path(__file__).parent / "site"


@pytest.fixture(scope="module")
def gallery(tmp_path_factory):
    """Where the examples leave what they print and draw."""
    return tmp_path_factory.mktemp("gallery")


@pytest.fixture(scope="module")
def known():
    """Name of an example that was run -> what its variables held at the end."""
    return {}


@pytest.fixture
def ran(at_home, gallery, known):
    """Name of an example -> what its variables hold at the end; run once."""

    def look_up(name):
        if name not in known:
            known[name] = run_example(name, gallery)
        return known[name]

    return look_up


def test_coupled_run(ran):
    got = ran("coupled_run")
    assert got["time"][-1] == pytest.approx(3.0)
    assert got["heat"] == pytest.approx(0.842, abs=0.002)
    assert got["rise"][-1] == pytest.approx(0.0366, abs=2e-4)
    assert abs(got["lost"]) < 1e-11


def test_fmu_in_fmpy(ran):
    got = ran("fmu_in_fmpy")
    assert got["units"]["x"] == "m"
    assert got["result"]["slip_count"][-1] == 18
    assert got["slip_share"] == pytest.approx(0.862, abs=0.002)
    assert abs(got["result"]["energy_residual"][-1]) < 1e-11


def test_read_result(ran):
    got = ran("read_result")
    assert got["x"].attrs["units"] == "m"
    weight = 0.67 * 9.81
    line = CoulombOscillator(0.67, 4 * 20.17, 0.15, 0.2815 * weight, 0.2086 * weight)
    assert got["swing"] == pytest.approx(2.0 * line.amplitude, rel=5e-3)


def test_belt_length(ran):
    """Twice as long a belt comes round half as warm for ever: the heat spreads over it."""
    got = ran("belt_length")
    assert got["after_a_run"][1.0] == pytest.approx(0.344, abs=0.001)
    assert got["for_ever"][1.0] == pytest.approx(2.0 * got["for_ever"][2.0], rel=0.05)


def test_with_an_effect(ran):
    got = ran("with_an_effect")
    assert got["stroke"]["plain"] == pytest.approx(0.01746, abs=5e-5)
    assert got["stroke"]["with velocity weakening"] > 1.2 * got["stroke"]["plain"]
    assert abs(got["ledger"]) < 1e-11


@pytest.mark.slow
def test_find_gap(ran):
    got = ran("find_gap")
    assert got["gap"].verdict == "named"
    assert list(got["gap"].effects) == ["velocity_weakening"]


def test_own_participant(ran):
    """The force is a macro step h old, half of one in the mean: exp(pi^2 h / T) a period."""
    got = ran("own_participant")
    assert got["result"].status == "complete"
    grown = exp(pi**2 * got["STEP"] / got["PERIOD"])
    assert got["end"] == pytest.approx(0.01 * grown, rel=2e-6)


class Links(HTMLParser):
    """What a page refers to, and what can be referred to in it."""

    def __init__(self, page):
        super().__init__()
        self.targets, self.anchors, self.loaded = set(), set(), set()
        self.feed(page.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attrs):
        """Called by the parser."""
        attributes = dict(attrs)
        self.anchors.update(filter(None, [attributes.get("id")]))
        self.targets.update(filter(None, [attributes.get("href"), attributes.get("src")]))
        if tag in ("script", "img", "iframe", "source"):
            self.loaded.update(filter(None, [attributes.get("src")]))
        if tag == "link" and attributes.get("rel") != "canonical":
            self.loaded.update(filter(None, [attributes.get("href")]))


@pytest.fixture(scope="module")
def site(tmp_path_factory, home, gallery, known, executed):
    """The site as it is built, after the examples."""
    with contextlib.chdir(home):
        known |= {name: run_example(name, gallery) for name in NAMES if name not in {*SLOW, *known}}
    try:
        return build(tmp_path_factory.mktemp("site"), gallery, executed).parent
    except subprocess.CalledProcessError as error:
        pytest.fail(f"{error.stdout}{error.stderr}")


def test_the_site_is_built_without_a_warning(site):
    for page in ("index", "install", "tutorials/rig_coupled", "reference/commands", "examples"):
        assert (site / f"{page}.html").stat().st_size > 5_000


def test_every_notebook_is_there_to_download_with_what_it_computed(site):
    found = {file.name: json.loads(file.read_text("utf-8")) for file in site.rglob("*.ipynb")}
    sources = {file.stem for file in SOURCES.glob("tutorials/*.md")} - {"index"}
    assert {Path(name).stem for name in found} == sources
    for notebook in found.values():
        cells = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
        assert all(cell["execution_count"] for cell in cells)
        assert any(cell["outputs"] for cell in cells)


def as_compared(text):
    """A page without times, and without the digits of what is but rounding."""
    return timeless(re.sub(r"[\d.]+e-1\d", "nothing", text).splitlines())


def test_the_tutorials_that_a_code_host_shows_are_those_that_were_executed(executed):
    """Else `python tests/docs/rendered.py` writes them anew."""
    pages = [page for page in sorted(PAGES.glob("*.md")) if is_notebook(page)]
    shown = {file.name for file in rendered.FOLDER.iterdir()}
    for page in pages:
        text, pictures = rendered.rendered(page, executed(page))
        there = (rendered.FOLDER / page.name).read_text(encoding="utf-8")
        assert as_compared(there) == as_compared(text)
        assert "{code-cell}" not in text and "{nb-download}" not in text
        shown -= {page.name, *pictures}
    assert shown == set()


def test_a_code_host_shows_links_and_pictures_that_are_there():
    """Of the pages as they lie here, but for what only a build makes."""
    broken = []
    for page in [*SOURCES.rglob("*.md"), *rendered.FOLDER.glob("*.md")]:
        text = page.read_text(encoding="utf-8")
        assert not re.search(r"\{(doc|ref)\}", text), page
        seen = re.sub(r"<!--.*?-->", "", text, flags=re.S)
        assert is_notebook(page) or "```{" not in seen, page
        for target in re.findall(r"\]\(([^)#:]+?)(?:#[^)]*)?\)", text):
            if not target.startswith("made/") and not (page.parent / target).exists():
                broken.append(f"{page.name}: {target}")
    assert broken == []


def test_blocks_that_the_build_makes_show_what_is_run(site):
    """Examples, which are run here; what they printed; usages and formulas, out of the code."""
    examples = [file.read_text(encoding="utf-8") for file in EXAMPLES.glob("*.py")]
    made = [file.read_text(encoding="utf-8") for file in site.parent.glob("source/made/*.md")]
    blocks = [(block.info, block.content.rstrip()) for page in made for block in fences(page)]
    assert {kind for kind, _ in blocks} == {"python", "text", "{eval-rst}"}
    shown = [text for kind, text in blocks if kind == "python"]
    assert len(shown) == len(examples)
    assert all(any(text in example for example in examples) for text in shown)
    assert not any(text.startswith("$ ") for _, text in blocks)


def test_the_site_needs_nothing_of_the_net(site):
    for page in site.rglob("*.html"):
        outside = {one for one in Links(page).loaded if re.match(r"(https?:)?//", one)}
        assert not outside, page


def test_links_within_the_site_lead_somewhere(site):
    pages = {page: Links(page) for page in site.rglob("*.html")}
    broken = []
    for page, links in pages.items():
        for target in links.targets:
            if re.match(r"[a-z]+:|//|data:", target):
                continue
            path, _, anchor = target.partition("#")
            file = (page.parent / path.partition("?")[0]).resolve() if path else page
            if not file.exists() or (
                anchor and file in pages and anchor not in pages[file].anchors
            ):
                broken.append(f"{page.relative_to(site)}: {target}")
    assert not broken


@pytest.mark.parametrize("page", ["index", "cannot", "guide/index", "tutorials/rig_coupled"])
def test_nobody_is_kept_out_of_the_site(site, browser, page):
    for width in (WIDE, PHONE):
        browser.open(site / f"{page}.html", width)
        assert browser.overhang() <= 0
        assert browser.barriers() == []
    browser.errors()  # the search asks a server for its index; whoever opens the next page does not
