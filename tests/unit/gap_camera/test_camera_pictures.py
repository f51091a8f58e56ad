"""A camera's picture of an exact motion: no change at nought, as by other means beside it, back."""

import faulty_cameras
import numpy as np
import pytest
from gap_campaigns import NOISE, motion, noisy, write_campaign

from cosim.gap import read_campaign
from cosim.gap.camera.camera import Camera
from cosim.gap.camera.corrected import undone
from cosim.gap.camera.exposure import Exposure
from cosim.gap.camera.faults import QUANTITIES, SENTENCES, fault_of
from cosim.gap.camera.filters import exponential, filtered, gaussian
from cosim.gap.estimation.preparation import prepare
from cosim.gap.estimation.problem import Problem
from cosim.gap.estimation.segmented_run import COLUMN

FRICTION = {"friction.mu_s": 0.3, "friction.mu_k": 0.2}
TIMES = {"measurement.drift_time": 1.0, "measurement.drift_log_time": 0.5}
AMOUNTS = [key for key in QUANTITIES if key not in TIMES and not key.endswith("quantisation")]
SPEED, LOG_TIME = 0.1, {"drift_log_time": 0.5}


@pytest.fixture(scope="module")
def dense():
    """An exact motion at 1 kHz."""
    return motion(speed=SPEED, duration=6.0, interval=1e-3)


@pytest.fixture(scope="module")
def run(dense, tmp_path_factory):
    """The same with noise, x and y measured, in segments."""
    every = faulty_cameras.EVERY
    columns = {"t": dense.time[every], "x": noisy(dense["x"][every], 1)}
    columns["y"] = noisy(dense["y"][every], 2)
    entry = {"surface_speed": SPEED, "columns": columns}
    folder = tmp_path_factory.mktemp("campaign")
    noise = {"x": NOISE, "y": NOISE}
    campaign = read_campaign(write_campaign(folder, [entry], noise=noise))
    return prepare(campaign, campaign.runs, True)[0]


@pytest.mark.parametrize("key", AMOUNTS)
def test_a_fault_of_nothing_changes_no_bit(run, key):
    plain = run.simulate(FRICTION, run.starts)
    nothing = FRICTION | TIMES | {key: 0.0}
    np.testing.assert_array_equal(run.simulate(nothing, run.starts), plain)
    np.testing.assert_array_equal(run.places(nothing, run.starts), plain[:, list(COLUMN.values())])


@pytest.mark.parametrize("key", AMOUNTS)
def test_residuals_are_smooth_in_a_fault(run, key):
    """From nothing on, and in the middle: the difference is that of ten times the step."""
    problem = Problem([run], (), FRICTION | TIMES)
    size = 1e-2 if key.endswith(("smoothing", "smoothing_past")) else 1e-4
    first = 0.0 if key != "measurement.smoothing" else size  # it is felt by its square

    def at(value):
        problem.settings[key] = value
        return problem.residuals(0, (), (), run.starts)

    for middle in (first, first + 10.0 * size):
        step = 1e-2 * size
        small = (at(middle + step) - at(middle)) / step
        large = (at(middle + 10.0 * step) - at(middle)) / (10.0 * step)
        # re-sticks and break-aways shift, which few samples feel out of proportion
        assert np.linalg.norm(small - large) < 0.1 * np.linalg.norm(large)


