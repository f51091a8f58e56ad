"""Faults of the camera: each is put on a simulated track exactly, named, and its size recovered."""

from functools import cache

import numpy as np
import pytest
from gap_campaigns import RIG, campaign_with, motion, noisy
from scipy.special import logsumexp

from cosim.gap.data import Track, read_campaign
from cosim.gap.find import find_gap
from cosim.gap.naming import Naming
from cosim.gap.show.files import write_corrected
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.camera_faults import (
    COURSES,
    FILTERS,
    GAUSSIAN,
    PAST,
    SMOOTHING,
    WINDOW,
    camera_faults,
    leaning,
)
from cosim.gap.weak_form.corners import CORNER, corner_contact, with_corners
from cosim.gap.weak_form.rows import rows_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import smooth
from cosim.gap.windows import camera

NOISE, FINE, EVERY, DURATION = 5e-5, 1e-3, 10, 10.0
#: Speed and mass; the last is held out.
RUNS = ((0.03, 0.87), (0.06, 0.87), (0.1, 0.87), (0.05, 1.6), (0.08, 0.87))
#: How well surface and springs are known, so that a size that is recovered is the fault's.
KNOWN_WELL = {"errors": {"surface_speed": 1e-3, "stiffness": 1e-3}}
ALL = range(len(RUNS))
#: As `written` knows them, in the order of FILTERS.
FILTERED = ("smoothing", "smoothing of the past", "smoothing by a moving average")
#: nats
FOUND = 6.0


@cache
def path(speed, mass):
    """(times, places) every millisecond"""
    moved = motion(speed=speed, mass=mass, duration=DURATION, interval=FINE)
    return moved.time, np.asarray(moved["x"])


def convolved(x, delays, weights):
    """x at its own times, of a filter with weights at delays that are multiples of FINE."""
    margin = int(np.max(np.abs(delays)) / FINE) + 1
    kernel = np.zeros(2 * margin + 1)
    np.add.at(kernel, margin + np.round(delays / FINE).astype(int), weights / weights.sum())
    return np.convolve(np.pad(x, margin, mode="edge"), kernel, mode="valid")


def written(fault, size, t, x):
    """Times and places as a camera with a fault writes them."""
    u = np.arange(-400, 401) * FINE
    if fault == "scale":
        x = (1.0 + size) * x
    elif fault == "clock":
        t = (1.0 + size) * t
    elif fault == "drift":
        x = x + size * np.sqrt(t / t[-1])
    elif fault == "latency":
        x = np.interp(t + size * x / 0.1, t, x)
    elif fault == "smoothing":
        x = convolved(x, u, np.exp(-0.5 * (u / size) ** 2))
    elif fault == "smoothing of the past":
        x = convolved(x, u, np.where(u < 0.0, 0.0, np.exp(-u / size)))
    elif fault == "smoothing by a moving average":
        x = convolved(x, u, (np.abs(u) < np.sqrt(3.0) * size).astype(float))
    elif fault == "zero":
        x = x + size
    return t, x


def system(folder, fault="", size=0.0, among=ALL, runs=RUNS, **tables):
    """Rows of a campaign in which a fault is in some runs."""
    entries = []
    for number, (speed, mass) in enumerate(runs):
        t, x = path(speed, mass)
        if number in among:
            t, x = written(fault, size, t, x)
        columns = {"t": t[::EVERY], "x": noisy(x[::EVERY], number, NOISE)}
        entry = {"surface_speed": speed, "mass": mass, "columns": columns}
        entries.append(entry | {"hold_out": number == 4})
    rig = {**RIG, "degrees_of_freedom": ["x"]}
    campaign = campaign_with(folder, entries, noise={"x": NOISE}, rig=rig, **tables)
    made = System(
        campaign, [with_corners(rows_of(smooth(run), campaign.rig)) for run in campaign.runs]
    )
    made.contact = [*made.contact, *corner_contact()]
    return made


