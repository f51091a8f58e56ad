"""Data are checked before fitting: what is as stated is not doubted, and limits are where they are.

Limits are tried from both sides, so closely that a third more or less of one is noticed.
"""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, RIG, motion
from scipy.ndimage import gaussian_filter1d
from scipy.optimize import brentq

from cosim.gap import Campaign, CampaignError, MeasuredRun, Track
from cosim.gap.checks import LEVEL, doubts_of, tracker
from cosim.gap.checks import motion as in_motion
from cosim.gap.checks.level import far
from cosim.gap.data.campaign_file import Rig
from cosim.gap.data.units import COARSEST, MOST_FRICTION, check_units, cycle_of, friction_of, swing
from cosim.gap.naming import Naming
from cosim.gap.windows import user_model
from cosim.gap.windows.user_model import breaks_away

SPEEDS = (0.03, 0.06, 0.3)
#: Stated errors of the speed, beside what a sheared contact makes; of springs, beside friction.
OF_SPEED, OF_SPRINGS = math.hypot(0.01, 0.02), math.hypot(0.01, 0.02)


def run_of(speed, number=1, noise=NOISE, filtered=None, **more):
    """A run as the tracker has it. filtered : what it makes of places and noise."""
    done = motion(speed=speed, **more)
    draw = np.random.default_rng(number)
    x = done["x"] + noise * draw.standard_normal(done.time.size)
    return MeasuredRun(
        f"run{number:02d}", None, KNOWN["mass"], KNOWN["stiffness"], speed, -8.0, False,
        Track(done.time, x if filtered is None else filtered(x)), None, {"x": noise},
    )  # fmt: skip


def campaign_of(runs):
    return Campaign(
        "made", Path(), Rig(spring_natural_length=0.17), "exact", {"x": NOISE}, (), tuple(runs)
    )


def with_track(run, **channels):
    return replace(run, track=replace(run.track, **channels))


@pytest.fixture(scope="module")
def sound():
    assert RIG == {"spring_natural_length": 0.17}
    return campaign_of([run_of(speed, number) for number, speed in enumerate(SPEEDS, 1)])


def changed(campaign, change, *numbers):
    """Some runs, or all, changed."""
    places = [number - 1 for number in numbers] or range(len(campaign.runs))
    runs = [change(run) if i in places else run for i, run in enumerate(campaign.runs)]
    return replace(campaign, runs=tuple(runs))


def thinned(run, hertz):
    rows = slice(None, None, round(1.0 / hertz / run.track.interval))
    return with_track(run, time=run.track.time[rows], x=run.track.x[rows])


def smoothed(run, width):
    return with_track(run, x=gaussian_filter1d(run.track.x, width / run.track.interval))


def test_what_is_as_stated_is_not_doubted(sound):
    assert doubts_of(sound) == ()
    back = changed(
        sound,
        lambda run: replace(with_track(run, x=-run.track.x), surface_speed=-run.surface_speed),
    )
    assert doubts_of(back) == ()


#: What is done to runs, which ones, and the check, words and severity of what must be said.
WRONG = {
    "stiffness": (lambda r: replace(r, stiffness=2.0 * r.stiffness), (), "springs", "Hz", True),
    "mass": (lambda r: replace(r, mass=1.15 * r.mass), (), "springs", "0.87 kg", False),
    "speed": (
        lambda r: replace(r, surface_speed=1.25 * r.surface_speed), (2,), "speed",
        "run02: surface_speed = 0.075 m/s, but x moves at 0.0", True,
    ),
    "sign": (lambda r: with_track(r, x=-r.track.x), (), "direction", "sign of x", True),
    "mm/s": (
        lambda r: replace(r, surface_speed=1e3 * r.surface_speed), (2,), "units",
        "run02: surface_speed = 60 m/s, but x moves at 0.", True,
    ),
    "g": (lambda r: replace(r, mass=1e3 * r.mass), (), "units", "mass in g", True),
    "8 Hz": (lambda r: thinned(r, 8.0), (), "sampling", "too few samples", True),
    "25 ms": (lambda r: smoothed(r, 0.025), (), "smoothed", "not white", True),
    "noise": (lambda r: replace(r, noise={"x": 2.0 * NOISE}), (), "noise", "0.4 mm", False),
}  # fmt: skip