@pytest.mark.parametrize(
    ("camera", "numbers"),
    [
        (faulty_cameras.scale, {"scale": 0.03}),
        (faulty_cameras.clock, {"clock": 0.03}),
        (faulty_cameras.rotation, {"rotation": 0.05}),
        (faulty_cameras.steady_drift, {"drift_rate_x": 3e-4, "drift_rate_y": 3e-4}),
        (faulty_cameras.settling, {"drift_x": 3e-3, "drift_y": 3e-3, "drift_time": 1.5}),
        (faulty_cameras.logarithmic, {"drift_log_x": 1e-3, "drift_log_y": 1e-3, **LOG_TIME}),
        (faulty_cameras.rolling_shutter, {"latency": 0.02}),
        (faulty_cameras.gaussian, {"smoothing": 0.03}),
        (faulty_cameras.past, {"smoothing_past": 0.03}),
    ],
)  # fmt: skip
def test_picture_is_that_of_a_camera_made_by_other_means(dense, camera, numbers):
    """To a thirtieth of the noise: sums at 1 kHz, against cubics at 100 Hz."""
    path = np.stack([dense["x"], dense["y"]], axis=1)
    time, written = camera(dense.time, path)
    exposure = Exposure.of(
        Camera({f"measurement.{key}": value for key, value in numbers.items()}),
        time,
        noisy(written[:, 0], 3),
    )
    columns = [dense[name] for name in ("x", "y", "phi", "vx", "vy", "omega")]
    # a delay of all samples alike is not in the picture
    moments = exposure.moments + exposure.camera.per_metre * exposure.start
    block = np.stack([np.interp(moments, dense.time, c) for c in columns], axis=1)
    # the last moments of a rolling shutter lie beyond the motion
    inside = exposure.moments[exposure.rows] < dense.time[-1] - 0.02
    made = exposure.written(block[:, :3], block[:, 3:])[:, :2]
    assert np.abs(made - written)[inside].max() < NOISE / 30.0
    if "smoothing" not in str(numbers):
        columns = {"t": time, "x": written[:, 0], "y": written[:, 1]}
        back = undone(exposure.camera, columns)
        true = np.interp(back["t"], dense.time, dense["x"])
        inside = back["t"] < dense.time[-1] - 0.02
        assert np.abs(back["x"] - true)[inside].max() < NOISE / 30.0


def test_written_states_are_the_block_s_own_behind_the_camera(dense):
    """A state that is seen, taken back, and looked at again is the same state."""
    numbers = {"scale": 0.1, "clock": -0.05, "rotation": 0.2, "drift_rate_x": 1e-3, "latency": 0.03}
    camera = Camera({f"measurement.{key}": value for key, value in numbers.items()})
    time = dense.time[faulty_cameras.EVERY]
    exposure = Exposure.of(camera, time, dense["x"][faulty_cameras.EVERY])
    rows = np.array([0, 150, 311])
    seen = np.array([[dense[n][10 * row] for n in ("x", "y", "phi")] for row in rows])
    seen = np.hstack([seen, [[0.1, 0.02, 0.3], [-0.2, 0.0, -1.0], [np.nan, 0.01, 0.0]]])
    true = exposure.true_states(seen, rows, SPEED)
    assert np.isnan(true[2, 3]) and np.isfinite(true[:, :3]).all()
    true[2, 3] = SPEED
    places, rates = np.zeros((time.size, 3)), np.zeros((time.size, 3))
    places[rows], rates[rows] = true[:, :3], true[:, 3:]
    again = exposure.written(places, rates)[rows]
    np.testing.assert_allclose(again[:, :2], seen[:, :2], atol=1e-7)


@pytest.mark.parametrize("kernel", [gaussian, exponential])
def test_kernels_have_their_moments(kernel):
    """Sum 1; a Gaussian has no delay and its variance, an exponential its constant as delay."""
    delays, weights = kernel(0.03)
    assert weights.sum() == pytest.approx(1.0, rel=1e-14)
    delay = 0.0 if kernel is gaussian else 0.03
    assert weights @ delays == pytest.approx(delay, abs=1e-5)
    assert weights @ (delays - delay) ** 2 == pytest.approx(0.03**2, rel=3e-3)


def test_a_filter_knows_no_motion_where_the_model_gave_up():
    time = np.linspace(0.0, 1.0, 101)
    path, rates = np.stack([time], axis=1), np.ones((101, 1))
    path[60:] = np.nan
    made = filtered(time, path, rates, time, gaussian(0.01))
    assert np.isnan(made[60:]).all()
    np.testing.assert_allclose(made[10:50, 0], time[10:50], atol=1e-12)


def test_gaps_are_filled_for_a_filter_alone():
    time = np.concatenate([np.arange(0.0, 1.0, 0.01), np.arange(1.5, 2.0, 0.01)])
    x = np.sin(time)
    filled = Exposure.of(Camera({"measurement.smoothing": 0.02}), time, x)
    assert filled.frames.size > 190 and np.diff(filled.frames).max() < 0.011
    np.testing.assert_array_equal(filled.frames[filled.rows], time)
    assert Exposure.of(Camera({"measurement.clock": 0.1}), time, x).frames.size == time.size


def test_every_number_of_a_fault_has_its_name():
    assert {fault_of(key) for key in QUANTITIES} == set(SENTENCES)
