"""Where a surface runs up a run counts from where it has its speed; nothing else is cut off."""

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, motion

from cosim.gap import MeasuredRun, Track
from cosim.gap.data.run_up import after_run_up, run_up
from cosim.gap.weak_form.track import GridTrack

PERIOD = 2.0 * np.pi / np.sqrt(4.0 * KNOWN["stiffness"] / KNOWN["mass"])


def run_of(time, x, speed, noise=NOISE):
    track = Track(time, x + noise * np.random.default_rng(1).standard_normal(x.size))
    return MeasuredRun("run01", None, KNOWN["mass"], KNOWN["stiffness"], speed, -8.0, False,
                       track, None, {"x": noise})  # fmt: skip


def left_out(run):
    """(s, remarks) of a campaign of this run alone."""
    (kept,), remarks = after_run_up((run,))
    return kept.motion.time_offset, remarks


@pytest.mark.parametrize("speed", [0.06, -0.06, 0.15])
@pytest.mark.parametrize("lasts", [1.0, 3.0, 10.0])
@pytest.mark.parametrize("drag", [0.0, 0.5])
def test_all_of_a_run_up_is_left_out_and_no_fifth_more(speed, lasts, drag):
    """The block sticks and slips at the set-point, or rests on it; it lets go before or after."""
    moved = motion(speed=speed, duration=20.0, run_up=lasts, film_drag={"coefficient": drag})
    cut, (remark,) = left_out(run_of(moved.time, moved["x"], speed))
    assert lasts <= cut < 1.2 * lasts + PERIOD
    assert "run01: the surface runs up to its speed: the first" in remark


def test_a_record_may_begin_within_the_run_up():
    moved = motion(speed=0.06, duration=20.0, run_up=10.0)
    late = moved.time >= 1.5
    cut, _ = left_out(run_of(moved.time[late] - 1.5, moved["x"][late], 0.06))
    assert 0.8 * 8.5 < cut < 1.2 * 8.5


@pytest.mark.parametrize("speed", [0.02, 0.06, 0.3, 1.5])
@pytest.mark.parametrize(
    "blocks", [{}, {"speed_ripple": {"amplitude": 0.4, "frequency": 0.6}},
               {"film_drag": {"coefficient": 0.5}}],
)  # fmt: skip
def test_nothing_is_left_out_of_a_steady_run(speed, blocks):
    moved = motion(speed=speed, **blocks)
    assert left_out(run_of(moved.time, moved["x"], speed)) == (0.0, [])


@pytest.mark.parametrize(
    ("part", "vibrations", "is_cut"),
    [(0.82, 0.7, True), (0.86, 0.7, False), (0.3, 0.37, True), (0.3, 0.33, False)],
)
def test_a_first_rise_that_is_slow_and_long_is_of_a_run_up(part, vibrations, is_cut):
    """At this part of the set-point, for so many vibrations, from a quarter to nine tenths."""
    rise = vibrations * PERIOD / (np.sqrt(0.9) - np.sqrt(0.25))
    time = np.arange(0.0, 30.0, 0.005)
    top = part * 0.1 * vibrations * PERIOD / 0.65
    after = 0.5 * top * (1.0 + np.cos(2.0 * np.pi * (time - rise) / PERIOD))
    x = np.where(time < rise, top * (time / rise) ** 2, after)
    assert (run_up(run_of(time, x, 0.1, noise=1e-6)) > 0.0) is is_cut


@pytest.mark.parametrize(("swings", "stated"), [(2.0, True), (4.0, False)])
def test_noise_of_a_block_at_rest_is_no_stiffness(swings, stated):
    """What smoothing makes of it swings far faster; so do springs of four times the stiffness."""
    time = np.arange(0.0, 20.0, 0.01)
    x = np.sqrt(2.0 * (swings**2 - 1.0)) * NOISE * np.sin(4.0 * np.pi / PERIOD * time)
    run = run_of(time, x, 0.3)
    assert (GridTrack.of(run).omega == run.natural_frequency) is stated
