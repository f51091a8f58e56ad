"""What a page shows of the last milliseconds of a slip is what the model does there."""

from functools import cache

import numpy as np
import pytest
from stickslip import simulate
from test_report_dataset import coupled_dataset, mechanics_dataset, scenario

from cosim.report.figures.events import through_events

#: Between two rows of a curve of a few hundred of them, and as wide as a line on a page.
LINE = 0.01


@cache
def fine():
    """The run on a slab, on which the block turns, a hundred times as often."""
    case = scenario("slab")
    return simulate(case.mechanics, case.run.duration, 0.01 * case.run.output_interval)


@pytest.mark.parametrize("made", [mechanics_dataset, coupled_dataset])
@pytest.mark.parametrize("name", ["friction_force_y", "friction_moment"])
def test_curves_are_the_model_s_between_the_rows_too(made, name):
    """Without the last moments the moment is off by up to a fifth of all that it does."""
    rows, _ = through_events(made("slab"))
    exact = fine()
    # an event's two sides are one instant apart, and the fine rows are not: that instant is left
    apart = np.min(np.abs(exact.time[:, None] - exact.events[:, 0]), axis=1)
    shown = apart > 2e-4
    drawn = np.interp(exact.time[shown], rows["time"].values, rows[name].values)
    off = np.abs(drawn - exact[name][shown])
    assert off.max() <= LINE * np.ptp(exact[name])


def test_what_the_model_does_not_know_of_is_not_added():
    """Friction that was another one: rows as they are, and nothing made up between them."""
    dataset = mechanics_dataset("slab").copy(deep=True)
    dataset["friction_force_x"] *= np.linspace(1.0, 3.0, dataset.sizes["time"])
    rows, events = through_events(dataset)
    assert rows.sizes["time"] == dataset.sizes["time"] + events.sum()
    moment = dataset["friction_moment"].values
    assert np.abs(rows["friction_moment"].values).max() <= 1.01 * np.abs(moment).max()
