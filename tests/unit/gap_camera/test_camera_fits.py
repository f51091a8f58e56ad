"""Each fault of a camera, put into exact motions, comes out of a fit, as precisely as it says."""

import faulty_cameras
import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign
from scipy.stats import norm
from stickslip.effects.candidate import FreeParameter, Scales

from cosim.gap import read_campaign
from cosim.gap.camera.faults import QUANTITIES, SENTENCES, fault_of
from cosim.gap.candidates.extend import extended
from cosim.gap.candidates.measurement import measurement_candidates
from cosim.gap.estimation.intervals import intervals
from cosim.gap.estimation.preparation import prepared
from cosim.gap.estimation.trial import Model, coarse_fit, try_model

SPEEDS = (0.06, 0.15, 0.10)
SECONDS = 6.0
PLAIN = Model(
    (
        FreeParameter("friction.mu_s", 0.29, 0.01, 0.0, 2.0),
        FreeParameter("friction.mu_k", 0.21, 0.01, 0.0, 2.0),
    ),
    {},
)
SCALES = Scales(0.1, 0.6, 1.0, SECONDS, 38.5, 0.02, 0.87, 8.5)
LAWS = {
    (law.effect, law.form): law
    for channels in ("x", "xy")
    for law in measurement_candidates(SCALES, channels)
    if channels == "x" or law.lateral
}
#: Fault, form, camera, what was put in.
FAULTS = (
    ("scale", "factor", faulty_cameras.scale, {"scale": 0.03}),
    ("clock", "factor", faulty_cameras.clock, {"clock": 0.03}),
    ("drift", "linear", faulty_cameras.steady_drift, {"drift_rate_x": 3e-4}),
    ("drift", "settling", faulty_cameras.settling, {"drift_x": 3e-3, "drift_time": 1.5}),
    ("drift", "logarithmic", faulty_cameras.logarithmic, {"drift_log_x": 1e-3}),
    ("latency", "rolling shutter", faulty_cameras.rolling_shutter, {"latency": 0.02}),
    ("smoothing", "Gaussian", faulty_cameras.gaussian, {"smoothing": 0.03}),
    ("smoothing", "of the past", faulty_cameras.past, {"smoothing_past": 0.03}),
)
#: Errors, in standard deviations, that one in a thousand is beyond in one of all that is tested.
FAR = norm.isf(0.5e-3 / sum(len(put_in) for *_, put_in in FAULTS))


@pytest.fixture(scope="module")
def motions():
    return [motion(speed=speed, duration=SECONDS, interval=1e-3) for speed in SPEEDS]


def data_of(folder, motions, camera, across=False):
    runs = []
    for number, (speed, run) in enumerate(zip(SPEEDS, motions, strict=True)):
        t, path = camera(run.time, np.stack([run["x"], run["y"]], axis=1))
        columns = {"t": t, "x": noisy(path[:, 0], number)}
        if across:
            columns["y"] = noisy(path[:, 1], 10 + number)
        runs.append({"surface_speed": speed, "hold_out": number == 2, "columns": columns})
    noise = {"x": NOISE, "y": NOISE} if across else {"x": NOISE}
    campaign = read_campaign(write_campaign(folder, runs, noise=noise))
    return prepared(campaign, campaign.fit_runs, campaign.held_out_runs, across)


def trials(data, law):
    """The plain model, and with a law on top of it where it was fitted."""
    first = coarse_fit(data, PLAIN, 4)
    with_law = extended(PLAIN, law, first.values)
    return try_model(data, PLAIN, first), try_model(data, with_law, coarse_fit(data, with_law, 4))


def check_values(trial, put_in):
    """Within the error that the fit states."""
    for key, true in put_in.items():
        low, high = intervals(trial)[f"measurement.{key}"]
        deviation = (high - low) / (2.0 * 1.96)
        assert abs(trial.fitted.values[f"measurement.{key}"] - true) < FAR * deviation
        assert 10.0 * deviation < abs(true)  # it says something


@pytest.mark.parametrize(("fault", "form", "camera", "put_in"), FAULTS)
def test_fault_is_found_again(motions, tmp_path, fault, form, camera, put_in):
    plain, faulty = trials(data_of(tmp_path, motions, camera), LAWS[f"measurement.{fault}", form])
    check_values(faulty, put_in)
    assert plain.held_out_rms > 1.04  # of 600 samples: one in a hundred of noise alone is above
    assert faulty.held_out_rms < 1.06
    assert faulty.fitted.values["friction.mu_k"] == pytest.approx(0.2, rel=0.02)


def test_turned_axes_are_found_again(motions, tmp_path):
    data = data_of(tmp_path, motions, faulty_cameras.rotation, across=True)
    plain, faulty = trials(data, LAWS["measurement.rotation", "angle"])
    check_values(faulty, {"rotation": 0.05})
    assert plain.held_out_rms > 1.5 and faulty.held_out_rms < 1.06


def test_a_perfect_camera_has_no_fault(motions, tmp_path):
    data = data_of(tmp_path, motions, faulty_cameras.perfect)
    for law in (LAWS["measurement.scale", "factor"], LAWS["measurement.clock", "factor"]):
        plain, faulty = trials(data, law)
        (key,) = (free.key for free in law.free_parameters)
        low, high = intervals(faulty)[key]
        assert abs(faulty.fitted.values[key]) < FAR * (high - low) / (2.0 * 1.96)
        # one free number takes chi squared of one; each fit stops within a small part of one
        assert plain.fitted.cost - faulty.fitted.cost < 11.0


def test_faults_are_offered_where_they_can_be_seen():
    along = measurement_candidates(SCALES, ("x",))
    plane = measurement_candidates(SCALES, ("x", "y", "phi"))
    assert {law.effect for law in plane} - {law.effect for law in along} == {"measurement.rotation"}
    assert {law.effect for law in plane} == set(SENTENCES) - {"measurement.quantisation"}
    for law in plane:
        for free in law.free_parameters:
            assert fault_of(free.key) == law.effect and free.key in QUANTITIES
            assert free.low < free.start < free.high and not free.per_run
    keys = {free.key for law in along for free in law.free_parameters}
    assert not any(key.endswith("_y") for key in keys)
