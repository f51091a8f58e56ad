"""What is doubted of a campaign before it is believed, on the laboratory's data and bad ones."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[2]))
from blind.laboratory.__main__ import write_campaign  # noqa: E402
from blind.laboratory.campaign import Order, make_campaign  # noqa: E402
from gap_campaigns import motion, noisy  # noqa: E402
from gap_campaigns import write_campaign as write_runs  # noqa: E402

from cosim.gap import read_campaign  # noqa: E402
from cosim.gap.doubts import LEVEL, doubts_of, unbelieved  # noqa: E402
from cosim.gap.doubts.springs import stiffness_of  # noqa: E402


@pytest.fixture(scope="module")
def sound(tmp_path_factory):
    """Of another contact than the model's, and scatter: nothing hidden, as stated."""
    folder = tmp_path_factory.mktemp("sound")
    write_campaign(make_campaign(Order("smooth", scatter=0.02), [5]), folder)
    return read_campaign(folder)


def changed(campaign, change):
    return replace(campaign, runs=tuple(change(run) for run in campaign.runs))


def with_track(run, **channels):
    return replace(run, track=replace(run.track, **channels))


def checks(campaign):
    return {doubt.check for doubt in doubts_of(campaign)}


def test_a_sound_campaign_is_not_doubted(sound):
    assert doubts_of(sound) == ()


