"""The page and the maps of `stickslip stability`, of numbers that are known."""

from types import SimpleNamespace

import numpy as np
import pytest

from cosim import read_scenario
from cosim.report.style import shown
from cosim.studies.stability import maps, range_sentence, study
from cosim.studies.stability.figures import draw_range, draw_regime_map
from cosim.studies.stability.maps import PretensionMap

PARAMETERS = read_scenario("study").mechanics
CASE = SimpleNamespace(name="known", parameters=PARAMETERS, interface=None)
RATIOS, SPEEDS = np.array([1.2, 1.6]), np.array([0.1, 0.2, 0.6])


@pytest.fixture(scope="module")
def regimes():
    """The map as the closed form has it, without a simulation."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(maps, "_simulated", lambda parameters, interface: maps.predicted(parameters))
        return maps.regime_map(CASE, RATIOS, SPEEDS, lambda done: None)


def test_borders_are_those_of_the_closed_form_and_not_of_the_grid(regimes):
    from_rest = regimes.closed_form_borders["rest"]
    assert len(from_rest) == len(RATIOS)
    step = np.diff(SPEEDS)[0] / 2**maps.HALVINGS
    for speed, ratio in from_rest:
        moving = maps.with_ratio(PARAMETERS, ratio)
        assert maps.belt_start(moving).fastest_from_rest == pytest.approx(speed, abs=step)
    assert not np.isin(np.round(from_rest[:, 0], 6), [0.15, 0.4]).any()  # halfway in the grid


def test_the_drawn_borders_are_these(regimes):
    borders = regimes.closed_form_borders.values()
    for panel, border in zip(shown(draw_regime_map, regimes, CASE).axes, borders, strict=True):
        drawn = panel.lines[0].get_xydata()
        np.testing.assert_array_equal(drawn, border)
    assert "Dots: borders" in draw_regime_map(regimes, CASE).caption


def test_a_range_is_drawn_as_it_is_said():
    windows = {"ramp": [(None, 0.157), (0.3, None)], "rest": []}
    found = {"key": "surface.speed", "unit": "m/s", "value": 0.15, "searched": [0.015, 1.5]}
    (axes,) = shown(draw_range, found | {"stick_slip": windows}, CASE).axes
    bars = [(bar.get_y() + 0.3, bar.get_x(), bar.get_x() + bar.get_width()) for bar in axes.patches]
    whole, of_ramp = (0.015, 1.5), [(0.015, 0.157), (0.3, 1.5)]
    expected = [(0.0, *each) for each in (whole, *of_ramp)] + [(1.0, *whole)]
    assert np.array(bars) == pytest.approx(np.array(expected))
    assert [label.get_text() for label in axes.get_yticklabels()] == [
        "from a speed ramp",
        "from rest",
    ]
    assert axes.lines[0].get_xdata()[0] == 0.15


def test_one_sentence_then_a_picture_then_four_figures():
    regime = dict(name="stick-slip", frequency=1.7, slip_share=0.9)
    regime |= dict(mean_x=0.01, half_range_x=0.01, max_y=0.0, max_rotation_deg=0.0)
    numbers = {
        "name": "known",
        "stability": {"verdict": "unstable", "growth": 1.42061, "least_pretension": 0.0083211},
        "regimes": {"own": regime},
        "starts": {"own": "as the scenario starts"},
        "stick_slip_range": None,
    }
    low = PretensionMap(np.array([0.0]), np.array([0.1]), np.ones((1, 1)), np.ones((1, 1)))
    sentences = ["It is unstable. It is stable from 8.32 mm on.", "More."]
    found = SimpleNamespace(
        **{"summary": lambda: numbers, "sentences": sentences, "case": CASE},
        **{"stick_slip": None, "pretension": low, "regimes": None},
    )
    page, _ = study.page(found)
    assert "<h1>It is unstable.</h1>" in page
    places = [
        page.index(each) for each in ("<h1>", "<figure", 'class="tiles"', "8.32 mm on", "<h2")
    ]
    assert places == sorted(places)
    assert study.tiles(found)[0] == ("size of a disturbance after a cycle", "1.42 times")
    assert '<td class="start">' in page and "td.start { min-width" in page
    # one that would be unstable with other numbers is no warning
    assert '<p class="warning">It is' not in page
    numbers["stability"]["verdict"] = "stable"
    sentences[1] = "It is unstable with a pretension of 0 to 8.32 mm."
    assert 'class="warning"' not in study.page(found)[0]
    windows = {"ramp": [(None, 0.15708)], "rest": [(None, 0.18)]}
    numbers["stick_slip_range"] = {"key": "surface.speed", "unit": "m/s", "stick_slip": windows}
    first, *others = study.tiles(found)
    assert first == ("surface.speed above which stick-slip stops", "0.157 m/s")
    assert len(others) == 3


def test_a_range_says_how_far_was_looked():
    """A window without an end was once "everywhere"; it is so far as ten times the value."""
    found = {"key": "surface.speed", "unit": "m/s", "value": 0.15, "ramp": 10.0}
    windows = {"rest": [(None, None)], "riding": [(0.2, None)], "ramp": []}
    said = range_sentence(found | {"searched": [0.015, 1.5], "stick_slip": windows})
    assert said == (
        "Disturbed a little, the block sticks and slips from rest from 0.015 to at least 1.5 m/s;"
        " riding on the surface from 0.2 to at least 1.5 m/s; from a speed ramp of 10 s nowhere"
        " from 0.015 to 1.5 m/s (surface.speed, here 0.15 m/s; looked for from 0.015 to 1.5 m/s)."
    )