@pytest.mark.parametrize("case", WRONG)
def test_what_is_not_as_stated_is_doubted(case, sound):
    change, numbers, check, words, severe = WRONG[case]
    doubts = doubts_of(changed(sound, change, *numbers))
    mine = [doubt for doubt in doubts if doubt.check == check]
    assert mine and any(doubt.severe for doubt in mine) == severe, doubts
    assert words in mine[0].text and "\n" not in mine[0].text
    assert not numbers or {name for doubt in mine for name in doubt.runs} == {
        f"run{number:02d}" for number in numbers
    }


def said(doubts, check):
    return any(doubt.check == check for doubt in doubts)


@pytest.mark.parametrize(
    ("log", "doubted"), [(0.9, False), (1.2, True), (-0.9, False), (-1.15, True)]
)
def test_the_speed_in_sticks_is_that_of_the_surface(log, doubted, sound):
    """In parts of the limit; to the lower side a contact may creep."""
    limit = far(3) * OF_SPEED - (math.log1p(-in_motion.CREEPS) if log < 0.0 else 0.0)
    off = math.exp(-log * limit)
    doubts = doubts_of(changed(sound, lambda r: replace(r, surface_speed=off * 0.06), 2))
    assert said(doubts, "speed") == doubted


@pytest.mark.parametrize(("ratio", "severe"), [(1.12, False), (1.18, True)])
def test_another_set_point_is_severe(ratio, severe, sound):
    doubts = doubts_of(changed(sound, lambda r: replace(r, surface_speed=0.06 / ratio), 2))
    assert [doubt.severe for doubt in doubts if doubt.check == "speed"] == [severe]


def test_a_scale_of_all_runs_is_one_doubt():
    runs = [run_of(speed, number) for number, speed in enumerate((0.02, 0.04, 0.06), 1)]
    scaled = changed(campaign_of(runs), lambda run: with_track(run, x=1.08 * run.track.x))
    (doubt,) = [doubt for doubt in doubts_of(scaled) if doubt.check == "speed"]
    assert doubt.text.startswith("all runs") and "1.08 times" in doubt.text and not doubt.severe


@pytest.mark.parametrize(("ratio", "check"), [(2.8, "speed"), (3.2, "units"), (0.31, "units")])
@pytest.mark.parametrize("every", [True, False])
def test_a_surface_that_is_three_times_as_fast_is_in_another_unit(ratio, check, every):
    """Of one run, or of all: no crest of a drive is, so no finding can answer it."""
    runs = [run_of(speed, number) for number, speed in enumerate((0.03, 0.04, 0.06), 1)]
    for number in range(3) if every else [1]:
        speed = runs[number].surface_speed / ratio
        runs[number] = replace(runs[number], surface_speed=speed)
    (doubt,) = [one for one in in_motion.doubts_of_speed(campaign_of(runs), runs) if one.severe]
    assert (doubt.check, "another unit?" in doubt.text) == (check, check == "units")
    assert doubt.text.startswith("all runs" if every else "run02")


@pytest.mark.parametrize(("ripple", "severe"), [(0.0, True), (0.4, False)])
def test_a_surface_that_is_now_slower_and_now_faster_has_no_other_set_point(ripple, severe):
    """A block that sticks at the crests of a ripple is carried faster than stated."""
    run = run_of(0.02, 1)
    slopes = 0.02 * np.array([1.0 - ripple, *[1.25] * 39])
    sticks = slopes, np.full(slopes.size, 1.0)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(in_motion, "_sticks_at", lambda run, speed: sticks)
        (doubt,) = in_motion.doubts_of_speed(campaign_of([run]), [run])
    assert doubt.severe is severe


def test_crests_of_a_vibration_are_no_sticks():
    for speed in (0.2, 0.4):
        for seed in range(5):
            run = run_of(speed, seed, initial={"x": 0.03}, duration=10.0)
            assert in_motion.stick_speed(replace(run, surface_speed=2.0 * speed)) is None