#: What is done to every run, and the check that must say so.
BAD = {
    "springs stated twice as stiff": (
        lambda run: replace(run, stiffness=2.0 * run.stiffness), "springs",
    ),
    "a mass stated a sixth too large": (lambda run: replace(run, mass=7 / 6 * run.mass), "springs"),
    "x the wrong way": (lambda run: with_track(run, x=-run.track.x), "direction"),
    "speeds stated a quarter too slow": (
        lambda run: replace(run, surface_speed=0.75 * run.surface_speed), "stick_speed",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", BAD)
def test_what_is_not_as_stated_is_doubted_and_nothing_believed(case, sound):
    change, check = BAD[case]
    doubts = doubts_of(changed(sound, change))
    assert {doubt.check for doubt in doubts} >= {check}
    mine = [doubt for doubt in doubts if doubt.check == check]
    assert mine[0] in unbelieved(mine, ("velocity_weakening", "film_drag"))
    for doubt in mine:  # names run, figure and what would be expected
        assert doubt.run and "expected" in doubt.text
        assert all(name in doubt.text for name in doubt.run.split(", "))


def test_one_run_with_a_wrong_set_point_is_the_one_that_is_named(tmp_path):
    runs = [
        {"surface_speed": speed, "columns": columns(speed, number, noise=5e-5)}
        for number, speed in enumerate((0.02, 0.03, 0.05))
    ]
    runs[1]["surface_speed"] = 0.04
    campaign = read_campaign(write_runs(tmp_path, runs, noise={"x": 5e-5}))
    (doubt,) = doubts_of(campaign)
    assert (doubt.check, doubt.run, doubt.expected) == ("stick_speed", "run02", 0.04)
    assert doubt.figure == pytest.approx(0.03, rel=0.02)
    assert "surface_speed = 0.04 m/s" in doubt.text


def columns(speed, seed, duration=20.0, interval=0.01, noise=2e-4, **more):
    done = motion(speed=speed, duration=duration, interval=interval, **more)
    return {"t": done.time, "x": noisy(done["x"], seed, noise)}


def fast(folder, interval, duration=20.0, speeds=(0.2, 0.3), noise=None):
    """Runs that never stick, so that what is sampled too slowly is motion all the time."""
    runs = [
        {
            "surface_speed": speed,
            "columns": columns(speed, number, duration, interval, initial={"x": 0.03}),
        }
        for number, speed in enumerate(speeds)
    ]
    return read_campaign(write_runs(folder, runs, **({"noise": noise} if noise else {})))


def test_a_noise_that_is_motion_is_no_noise(tmp_path):
    (doubt,) = doubts_of(fast(tmp_path, 0.1))
    assert doubt.check == "sampling" and doubt.decisive
    assert doubt.figure == pytest.approx(4.7, abs=0.1)  # samples in a period of 0.47 s
    assert doubt.expected > 15.0 and "sample faster" in doubt.text


def test_a_noise_that_is_given_is_not_taken_from_the_motion(tmp_path):
    assert "sampling" not in checks(fast(tmp_path, 0.1, noise={"x": 2e-4}))


def test_dense_samples_tell_noise_from_motion(tmp_path):
    assert checks(fast(tmp_path, 0.005, duration=10.0)) == set()


def test_seconds_and_runs_that_are_too_few_are_said(tmp_path):
    campaign = fast(tmp_path, 0.01, duration=1.0, noise={"x": 2e-4})
    (doubt,) = doubts_of(campaign)
    assert (doubt.check, doubt.figure, doubt.decisive) == ("record", pytest.approx(2.0), True)
    assert doubt.expected > 4.0
    alone = replace(campaign, runs=campaign.runs[:1])
    assert checks(alone) == {"record", "runs"}


@pytest.mark.parametrize("ratio", [0.7, 1.0, 1.6])
def test_the_springs_are_read_off_the_slips(ratio, tmp_path):
    """Of an exact motion with white noise: to the error that is stated, and to a percent."""
    campaign = fast(tmp_path, 0.01, noise={"x": 2e-4})
    run = replace(campaign.runs[0], stiffness=campaign.runs[0].stiffness / ratio)
    told = stiffness_of(run)
    assert told.ratio == pytest.approx(ratio, rel=0.01)
    assert abs(told.ratio - ratio) < 5.0 * told.error


def test_what_hardens_the_springs_explains_their_period(sound):
    doubts = doubts_of(changed(sound, BAD["springs stated twice as stiff"][0]))
    assert not unbelieved(doubts, ("spring_hardening", "velocity_weakening"))


@pytest.fixture(scope="module")
def foreign(shared):
    """The foreign campaigns, with what is hidden in them."""
    return shared("data/blind_campaigns"), shared("data/blind_examples")


#: Those in which the springs are not as stated: a second mass on a spring, hardening springs.
OTHERWISE = {"h09", "h15", "h16", "e5"}


@pytest.mark.slow
def test_foreign_campaigns_are_doubted_where_they_are_not_as_stated_alone(foreign):
    for folder in foreign:
        for file in sorted(folder.glob("*/campaign.toml")):
            found = checks(read_campaign(file))
            assert found == ({"springs"} if file.parent.name in OTHERWISE else set()), file


def test_the_stated_level_is_that_of_all_runs():
    from cosim.gap.doubts.doubt import far

    rng = np.random.default_rng(1)
    worst = np.abs(rng.standard_normal((200_000, 6))).max(axis=1)
    share = np.mean(worst > far(6))
    assert share == pytest.approx(LEVEL, abs=3.0 * np.sqrt(LEVEL / worst.size))


@pytest.mark.parametrize(("factor", "words"), [(-1.0, "its sign"), (1.2, "check the stiffness")])
def test_a_force_that_is_not_the_springs_is_doubted(factor, words, tmp_path):
    """And one that is, is not: K = 4 k, positive where x is."""
    runs = [{"columns": columns(0.06, number)} for number in range(2)]
    force = [4.0 * 38.5 * run["columns"]["x"] for run in runs]
    for run, values in zip(runs, force, strict=True):
        run["columns"]["force"] = noisy(values, 3, 0.02)
    runs[1]["columns"]["force"] *= factor
    (doubt,) = doubts_of(read_campaign(write_runs(tmp_path, runs, noise={"x": 2e-4})))
    assert (doubt.check, doubt.run, doubt.decisive) == ("force", "run02", False)
    assert doubt.figure == pytest.approx(factor * doubt.expected, rel=0.02) and words in doubt.text
