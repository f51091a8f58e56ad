"""What a page says of stability and borders, from numbers alone."""

import pytest

from cosim.report.run_text import border_sentence, macros, stability_sentence

FOUND = {
    "verdict": "unstable", "motion": "along the line", "growth": 1.5, "other_growths": [1.5],
    "cycle": 0.6, "time_to_grow": 3.4, "watched": 20.0, "amplification": 1.0, "pretension": 0.006,
    "unstable_pretensions": [(0.005, 0.009)], "pretension_resolution": 1e-5,
}  # fmt: skip


def numbers(**changed):
    return {"stability": FOUND | changed, "same_regime": {}, "nearest_borders": []}


@pytest.mark.parametrize(("windows", "told"), [
    # stable at no pretension at all, and not at 6 mm: what is asked for lies above
    ([(0.005, 0.009)], "; stable from 9 mm of pretension (now 6)"),
    ([(0.0, 0.00832)], "; stable from 8.32 mm of pretension (now 6)"),
    ([(0.0, 0.001), (0.005, None)], "; stable below 5 mm of pretension (now 6)"),
    ([(0.0, None)], ""),
    (None, ""),
])  # fmt: skip
def test_the_pretension_that_helps_is_the_nearest(windows, told):
    line = macros().unstable(numbers(unstable_pretensions=windows))
    assert (
        line == f"disturbances of the line grow tenfold in 3.4 s, so that no rig keeps to it{told}"
    )


def test_a_border_has_no_more_digits_than_it_is_known_to():
    line = macros().unstable(
        numbers(pretension_resolution=2e-3, unstable_pretensions=[(0.0, 0.0091)])
    )
    assert "stable from about 10 mm" in line


def test_what_grows_slower_than_the_run_lasts_is_no_reason_that_no_rig_keeps_to_it():
    line = macros().unstable(numbers(time_to_grow=300.0))
    assert "no rig keeps" not in line and "in a run that lasts 20 s" in line
    assert "no rig" not in stability_sentence(numbers(time_to_grow=300.0))


def test_a_motion_that_grazes_is_not_judged():
    text = stability_sentence(numbers(verdict="grazing", growth=0.705, other_growths=[1.04]))
    assert "cannot be judged" in text and "0.705 or 1.04" in text
    told = stability_sentence(numbers(verdict="stable", growth=0.5, other_growths=[0.9]))
    assert "by the factor 0.5 to 0.9" in told


def test_borders_within_a_third_are_told_with_the_side_on_which_they_are():
    near = {"key": "surface.speed", "unit": "m/s", "value": 0.15, "border": 0.157, "aside": False}
    near |= {"beyond": "sliding", "margin": 0.047}
    told = border_sentence(numbers() | {"nearest_borders": [near]})
    assert "slides without ever sticking with surface.speed above 0.157 m/s (0.15 here)" in told
    assert "well inside" in border_sentence(numbers())
    assert "a third, none of" in border_sentence(numbers())
    assert "mu_s/mu_k - 1 makes" in border_sentence(numbers()), "a third of what is above its least"
    assert "too many steps" in border_sentence(numbers() | {"nearest_borders": None})