@pytest.mark.parametrize("log", [-1.2, -0.8, 0.8, 1.2])
def test_slips_swing_as_stated(log, sound):
    """In parts of the limit."""
    off = math.exp(log * far(1) * OF_SPRINGS)
    doubts = doubts_of(changed(sound, lambda run: replace(run, stiffness=off * run.stiffness)))
    assert said(doubts, "springs") == (abs(log) > 1.0)


@pytest.mark.parametrize(("ratio", "severe"), [(0.75, False), (0.65, True), (3.0, False)])
def test_springs_are_read_off_slips(ratio, severe, sound):
    """Softer ones than anything makes are severe; harder ones are an effect."""
    stated = changed(sound, lambda run: replace(run, stiffness=run.stiffness / ratio))
    found, error = in_motion.stiffness_ratio(stated, stated.runs[1])
    assert found == pytest.approx(ratio, rel=0.03) and abs(found - ratio) < 5.0 * error
    assert [d.severe for d in doubts_of(stated) if d.check == "springs"] == [severe]


@pytest.mark.parametrize("part", [0.8, 1.2])
def test_friction_carries_the_block_along(part, sound):
    run = sound.runs[0]
    momentum = swing(run.track.x) / (run.natural_frequency * run.track.duration)
    least = far(1) * 5e-4 + momentum
    turned = with_track(run, x=run.track.x - run.track.x.mean() - part * least)
    assert bool(in_motion.doubts_of_direction(sound, [turned])) == (part > 1.0)


def test_units_are_told_where_the_limits_say(sound):
    run = sound.runs[1]
    cycle = cycle_of(run)
    for part in (0.9, 1.1):
        period = cycle / (part * in_motion.SHORT_CYCLE)
        heavy = replace(run, mass=run.total_stiffness * (period / (2.0 * math.pi)) ** 2)
        assert bool(in_motion.doubts_of_units([heavy])) == (part < 1.0)


def refused(run):
    """What the reader says of a run whose numbers are in another unit."""
    try:
        check_units(run, Rig())
    except CampaignError as error:
        return str(error)
    return ""


def test_units_are_refused_where_the_limits_say(sound):
    run = sound.runs[1]
    for part in (0.9, 1.1):
        large = with_track(run, x=part * MOST_FRICTION / friction_of(run) * run.track.x)
        assert ("metres" in refused(large)) == (part > 1.0)
        dense = round(COARSEST * 2.0 * math.pi / run.natural_frequency / 0.01 * part)
        coarse = with_track(run, time=run.track.time * dense)
        assert ("between samples" in refused(coarse)) == (part > 1.0)


@pytest.mark.parametrize("step", [0.3, 0.36])
def test_slips_want_samples(step, sound):
    """omega times the interval: a third at most."""
    run = with_track(sound.runs[0], time=np.arange(100) * step / sound.runs[0].natural_frequency)
    doubts = tracker.doubts_of_sampling(sound, [run])
    assert [doubt.severe for doubt in doubts] == ([True] if step > 1.0 / 3.0 else [])


@pytest.mark.parametrize(("coarse", "severe"), [((3,), False), ((2, 3), True)])
def test_runs_of_few_samples_are_simulated_and_others_asked(coarse, severe, sound):
    """Of one run alone nothing can be named."""
    doubted = changed(sound, lambda run: thinned(run, 15.0), *coarse)
    (doubt,) = tracker.doubts_of_sampling(doubted, doubted.runs)
    assert doubt.severe == severe
    assert ("effects are looked for in the other runs" in doubt.text) != severe
    names = [rows.track.run.name for rows in Naming.of(doubted).rows]
    assert names == [run.name for run in doubted.runs if severe or run.name not in doubt.runs]


@pytest.mark.parametrize("factor", [1.0 / 1.45, 1.0 / 1.25, 1.25, 1.45])
def test_noise_is_as_stated(factor, sound):
    louder = changed(sound, lambda run: replace(run, noise={"x": factor * NOISE}))
    assert said(tracker.doubts_of_noise(louder, louder.runs), "noise") == (
        abs(math.log(factor)) > 0.3
    )


