"""The page: its first lines and pictures, one value for each number, and every kind of answer."""

import re
from dataclasses import replace

import gap_answers as answers
import pytest

from cosim.gap.quantities import digits
from cosim.gap.show import files
from cosim.gap.show.text import closing_lines
from cosim.gap.show.tracks import worst

JARGON = ("offset.", "rung 0", "nan", "None", "{")


@pytest.mark.parametrize("verdict", [*answers.VERDICTS, "fault", "nothing held out"])
def test_every_answer_has_a_page(gap, verdict, tmp_path):
    if verdict == "fault":
        gap = answers.with_a_fault(gap, scale=0.02)
    elif verdict == "nothing held out":
        gap = answers.without_held_out(gap)
    else:
        gap = answers.other(gap, verdict)
    files.write_page(gap, tmp_path, tmp_path / "report.html", lambda: None)
    html = (tmp_path / "report.html").read_text(encoding="utf-8")
    text = answers.words_of(html)
    names = re.findall(r'data-name="(\w+)"', html)
    first = ["ladder", "curve", "run"] if gap.laws else ["ladder", "run"]
    assert names == [*first, "residuals_x", "overlay_x"]
    assert text.index(gap.sentence) < 200 and text.index(gap.sentence) < text.index("Gap (1 is")
    assert not [word for word in JARGON if word in text]
    assert "http" not in html
    noise = "as large as the tracker's noise" in text
    assert noise == (max(gap.after.fit, gap.after.held_out or 0.0) <= 1.1)
    assert ("no run was held out" in text) == (gap.after.held_out is None)
    assert ("Run that would separate them" in text) == (gap.next_experiment is not None)
    assert "model.toml is the model of run0" in text


def test_closing_lines(gap):
    text = "\n".join(closing_lines(gap))
    assert gap.sentence in text and "runner-up  film_drag, probability < 0.001" in text
    ends = f"{digits(gap.before.held_out)} → {digits(gap.after.held_out)}"
    assert "2 fitted runs" in text and f"1 held-out run {ends} (1 is noise)" in text


# --- in Python ---


def test_figures_have_axes_with_names(gap):
    for name in ("ladder", "curve", "run", "residuals_x", "overlay_x"):
        axes = gap.plot(name).axes
        assert all(axis.get_ylabel() for axis in axes) and all(axis.lines for axis in axes)
        assert axes[-1].get_xlabel() or name == "ladder"
    labels = [tick.get_text() for tick in gap.plot("ladder").axes[0].get_xticklabels()]
    assert labels == ["user's\nmodel", "velocity_\nweakening"]
    with pytest.raises(ValueError, match=r"ladder"):
        gap.plot("lader")


def test_where_the_user_s_model_is_worst_is_what_is_shown(gap):
    (axis,) = gap.plot("run").axes
    assert axis.get_title(loc="left").startswith("run03")  # the gap of 10, others have 3 and 5
    begin, end = axis.get_xlim()
    assert 1.0 < end - begin < 3.0


def test_a_run_shorter_than_its_cycles_is_shown_whole(gap):
    """A mass in grams: free vibrations are longer than the record, whose first mean is not at 0."""
    runs = tuple(
        replace(run, mass=1e3 * run.mass, track=replace(run.track, time=run.track.time + 0.05))
        for run in gap.campaign.runs
    )
    _, _, begin, end = worst(replace(gap, campaign=replace(gap.campaign, runs=runs)))
    assert (begin, end) == pytest.approx((0.05, 6.05))