def offers(rung):
    """fault -> (nats that it gains, the best of its variants)"""
    found = {}
    for name, variants in camera_faults(rung).items():
        evidence, added = rung.offered(variants)
        found[name.removeprefix("measurement.")] = (evidence - rung.evidence, added)
    return found


def size_of(made, unknown):
    """(value, standard deviation) of an unknown's first number"""
    added = Added(unknown)
    rung = made.rung([added])
    mean, covariance = rung.posterior
    at = rung.part_of(added).start
    return mean[at], np.sqrt(covariance[at, at])


@pytest.mark.parametrize(
    ("fault", "size", "within"),
    [
        ("scale", 0.03, 0.05),
        ("scale", -0.03, 0.05),
        ("clock", 0.03, 0.08),
        ("clock", -0.03, 0.08),
        ("drift", 2e-3, 0.03),
        ("latency", 0.01, 0.1),
        ("latency", -0.01, 0.1),
    ],
)
def test_sign_and_size_are_recovered(tmp_path, fault, size, within):
    made = system(tmp_path, fault, size, **KNOWN_WELL)
    variants = camera_faults(made.rung())[f"measurement.{fault}"]
    whole = next(v for v in variants if v.variant in ("all runs", "root, all runs"))
    value, sd = size_of(made, whole)
    assert abs(value - size) < within * abs(size) + 3.0 * sd


def test_a_fault_is_as_probable_in_all_runs_as_in_any_of_some(tmp_path):
    """Else rows that hardly tell which runs have it would take some: there are more of these."""
    rung = system(tmp_path, "clock", 0.03, **KNOWN_WELL).rung()
    variants = camera_faults(rung)["measurement.clock"]
    weights = [one.weight for one in variants]
    assert variants[0].variant == "all runs"
    assert weights[0] == 1.0 == pytest.approx(sum(weights[1:]))
    each = [rung.offered([one])[0] for one in variants]
    assert rung.offered(variants)[0] == pytest.approx(logsumexp(each, b=weights) - np.log(2.0))


@pytest.mark.parametrize("fault", FILTERED)
def test_a_filters_width_is_recovered(tmp_path, fault):
    """The unknown of a filter of that width is 1."""
    made = system(tmp_path, fault, 0.02, **KNOWN_WELL)
    _, added = made.rung().offered(camera_faults(made.rung())["measurement.smoothing"])
    part, _ = size_of(made, added.unknown)
    width = added.unknown.settings["width"] * np.sqrt(part)
    assert width == pytest.approx(0.02, rel=0.15)


@pytest.mark.parametrize(
    ("fault", "size"),
    [
        ("clock", 0.03), ("drift", 2e-3), ("latency", 0.01),
        *((fault, 0.02) for fault in FILTERED),
    ],
)  # fmt: skip
def test_a_fault_in_all_runs_is_named(tmp_path, fault, size):
    found = offers(system(tmp_path, fault, size).rung())
    best = max(found, key=lambda name: found[name][0])
    assert best == fault.split()[0]
    assert found[best][0] > FOUND


def test_a_scale_is_named_where_no_contact_creeps(tmp_path):
    """Creep by 1 % of the surface's speed makes sticks as much less steep in all runs."""
    made = system(tmp_path, "scale", 0.03, errors={"surface_speed": 0.005})
    made.contact = [each for each in made.contact if each.variant != "creep"]
    found = offers(made.rung())
    assert found["scale"][0] == max(gain for gain, _ in found.values()) > FOUND


@pytest.mark.parametrize(
    ("fault", "size"), [("clock", 0.03), ("drift", 2e-3), ("latency", 0.02), ("scale", 0.08)]
)
def test_the_runs_with_the_fault_are_told(tmp_path, fault, size):
    found = offers(system(tmp_path, fault, size, among=(0, 3), **KNOWN_WELL).rung())
    gain, added = found[fault]
    assert gain == max(each for each, _ in found.values())
    assert added.unknown.variant.endswith("in run01, run04")


