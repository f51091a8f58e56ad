"""Residual analysis by regime against known misfits: the model's exact track, moved by a force."""

import dataclasses

import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy
from stickslip.packing import GRAVITY

from cosim.gap.data import MeasuredRun, Track, find_sticks
from cosim.gap.diagnostics import (
    ModelTrack,
    analyse_residuals,
    find_where,
    pattern_wavelength,
    ripple_frequency,
)
from cosim.gap.diagnostics.where import told_chance
from cosim.gap.show.regime_figure import draw_regimes

SPEEDS = (0.02, 0.06, 0.12)


def tracks(measured, modelled=None, masses=(0.87,), speeds=SPEEDS, seed=0, period=3.0):
    """Exact motions with noise beside those of a model; blocks as `motion` takes them.

    The model starts anew from the measured motion every `period` seconds, as a fit does.
    """
    return [
        beside(speed, mass, measured, modelled or {}, 10 * seed + 100 * i + j, period)
        for i, mass in enumerate(masses)
        for j, speed in enumerate(speeds)
    ]


def beside(speed, mass, measured, modelled, seed, period):
    true = motion(speed=speed, mass=mass, **measured)
    model = restarted(true, speed, mass, modelled, period)
    noise = {"x": NOISE, "y": NOISE}
    track = Track(true.time, noisy(true["x"], seed), noisy(true["y"], seed + 5000))
    run = MeasuredRun(
        f"{mass:g} kg, {speed:g} m/s", None, mass, 38.5, speed, -8.0, False, track, noise=noise
    )
    sticks = find_sticks(track, speed, run.natural_frequency, NOISE)
    return ModelTrack(dataclasses.replace(run, sticks=sticks), **model)


def restarted(true, speed, mass, modelled, period):
    """The model's track, started at the true state at the first slip of every period."""
    slips = np.flatnonzero(true["mode"] == 1.0)
    starts = [0]
    while starts[-1] + period / 0.01 < len(true.time) - 50:
        due = starts[-1] + int(period / 0.01)
        starts.append(int(slips[np.argmin(np.abs(slips - due))]))
    columns = {name: np.empty(len(true.time)) for name in ("x", "y", "vx", "mode")}
    segment = np.zeros(len(true.time), dtype=int)
    for number, (first, last) in enumerate(zip(starts, [*starts[1:], None], strict=True)):
        part = slice(first, last)
        initial = {name: float(true[name][first]) for name in ("x", "y", "vx", "vy")}
        length = max(len(true.time[part]) - 1, 1) * 0.01
        run = motion(speed=speed, mass=mass, duration=length, initial=initial, **modelled)
        for name, values in columns.items():
            values[part] = run[name][: len(values[part])]
        segment[part] = number
    return columns | {"segment": segment}


def region(analysis, channel, regime):
    return next(r for r in analysis.regions if (r.channel, r.regime) == (channel, regime))


def dependence(found, name):
    return next(d for d in found.dependences if d.variable == name)


@pytest.fixture(scope="module")
def of_noise():
    """Residual analysises of models that lack nothing."""
    return [analyse_residuals(tracks({}, masses=(0.87, 1.5), seed=seed)) for seed in (1, 2)]


def test_noise_alone_is_no_misfit(of_noise):
    for analysis in of_noise:
        assert analysis.rms_residual == pytest.approx(1.0, abs=0.03)
        where = find_where(analysis, slight=0.0)
        assert (where.channel, where.regime, where.runs) == ("", "", ())
        assert where.text.startswith("No misfit beyond the noise in any channel or regime")
        assert analysis.ripple is None and analysis.pattern is None


def test_chances_are_what_they_say(of_noise):
    """Of the tests on noise alone about one in ten is below 0.1."""
    chances = [
        found.log10_p
        for analysis in of_noise
        for part in analysis.regions
        if (part.channel, part.regime) in (("x", "slip"), ("x", "stick"))
        for found in part.dependences
    ]
    assert len(chances) >= 30
    # the tests of one region are not independent of each other: up to three in ten
    assert np.mean(np.array(chances) < -1.0) < 0.3


