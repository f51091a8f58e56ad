"""The page and the whole set of files of a run."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path

import pytest
from test_report_dataset import coupled_dataset, mechanics_dataset
from test_report_figures import cut_short, with_gaps

from cosim.report import page as page_module
from cosim.report import summary, write_results
from cosim.report.figures import plates_of
from cosim.report.page import number
from cosim.report.quantities import told
from cosim.report.results import run_page
from cosim.report.run_text import headline, tiles


class References(HTMLParser):
    """Everything that a page would load or link to, and that its tags are closed."""

    VOID = {"meta", "img", "br", "link", "input", "hr"}

    def __init__(self):
        super().__init__()
        self.loaded, self.linked, self.open = [], [], []

    def handle_starttag(self, tag, attrs):
        attributes = dict(attrs)
        if tag in ("script", "link", "iframe", "object"):
            self.loaded.append(tag)
        self.loaded += [attributes[key] for key in ("src", "srcset", "data") if key in attributes]
        self.linked += [attributes["href"]] if "href" in attributes else []
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag


def read(path):
    page = path.read_text(encoding="utf-8")
    references = References()
    references.feed(page)
    assert references.open == []
    return page, references


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    folder = tmp_path_factory.mktemp("run")
    seen = []
    paths = write_results(
        coupled_dataset(), folder, command="stickslip run <case>.toml",
        files={"fields/temperature.pvd": "temperature fields"}, progress=seen.append,
    )  # fmt: skip
    return folder, paths, seen


def test_all_files_of_a_run_are_there_data_first(written):
    folder, paths, seen = written
    names = ["result.nc", "result.csv", "summary.json", "report.html"]
    assert [path.name for path in paths] == names == seen
    assert {path.name for path in folder.iterdir()} == set(names)


def test_figures_are_drawn_and_the_page_left_out_on_request(tmp_path):
    paths = write_results(coupled_dataset(), tmp_path, figures=True, page=False)
    drawn = [plate.name + ".png" for plate in plates_of(coupled_dataset())]
    assert [path.name for path in paths] == ["result.nc", "result.csv", "summary.json", *drawn]
    for path in paths[3:]:
        assert path.read_bytes().startswith(b"\x89PNG"), path


def test_page_holds_everything_it_shows(written):
    page, references = read(written[0] / "report.html")
    pictures = [source for source in references.loaded if source != "script"]
    assert pictures == [], "nothing waits for a drawing"
    assert page.count('<figure class="live"') == 7 and page.count("needs scripts") == 7
    assert not any(link.startswith(("http", "//", "file:")) for link in references.linked)
    assert not re.search(r"https?://|url\(|@import", re.sub(r"base64,[^\"]*", "", page))
    assert "Leon Sorokin" in page, "uPlot's licence goes with it"


def test_page_shows_scenario_ledger_numbers_and_versions(written):
    page, references = read(written[0] / "report.html")
    numbers = json.loads((written[0] / "summary.json").read_text(encoding="utf-8"))
    for text in (
        "stickslip run &lt;case&gt;.toml",
        "stiffness",
        "20.17 N/m",
        "run_up_time = 1.0",
        told(numbers["ledger"]["heat"]["received"], "J"),
        "scikit-fem",
        "Energy ledger",
        f"{100 * numbers['heat_shares']['ice']:.1f} %",
        "<tr><td>iterations of one step at most</td><td>3</td></tr>",
        f"<tr><td>thermal</td><td>{numbers['rows'] - 1} steps, ",
    ):
        assert text in page, text
    assert "fields/temperature.pvd" in references.linked
    assert {"result.nc", "result.csv", "summary.json"} <= set(references.linked)


@pytest.mark.parametrize("make", [coupled_dataset, mechanics_dataset])
@pytest.mark.parametrize("damage", [cut_short, with_gaps])
def test_what_there_is_of_a_run_is_written_and_its_status_seen(make, damage, tmp_path):
    dataset = damage(make)
    dataset.attrs.update(status="interrupted", reason="interrupted at t = 0.5 s <now>")
    write_results(dataset, tmp_path)
    page, _ = read(tmp_path / "report.html")
    assert 'class="status interrupted"' in page
    assert "interrupted at t = 0.5 s &lt;now&gt;" in page
    numbers = json.loads((tmp_path / "summary.json").read_text(encoding="utf-8"))
    assert numbers["status"] == "interrupted" and numbers["reason"]


def test_a_run_without_a_row_still_has_its_page(tmp_path):
    dataset = mechanics_dataset().isel(time=slice(0, 0), event_time=slice(0, 0))
    dataset.attrs.update(status="failed", reason="the integrator gave up at t = 0 s")
    write_results(dataset, tmp_path)
    page, _ = read(tmp_path / "report.html")
    assert "the integrator gave up" in page


@pytest.mark.parametrize(("value", "unit", "text"), [
    (None, "m", "–"),
    (0.034, "m", "34 mm"),
    (3.75, "m", "3.75 m"),
    (0.0494134, "K", "49 mK"),
    (1.2345, "K", "1.2 K"),
    (62.3471, "J", "62.3 J"),
    (62347.1, "J", "62300 J"),
    (-4.57e-12, "J", "−4.57 · 10⁻¹² J"),
    (14, "1", "14"),
    (-40.384, "deg", "−40.38°"),
    (-8.0, "degC", "−8 °C"),
    (1e-9, "deg", "0.00°"),
    (-1.95e-21, "m", "0 m"),
    (5.74e-11, "m", "0 m"),
    (5e-10, "m", "5.00 · 10⁻¹⁰ m"),
    (-3e-17, "N", "0 N"),
    (-0.0, "m", "0 m"),
    (2e-20, "1", "2.00 · 10⁻²⁰"),
])  # fmt: skip
def test_numbers_as_they_are_read(value, unit, text):
    assert told(value, unit) == text


@pytest.mark.parametrize(
    ("value", "sizes", "text"),
    [
        (-1.95e-21, {}, "−1.95e−21"),  # of a channel of which nothing is known
        (-1.95e-21, {"nominal": 0.01}, "0"),
        (-1.95e-21, {"largest": 3e-22}, "−1.95e−21"),
        (4e-18, {"largest": 0.03}, "0"),
        (4e-16, {"largest": 0.03}, "4e−16"),
        (-0.0, {}, "0"),
        (None, {"largest": 1.0}, "–"),
        ("word", {"nominal": 1.0}, "word"),
    ],
)
def test_rounding_beside_a_channels_own_size_or_its_nominal_is_nought(value, sizes, text):
    assert number(value, 3, **sizes) == text


def test_a_run_that_ends_in_its_ramp_has_no_numbers_after_it():
    """A sentence in place of a column of dashes."""
    dataset = coupled_dataset()
    moves = {"begin": 10.0, "duration": 0.0, "break_aways": 0, "frequency": None}
    numbers = summary(dataset) | {"after_run_up": moves | {"slip_share": None, "mean_x": None}}
    row = "<tr><td>none: the run ends before the ramp does</td><td>10 s</td></tr>"
    assert row in run_page(dataset, numbers)


def test_the_page_says_how_warm_it_gets_in_the_end():
    dataset = coupled_dataset()
    ends = summary(dataset)["in_the_end"]
    assert ends["interface_rise"] > 0.0 and ends["reached"] > dataset["time"][-1] and ends["within"]
    page = run_page(dataset, summary(dataset))
    rise = told(ends["interface_rise"], "K")
    assert f"<tr><td>its rise over the air</td><td>{rise}</td></tr>" in page
    assert "<td>from then on within 5 % of that rise</td>" in page


def test_the_page_says_why_the_belt_length_takes_another_heat_transfer_to_the_air():
    dataset = coupled_dataset()
    numbers = summary(dataset)
    ends = numbers["in_the_end"]
    page, same = (
        run_page(dataset, numbers | {"in_the_end": ends | {"still_air_heat_transfer": film}})
        for film in (5.4518, ends["air_heat_transfer"])
    )
    taken, why = told(ends["air_heat_transfer"], "W/(m2.K)", count=2), "makes this run take it"
    row = f"<td>heat transfer to the air, each face of the belt</td><td>{taken}</td>"
    assert row in page and row in same and why not in same
    assert f"belt.still_air_speed = {ends['speed']:g} {why}, too</td><td>5.5 W/(m² K)</td>" in page


def test_every_page_has_the_dark_look_of_the_shared_style_and_none_of_its_own():
    package = Path(page_module.__file__).parents[1]
    templates = [
        path for path in package.rglob("*.j2") if "page.html.j2" in path.read_text("utf-8")
    ]
    assert len(templates) > 10
    own = [path.name for path in templates if "block dark" in path.read_text("utf-8")]
    assert own == []
    assert not [path for path in templates if "prefers-color-scheme" in path.read_text("utf-8")]
    assert "prefers-color-scheme: dark" in page_module.asset("page.html.j2")


MOVES = {"duration": 20.0, "frequency": 1.7331, "slip_share": 0.876, "break_aways": 35,
         "mean_x": 0.0168, "max_rotation_deg": 0.31}  # fmt: skip
RISE = {"temperatures": {"interface": {"end_rise": 0.0631, "max_rise": 0.0636}}}


@pytest.mark.parametrize(
    ("moves", "further", "said"),
    [
        ({}, RISE, "sticks and slips 1.73 times a second, and its interface is 63 mK above the air "
                   "after 30 s."),
        ({}, {"status": "interrupted"},
         "sticks and slips 1.73 times a second; the run ended early, at 30 s."),
        ({"frequency": 0.0, "break_aways": 0, "slip_share": 1.0}, {},
         "slides without ever sticking."),
        ({"frequency": 0.0, "break_aways": 0, "slip_share": 0.0}, {}, "sticks and never slips."),
        ({"frequency": None, "break_aways": 1}, {}, "breaks away once at constant speed."),
        ({"duration": 0.0}, {"whole_run": {"break_aways": 2}},
         "breaks away 2 times in the speed ramp, which the run does not outlast."),
    ],
)  # fmt: skip
def test_a_run_is_told_in_a_sentence(moves, further, said):
    numbers = {"time_reached": 30.0, "status": "complete", "after_run_up": MOVES | moves, **further}
    assert headline(numbers) == f"The block {said}"
    assert len(tiles(numbers)) == 4