@pytest.mark.parametrize(
    ("fault", "size"),
    [("drift", 4e-3), ("latency", 0.03), pytest.param("scale", 0.08, marks=pytest.mark.slow)],
)
def test_a_fault_is_fitted_and_what_it_took_goes(tmp_path, fault, size):
    """The model that is shown writes as such a camera does: the gap goes down to the noise."""
    key = f"measurement.{fault}"
    gap = find_gap(system(tmp_path, fault, size, among=(0, 3, 4), **KNOWN_WELL).campaign)
    assert (gap.verdict, gap.effects) == ("named", (key,))
    assert gap.before.held_out > 1.5 > 1.1 > max(gap.after.held_out, gap.after.fit)
    assert gap.extended.values[key] == pytest.approx(size, rel=0.1)
    files = write_corrected(gap, tmp_path)
    for run, freed in zip(gap.campaign.runs, read_campaign(files[0]).runs, strict=True):
        there = np.allclose(run.motion.x, freed.motion.x, rtol=0.0, atol=1e-9, equal_nan=True)
        assert there == (run.name in ("run02", "run03"))


@pytest.mark.parametrize("size", [0.02, -0.02])
@pytest.mark.parametrize("fault", ["scale", "drift", "latency"])
def test_a_simulated_camera_writes_as_one_with_the_fault_does(fault, size):
    """What the fit compares with the track, and what a finding is freed of."""
    t, x = path(0.1, 0.87)
    values = {f"measurement.{fault}": size, "measurement.drift_course": [*COURSES].index("root")}
    places = np.column_stack([x, 0.5 * x, 0.0 * x])
    found = camera.seen(places, t, values)
    _, expected = written(fault, size, t, x)
    inside = slice(100, -100)  # of what comes later a late camera knows nothing at the end
    np.testing.assert_allclose(found[inside, 0], expected[inside], rtol=0.0, atol=1e-5)
    aside = (1.0 + size) * 0.5 * x if fault == "scale" else 0.5 * x
    np.testing.assert_allclose(found[:, 1], aside, rtol=0.0, atol=1e-12)
    freed = camera.undone(Track(t, found[:, 0], None), values)
    np.testing.assert_allclose(freed.x[inside], x[inside], rtol=0.0, atol=1e-5)


def test_zeros_beyond_what_is_stated(tmp_path):
    found = offers(system(tmp_path, "zero", 4e-3, among=(1,)).rung())
    assert found["zero"][0] == max(gain for gain, _ in found.values()) > FOUND


def test_nothing_is_found_without_a_fault(tmp_path):
    assert all(gain < FOUND for gain, _ in offers(system(tmp_path).rung()).values())


@pytest.mark.parametrize("breaks", [True, False])
def test_rows_of_corners_are_of_unit_noise_and_of_no_gap(tmp_path, breaks):
    rung = system(tmp_path).rung(contact=False)
    runs = rung.system.fitted
    kinds = np.concatenate([run.kinds for run in runs])
    sides = np.concatenate([[c.breaks for c in run.corners] for run in runs])
    rows = rung.residuals[kinds == CORNER][sides == breaks]
    assert rows.size > 40
    assert abs(rows.mean()) < 3.5 / np.sqrt(rows.size)
    assert np.std(rows) == pytest.approx(1.0, abs=0.2)


def test_a_long_delay_is_taken_whole(tmp_path):
    """40 ms over 0.1 m: strokes of 0.2 m/s lean over by a twelfth, which is not linear in it."""
    entries = []
    for number, (speed, mass) in enumerate([(0.1, 0.87), (0.2, 0.87), (0.2, 1.6)]):
        t, x = path(speed, mass)
        late = leaning(t, x, -0.04)
        np.testing.assert_allclose(leaning(t, late, 0.04)[50:-50], x[50:-50], atol=1e-6)
        columns = {"t": t[::EVERY], "x": noisy(late[::EVERY], number, NOISE)}
        entries.append({"surface_speed": speed, "mass": mass, "columns": columns})
    campaign = campaign_with(tmp_path, entries, noise={"x": NOISE})
    made = System(campaign, [rows_of(smooth(run), campaign.rig) for run in campaign.runs])
    rung = made.rung()
    _, added = rung.offered(camera_faults(rung)["measurement.latency"])
    assert size_of(made, added.unknown)[0] == pytest.approx(0.04, rel=0.03)
    assert made.rung([added]).misfit < 0.01 * rung.misfit