def test_a_wrong_kinetic_friction_is_found_in_newtons():
    """0.01 too little friction is a force of 0.01 m g, in every run and on nothing dependent."""
    analysis = analyse_residuals(tracks({"mu_k": 0.21}, {"mu_k": 0.2}, masses=(0.87, 1.5)))
    slip = region(analysis, "x", "slip")
    weight = np.array([0.87] * 3 + [1.5] * 3) * GRAVITY
    assert np.all(np.abs(slip.value - 0.01 * weight) < 4.0 * slip.error)
    load = dependence(slip, "load")
    np.testing.assert_allclose(load.value, 0.01 * np.unique(weight), rtol=0.1)
    assert slip.dependences[0].variable in ("load", "hold_time")  # heavy blocks stick longer


def test_friction_that_falls_with_speed():
    effect = {"velocity_weakening": {"linear": 0.5}}
    analysis = analyse_residuals(
        tracks({"mu_k": 0.2, **effect}, {"mu_k": 0.19}, speeds=(0.06, 0.2, 0.4))
    )
    found = dependence(region(analysis, "x", "slip"), "sliding_speed")
    law = (0.2 * (1.0 - 0.5 * found.centre) - 0.19) * 0.87 * GRAVITY
    # a bin's mean speed is not where its mean force acts, by a tenth of a bin or so
    assert np.all(np.abs(found.value - law) < 4.0 * found.error + 0.02)
    where = find_where(analysis)
    assert (where.channel, where.regime) == ("x", "slip")
    assert "depends most clearly on the sliding speed" in where.text


def test_static_friction_that_grows_with_rest():
    effect = {"static_strengthening": {"rate": 0.05}}
    analysis = analyse_residuals(tracks(effect, {"mu_s": 0.37}, speeds=(0.02, 0.04, 0.08)))
    where = find_where(analysis)
    assert (where.channel, where.regime) == ("x", "break-away")
    found = dependence(region(analysis, "x", "break-away"), "hold_time")
    law = (0.3 + 0.05 * np.log10(1.0 + found.centre / 0.01) - 0.37) * 0.87 * GRAVITY
    assert np.all(np.abs(found.value - law) < 4.0 * found.error + 0.03)


def test_springs_that_harden():
    """A force against the position, by its shape: a slip's own level says nothing of position."""
    cubic, stretch = 1e3, 0.03  # N/m3; m, of springs of 0.17 m between points 0.20 m apart
    effect = {"spring_hardening": {"cubic": cubic}}
    analysis = analyse_residuals(tracks(effect, {"mu_k": 0.19}, speeds=(0.06, 0.12)))
    slip = region(analysis, "x", "slip")
    assert slip.dependences[0].variable == "position"
    found = dependence(slip, "position")
    law = -2.0 * cubic * ((stretch + found.centre) ** 3 - (stretch - found.centre) ** 3)
    left = found.value - law
    left -= np.average(left, weights=found.error**-2.0)
    # the force is taken where the measured block is; the model's is up to a tenth elsewhere
    assert np.all(np.abs(left) < 4.0 * found.error + 0.1 * np.ptp(law))


def test_a_place_that_follows_the_friction_is_no_dependence_on_place():
    """Friction that drifts moves the block: not because of where the block is."""
    effect = {"run_in": {"change": -0.2, "distance": 0.5}}
    slip = region(analyse_residuals(tracks({"mu_k": 0.22, **effect}, {"mu_k": 0.19})), "x", "slip")
    assert dependence(slip, "position").log10_p > 0.05 * dependence(slip, "distance").log10_p