@pytest.mark.parametrize("size", [200, 2000])
def test_third_differences_of_white_noise_scatter_as_foretold(size):
    """Mean and variance of their autocorrelation, of which the level is made."""
    draws = np.random.default_rng(1).standard_normal((2000, size))
    thirds = np.diff(draws, 3, axis=1)
    products = np.mean(thirds[:, 1:] * thirds[:, :-1], axis=1) / np.mean(thirds**2, axis=1)
    assert np.mean(products) == pytest.approx(tracker.WHITE, abs=0.01)
    assert size * np.var(products) == pytest.approx(tracker.BARTLETT, rel=0.15)


def raised(side):
    """By how much a filter (a, 1 - 2 a, a) makes neighbours' third differences go together."""
    taps = np.convolve([1.0, -3.0, 3.0, -1.0], [side, 1.0 - 2.0 * side, side])
    return float(taps[1:] @ taps[:-1] / (taps @ taps)) - tracker.WHITE


@pytest.mark.parametrize("part", [0.85, 1.15])
def test_a_tracker_that_smooths_is_told_from_one_that_does_not(part):
    side = brentq(lambda a: raised(a) - part * tracker.SMOOTHED, 0.0, 0.2)
    taps = [side, 1.0 - 2.0 * side, side]
    runs = [
        run_of(0.004, number, duration=60.0, filtered=lambda x: np.convolve(x, taps, "same"))
        for number in (1, 2)
    ]
    # what a filter takes of the noise is not stated, here
    doubts = tracker.doubts_of_noise(campaign_of(runs), runs)
    assert said(doubts, "smoothed") == (part > 1.0)


@pytest.mark.parametrize("decimals", [1e-9, 1e-6])
@pytest.mark.parametrize("step", [2.37e-4, 1e-3, 3.9e-3])
def test_steps_are_found(step, decimals):
    def written(x):
        x = step * np.round(x / step) + 1.23e-4
        x[::300] += 30.0 * NOISE
        return decimals * np.round(x / decimals)

    run = run_of(0.1, filtered=written)
    found, share = tracker.lattice(run.track.x)
    assert found == pytest.approx(step, rel=2e-3) and share > 0.98
    (doubt,) = tracker.doubts_of_noise(campaign_of([run]), [run])
    assert doubt.check == "steps" and not doubt.severe


def test_steps_of_some_runs_are_told_with_their_names():
    runs = [run_of(0.1, number) for number in range(3)]
    runs[1] = run_of(0.1, 1, filtered=lambda x: 4e-3 * np.round(x / 4e-3))
    runs = [replace(run, name=f"run0{number}") for number, run in enumerate(runs)]
    (doubt,) = tracker.doubts_of_noise(campaign_of(runs), runs)
    assert (doubt.check, doubt.runs) == ("steps", ("run01",))
    assert doubt.text.startswith("run01: 100 % of x are multiples of 4 mm")


@pytest.mark.parametrize("decimals", [1e-9, 1e-6, 1e-5])
def test_decimals_of_a_file_are_no_steps(decimals):
    for seed in range(20):
        run = run_of(0.1, seed, filtered=lambda x: decimals * np.round(x / decimals), duration=5.0)
        assert tracker.lattice(run.track.x)[0] < 1.01 * decimals
        assert tracker.doubts_of_noise(campaign_of([run]), [run]) == []


@pytest.mark.parametrize(
    ("noise", "estimated", "factor"),
    [(1.0, (), 0.0), (0.2, (), 1.756), (0.6, (), 1.110), (0.65, (), 0.0), (0.35, ("x",), 1.0)],
)
def test_steps_that_would_look_like_something_missing_are_coarse(noise, estimated, factor):
    """Steps of 1 mm, beside noise that is stated, mm, or that was taken from the samples."""
    run = run_of(0.1, noise=2e-4, filtered=lambda x: 1e-3 * np.round(x / 1e-3))
    campaign = campaign_of([replace(run, noise={"x": 1e-3 * noise})])
    (made,) = tracker.with_rounding(replace(campaign, noise_estimated=estimated)).runs
    assert bool(made.rounding) == bool(factor)
    if factor:
        assert made.rounding["x"] == pytest.approx((1e-3, factor), rel=2e-3)
        assert made.noise["x"] == pytest.approx(1e-3 * noise * factor, rel=2e-3)
        assert tracker.doubts_of_noise(campaign, [made]) == []