@pytest.mark.parametrize("lost", [slice(100, None), slice(0, None), slice(1, None)])
def test_where_a_model_is_lost_nothing_is_seen(lost):
    """The rest is as it was."""
    t, x = path(0.2, 0.87)
    moved = np.array(x)
    moved[lost] = np.nan
    late = leaning(t, moved, -0.02)
    assert (np.isnan(late) == np.isnan(moved)).all()
    np.testing.assert_allclose(
        late[:80], np.where(np.isnan(moved), np.nan, leaning(t, x, -0.02))[:80]
    )


def test_a_filter_in_some_runs_is_told_where_rounded_swings_ask_for_something_else(tmp_path):
    """A long filter reaches into the slips, where a clock of a run stands for some of it."""
    naming = Naming.of(system(tmp_path, "smoothing", 0.04, among=(0, 3)).campaign)
    assert SMOOTHING not in {each.name for each in naming.named([SMOOTHING]).findings} != set()
    named = naming.named()
    assert SMOOTHING not in {each.name for each in named.findings}
    (finding,) = named.filtered.findings
    assert finding.name == SMOOTHING
    assert finding.variant.endswith("in run01, run04")


@pytest.mark.parametrize("kind", FILTERS)
def test_a_filter_of_simulated_runs_knows_of_lost_samples(kind):
    """A swing of 1.2 Hz of which half a second is lost, as an ideal filter of 50 ms leaves it."""
    time = np.arange(0.0, 10.0, 0.01)
    time, omega, width = time[(time < 4.0) | (time > 4.5)], 2.4 * np.pi, 0.05
    number = float(FILTERS.index(kind))
    values = {"measurement.smoothing": width, "measurement.smoothing_kind": number}
    seen = camera.seen(np.outer(np.sin(omega * time), np.ones(3)), time, values)[:, 0]
    at = omega * width
    factor = {GAUSSIAN: np.exp(-0.5 * at**2), PAST: 1.0 / (1.0 + 1j * at),
              WINDOW: np.sinc(np.sqrt(3.0) * at / np.pi)}[kind]  # fmt: skip
    off = np.abs(seen - np.imag(factor * np.exp(1j * omega * time)))
    is_near = (np.abs(time - 4.25) < 0.5) | (time < 0.25) | (time > 9.75)
    assert off[is_near].max() < 0.12  # half a swing goes by beside each of its samples
    assert off[~is_near].max() < (0.04 if kind == PAST else 1e-3)  # a past of one sample's steps


@pytest.mark.parametrize("kind", FILTERS)
def test_a_filter_sees_nothing_of_a_model_where_it_is_lost(kind):
    """And as much as ever of the rest, but for a sample that stands by itself."""
    time = np.arange(0.0, 4.0, 0.01)
    values = {"measurement.smoothing": 0.05, "measurement.smoothing_kind": FILTERS.index(kind)}
    places = np.outer(0.2 * time, np.ones(3))
    places[[100, *range(102, 200)]] = np.nan
    seen = camera.seen(places, time, values)
    np.testing.assert_array_equal(np.isnan(seen), np.isnan(places))
    late = 0.2 * 0.05 if kind == PAST else 0.0
    np.testing.assert_allclose(seen[250:, 0], 0.2 * time[250:] - late, atol=1e-3)


def test_a_filter_is_one_over_time_whatever_the_samples_times_do():
    """A ramp comes out as it was; samples that jitter by 4 ms at 0.2 m/s are off by 0.8 mm."""
    time = np.arange(0.0, 4.0, 0.02) + np.random.default_rng(1).uniform(-0.007, 0.007, 200)
    seen = camera.seen(np.outer(0.2 * time, np.ones(3)), time, {"measurement.smoothing": 0.05})
    np.testing.assert_allclose(seen[:, 0], 0.2 * time, atol=1e-9)