def test_friction_that_drifts():
    effect = {"run_in": {"change": -0.2, "distance": 0.5}}
    where = find_where(analyse_residuals(tracks({"mu_k": 0.22, **effect}, {"mu_k": 0.19})))
    assert (where.channel, where.regime) == ("x", "slip")
    assert "the distance slid" in where.text or "the place on the surface" in where.text


def test_a_ripple_of_the_surface_speed():
    effect = {"speed_ripple": {"amplitude": 0.1, "frequency": 1.3}}
    compared = tracks(effect, speeds=(0.02, 0.04, 0.06))
    period = ripple_frequency(compared)
    # resolution: a quarter of a period over 20 s
    assert period.rate == pytest.approx(1.3, abs=0.0125) and period.log10_p < -10.0
    np.testing.assert_allclose(period.amplitude, [0.002, 0.004, 0.006], rtol=0.2)
    where = find_where(analyse_residuals(compared))
    assert (where.channel, where.regime) == ("x", "stick")
    assert "repeats itself every 0.7" in where.text


@pytest.mark.parametrize("wavelength", [0.04, 0.15])
def test_a_pattern_on_the_surface(wavelength):
    effect = {"surface_pattern": {"amplitude": 0.1, "wavelength": wavelength}}
    compared = tracks(effect)
    period = pattern_wavelength(compared)
    assert period.length == pytest.approx(wavelength, rel=0.03) and period.log10_p < -10.0
    where = find_where(analyse_residuals(compared))
    assert "of surface" in where.text
    assert where.regime in ("slip", "break-away")


def test_a_block_that_is_pulled_aside():
    effect = {"spring_misalignment": {"lateral_offset": 0.002}}
    where = find_where(analyse_residuals(tracks(effect)))
    assert where.channel == "y" and "depends on nothing that was looked at" in where.text


def test_a_slight_misfit_is_only_mentioned():
    analysis = analyse_residuals(tracks({"mu_k": 0.2005}, {"mu_k": 0.2}))
    assert analysis.rms_residual < 1.1
    assert find_where(analysis).text.startswith("No misfit that matters")
    assert find_where(analysis, slight=0.0).regime == "slip"


def test_gaps_and_missing_samples():
    compared = tracks({"mu_k": 0.21}, {"mu_k": 0.2})
    track = compared[0]
    track.run.track.x[300:420] = np.nan
    analysis = analyse_residuals(compared)
    slip = region(analysis, "x", "slip")
    assert np.all(np.abs(slip.value - 0.01 * 0.87 * GRAVITY) < 4.0 * slip.error)


def test_nothing_in_common_is_said():
    """A model that never moves on the surface shares no slip with what was measured."""
    compared = tracks({}, speeds=(0.4,))
    alone = [dataclasses.replace(track, mode=np.full(len(track.x), 0.0)) for track in compared]
    alone = [dataclasses.replace(track, y=None) for track in alone]
    where = find_where(analyse_residuals(alone))
    assert where.channel == "" and "share no stretch" in where.text


def test_the_figure_has_a_row_for_each_region(monkeypatch):
    analysis = analyse_residuals(tracks({"mu_k": 0.21}, {"mu_k": 0.2}, speeds=(0.04, 0.06)))
    drawn = draw_regimes.__wrapped__(analysis)
    assert len(drawn.axes) == 4 * len(analysis.regions)
    labels = [axis.get_ylabel() for axis in drawn.axes[::4]]
    assert "x, slip\nfriction force (N)" in labels
    assert draw_regimes(analysis).png.startswith(b"\x89PNG")


@pytest.mark.parametrize(
    ("log10_p", "text"),
    [
        (0.0, "= 1"),
        (-0.5, "= 0.32"),
        (-3.0, "= 0.001"),
        (-6.2, "= 1e-6"),
        (-12.0, "= 1e-12"),
        (-1866.0, "< 1e-12"),
        (-np.inf, "< 1e-12"),
    ],
)
def test_no_probability_is_told_that_no_data_can_give(log10_p, text):
    assert told_chance(log10_p) == text
