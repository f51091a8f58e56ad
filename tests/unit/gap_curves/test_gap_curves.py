"""Free curves: the right axis first, the law's own shape, and columns that are what they say."""

import numpy as np
import pytest
from settled_campaigns import campaign_of, prepared_of, settled_on
from stickslip import Parameters
from stickslip.friction.law import friction_coefficient

from cosim.gap.curves.axes import remembered
from cosim.gap.curves.curve import Curve
from cosim.gap.curves.curves import curves
from cosim.gap.curves.figure import draw_curves
from cosim.gap.curves.spline import KNOTS, Spline
from cosim.gap.curves.tables import refined, table_of
from cosim.processes import map_here


def found_in(folder, blocks, seed):
    campaign = campaign_of(folder, blocks, seed)
    base = settled_on(campaign, prepared_of(campaign), turns=4)
    return curves(base, campaign.runs, map_here)


def test_distance_comes_first_where_friction_runs_in(tmp_path):
    drift = {"change": 0.3, "distance": 0.2, "static_relative": 1.0}
    found = found_in(tmp_path, lambda mass, speed: {"run_in": drift}, 1)
    first = found[0]
    assert first.axis == "distance" and first.on == "both"
    assert first.helps() and first.gain > 2.0 * first.error
    true = np.log(1.0 + 0.3 * (1.0 - np.exp(-first.values / 0.2)))
    true -= true.mean()
    assert np.abs(first.mean - true).max() < 0.03
    inside = (first.low <= true) & (true <= first.high)
    assert inside.mean() > 0.6
    of_time = next(curve for curve in found if curve.axis == "time")
    assert first.is_told_from(of_time)
    figure = draw_curves(found, ["distance"])
    assert [axis.get_title(loc="left") for axis in figure.axes][0].startswith(
        f"gain {first.gain:.0f}"
    )


@pytest.mark.slow
def test_sliding_speed_comes_first_where_it_weakens(tmp_path):
    strength = 0.6
    law = {"velocity_weakening": {"hyperbolic": strength}}
    campaign = campaign_of(tmp_path, lambda mass, speed: law, 6)
    base = settled_on(campaign, prepared_of(campaign), turns=4)
    first = curves(base, campaign.runs, map_here)[0]
    assert (first.axis, first.on) == ("sliding speed", "mu_k")
    assert first.gain > first.error
    curve, model = refined(base, campaign.runs, first, map_here, looks=2)
    assert model.rms_residual < 1.1 and model.deviance < base.deviance
    true = -np.log(1.0 + strength * curve.values)
    seen = curve.values > 0.02  # below, mu falls from mu_s in these runs
    assert curve.mean[seen] == pytest.approx((true - true.mean())[seen], abs=0.03)
    assert curve.level == pytest.approx(0.2 * np.exp(true.mean()), rel=0.03)
    table = table_of(curve)
    points = {
        of: [table[f"friction.table_{of}[{i}]"] for i in range(1, 17)] for of in ("speed", "mu")
    }
    # the table falls as the law does, not as a slow fall of the contact leaves it to
    speeds, mu = (np.array(points[of]) for of in ("speed", "mu"))
    slides = speeds > 0.05
    assert (np.diff(speeds) > 0.0).all() and (np.diff(mu[slides]) < 0.0).all()
    hyperbola = 1.0 / (1.0 + strength * speeds[slides])
    assert mu[slides] / mu[slides][0] == pytest.approx(hyperbola / hyperbola[0], rel=0.03)
    friction = {"mu_s": 0.3} | {f"table_{of}": tuple(values) for of, values in points.items()}
    drawn = friction_coefficient(Parameters(friction=friction), curve.values[1:])
    assert drawn == pytest.approx(curve.level * np.exp(curve.mean[1:]), rel=0.01)


def test_a_spline_holds_lines_and_is_even_on_its_scale():
    spline = Spline(0.0, 4.0, "root")
    values = np.linspace(0.0, 4.0, 9)
    columns = spline.columns(values)
    assert columns.shape == (9, spline.size) == (9, KNOTS + 1)
    assert columns[:, 0] == pytest.approx(np.sqrt(values) - 1.0)  # -1 to 1
    assert spline.grid(3) == pytest.approx([0.0, 1.0, 4.0])
    assert not spline.columns(np.array([np.nan])).any()
    assert spline.columns(np.array([9.0])) == pytest.approx(spline.columns(np.array([4.0])))
    # what is smooth beside the line is none
    rough = spline.columns(spline.grid(50))[:, 1:]
    assert np.linalg.matrix_rank(np.column_stack([np.ones(50), columns_line(50), rough])) == 8


def columns_line(count):
    return np.linspace(-1.0, 1.0, count)


def test_heat_is_forgotten_exponentially():
    time = np.linspace(0.0, 3.0, 301)
    kept = remembered(time, 2.0 * time, 0.5)
    assert kept == pytest.approx(2.0 * 0.5 * (1.0 - np.exp(-time / 0.5)))


def test_a_table_is_made_of_one_axis_alone():
    line = np.linspace(0.0, 1.0, 5)
    curve = Curve("distance", "mu_k", line, line, line, line, 1.0, 1.0, np.ones(3), 0.2)
    with pytest.raises(ValueError, match="not of mu_k, distance"):
        table_of(curve)