def test_runs_of_few_levels_have_the_step_of_the_others():
    """Of 4 mm, in a swing of 4 mm: two levels alone are no lattice."""
    coarse = 4e-3
    runs = [run_of(0.2, filtered=lambda x: coarse * np.round(x / coarse)),
            run_of(0.2, 1, filtered=lambda x: coarse * np.round(0.1 * x / coarse)),
            run_of(0.2, 2)]  # fmt: skip
    assert tracker.lattice(runs[1].track.x) == (0.0, 0.0)
    made = tracker.with_rounding(campaign_of(runs)).runs
    assert [run.rounding["x"][0] if run.rounding else 0.0 for run in made] == pytest.approx(
        [coarse, coarse, 0.0]
    )


@pytest.mark.parametrize("coarse", [4e-3, 5e-3, 6e-3])
def test_where_coarse_steps_hide_every_stick_static_friction_is_fitted(coarse):
    """Two to four steps in a swing: no stick is seen, and mu_s is about where it turns."""
    run = run_of(0.03, filtered=lambda x: coarse * np.round(x / coarse))
    assert not breaks_away(run)
    (made,) = tracker.with_rounding(campaign_of([run])).runs
    numbers = {each.key: each.start for each in user_model(campaign_of([made]))[0]}
    assert numbers["friction.mu_s"] == pytest.approx(0.3, rel=0.25)
    assert "friction.mu_s" not in {each.key for each in user_model(campaign_of([run]))[0]}


def test_a_step_is_felt_at_the_stated_level():
    """Variances of noise alone: as often beyond the smallest step that is felt as is stated."""
    samples, level = 400, 0.05
    steps = np.linspace(0.1, 3.0, 2901)
    least = next(step for step in steps if tracker.felt(step, 1.0, samples) < level)
    noise = np.random.default_rng(1).standard_normal((4000, samples))
    beyond = np.mean(np.mean(noise**2, axis=1) > 1.0 + least**2 / 12.0)
    assert beyond == pytest.approx(level, abs=0.0125)  # 3.6 standard errors


def test_the_stated_level_is_that_of_all_runs():
    worst = np.abs(np.random.default_rng(1).standard_normal((200_000, 6))).max(axis=1)
    share = np.mean(worst > far(6))
    assert share == pytest.approx(1e-3, abs=3.0 * np.sqrt(1e-3 / worst.size)) and LEVEL == 1e-3


@pytest.mark.parametrize(("cycles", "doubted", "severe"), [(2, 1, 1), (7, 1, 0), (10, 0, 0)])
def test_seconds_that_are_too_few_are_said(cycles, doubted, severe):
    """A window of three cycles in each run, and two more, here in the first."""
    runs = [
        run_of(0.1, number, interval=0.005, duration=0.5 * count)
        for number, count in enumerate((cycles, min(cycles, 5)), 1)
    ]
    assert cycle_of(run_of(0.1)) == pytest.approx(0.49, abs=0.01)
    found = [d.severe for d in doubts_of(campaign_of(runs)) if d.check == "record"]
    assert found == [bool(severe)] * doubted


def test_a_single_run_is_said(sound):
    (doubt,) = doubts_of(replace(sound, runs=sound.runs[:1]))
    assert (doubt.check, doubt.severe) == ("runs", False)


@pytest.mark.parametrize(
    ("factor", "words"), [(1.0, None), (-1.0, "its sign"), (1.06, None), (1.2, "stiffness, scale")]
)
def test_a_force_is_that_of_the_springs(factor, words, sound):
    """K = 4 k, positive where x is."""

    def pulled(run):
        noise = 0.02 * np.random.default_rng(9).standard_normal(run.track.x.size)
        force = factor * run.total_stiffness * run.track.x + noise
        return replace(with_track(run, force=force), noise={"x": NOISE, "force": 0.02})

    doubts = doubts_of(changed(sound, pulled, 2))
    assert [doubt.check for doubt in doubts] == (["force"] if words else [])
    assert all(words in doubt.text and not doubt.severe for doubt in doubts)
