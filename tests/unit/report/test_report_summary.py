"""The summary against answers known beforehand."""

import json

import numpy as np
import pytest
from stickslip import Parameters, Surface, Trajectory
from stickslip.ports import OUTPUTS
from test_report_dataset import coupled_dataset, mechanics_dataset, trajectory

from cosim.report import summary, trajectory_columns
from cosim.report.contents import break_aways, slip_intervals

RAMP, PERIOD, SLIP, CYCLES = 2.0, 0.5, 0.3, 8
END = RAMP + CYCLES * PERIOD


def made_up(parameters: Parameters | None = None) -> Trajectory:
    """Eight cycles of 0.5 s after the ramp, each slipping in its last 0.3 s; numbers by hand."""
    parameters = parameters or Parameters(surface=Surface(speed=0.1, run_up_time=RAMP))
    time = np.arange(601) * END / 600
    columns = {name: np.zeros(time.size) for name in (port.name for port in OUTPUTS)}
    starts = RAMP + PERIOD - SLIP + PERIOD * np.arange(CYCLES)
    events = [[[t, 1.0, 0.01], [t + SLIP, 0.0, 0.0]] for t in starts]
    events = np.array(events).reshape(-1, 3)[:-1]
    after = np.searchsorted(events[:, 0], time, side="right") - 1
    columns["mode"] = np.where(after < 0, 0.0, events[after, 1])
    columns["slip_count"] = np.searchsorted(starts, time, side="right").astype(float)
    columns["x"] = 0.01 * time / END
    columns["phi"] = np.radians(-12.0) * np.sin(2.0 * np.pi * time / END)
    columns["phi"][-1] = 0.0
    columns["heat"] = 0.5 * time / END
    columns["surface_work"] = 0.6 * time / END
    columns["energy_residual"] = -1e-12 * time / END
    return Trajectory(time, columns, events, parameters)


def numbers(run: Trajectory) -> dict:
    return summary(trajectory_columns(run, run.parameters, "toml").to_xarray())


def test_stick_slip_numbers_of_a_known_run():
    late = numbers(made_up())["after_run_up"]
    assert late["begin"] == RAMP and late["duration"] == pytest.approx(END - RAMP)
    assert late["break_aways"] == CYCLES
    assert late["frequency"] == pytest.approx(1.0 / PERIOD)
    assert late["mean_period"] == pytest.approx(PERIOD)
    assert late["slip_share"] == pytest.approx(SLIP / PERIOD)
    assert late["mean_x"] == pytest.approx(0.01 * (RAMP + END) / 2.0 / END)
    assert (late["min_x"], late["max_x"]) == pytest.approx((0.01 * RAMP / END, 0.01))
    assert late["max_rotation_deg"] == pytest.approx(12.0, rel=1e-4)
    assert late["mean_heat_flow"] == pytest.approx(0.5 / END)


def test_ledger_of_the_mechanics():
    ledger = numbers(made_up())["ledger"]["mechanics"]
    assert ledger["surface_work"] == pytest.approx(0.6)
    assert ledger["friction_heat"] == pytest.approx(0.5)
    assert ledger["largest_residual"] == pytest.approx(1e-12)
    assert ledger["relative_residual"] == pytest.approx(1e-12 / 0.6)


def test_without_events_the_modes_tell_to_one_interval():
    dataset = trajectory_columns(made_up(), made_up().parameters, "").to_xarray()
    sampled = dataset.drop_dims("event_time").drop_vars("slip_time")
    exact, seen = slip_intervals(dataset), slip_intervals(sampled)
    interval = END / 600
    np.testing.assert_allclose(seen, exact, atol=0.5 * interval + 1e-12)
    apart = np.subtract(break_aways(sampled), break_aways(dataset))
    assert np.abs(apart).max() < 0.5 * interval + 1e-12


def test_a_run_that_ends_in_the_ramp_has_no_stick_slip_numbers():
    run = made_up(Parameters(surface=Surface(run_up_time=100.0)))
    late = numbers(run)["after_run_up"]
    assert late["frequency"] is None and late["slip_share"] is None and late["mean_x"] is None
    assert late["break_aways"] == 0


def test_real_run_agrees_with_the_trajectory():
    found = summary(mechanics_dataset())
    assert found["whole_run"]["slip_share"] == pytest.approx(trajectory().slip_share)
    assert found["whole_run"]["break_aways"] == trajectory().slip_starts.size
    assert found["ledger"]["mechanics"]["relative_residual"] < 1e-9


def test_how_it_was_coupled_is_told_with_units():
    dataset = coupled_dataset()
    found, steps = summary(dataset), dataset.sizes["time"] - 1
    expected = {
        "scheme": "gauss_seidel", "step_control": "fixed", "macro_step": 0.01, "steps": steps,
        "rejected": 1, "iterations": 2 * steps + 3, "most_iterations": 3, "events": 0,
        "unconverged": 1, "first_unconverged": 0.5, "converged": False, "above_tolerance": 0,
        "first_above_tolerance": None, "initial_sweeps": 2,
        "participants": {"mechanics": {"steps": steps, "seconds": 0.25 * steps},
            "thermal": {"steps": steps, "seconds": 0.5 * steps}},
        "remarks": [],
    }  # fmt: skip
    assert found["coupling"] == expected
    assert found["units"]["coupling.macro_step"] == "s"
    assert found["units"]["coupling.participants.thermal.seconds"] == "s"
    assert "coupling" not in summary(mechanics_dataset())


def test_heat_and_coupling_ledgers_close():
    found = summary(coupled_dataset())
    heat, coupling = found["ledger"]["heat"], found["ledger"]["coupling"]
    assert heat["relative_residual"] < 1e-10
    parts = ("belt", "ice", "air", "melting")
    assert heat["received"] == pytest.approx(sum(heat[name] for name in parts), rel=1e-10)
    assert coupling["handed_over"] == pytest.approx(coupling["taken_up"], rel=1e-12)
    shares = found["heat_shares"]
    assert sum(shares[name] for name in parts) == pytest.approx(1.0)
    rise = found["temperatures"]["interface"]
    assert 0.0 < rise["end_rise"] <= rise["max_rise"] < 1.0
    assert rise["end_degC"] == pytest.approx(-8.0 + rise["end_rise"])


@pytest.mark.parametrize("make", [coupled_dataset, mechanics_dataset])
def test_every_number_has_a_unit(make):
    found = summary(make())

    def paths(node, path=""):
        for key, value in node.items():
            if isinstance(value, dict):
                yield from paths(value, f"{path}{key}.")
            elif not isinstance(value, (str, bool, list)):
                yield path + key

    tree = {k: v for k, v in found.items() if k not in ("units", "versions", "parameters")}
    assert set(paths(tree)) == set(found["units"])


@pytest.mark.parametrize("rows", [0, 1, 2])
@pytest.mark.parametrize("make", [coupled_dataset, mechanics_dataset])
def test_few_rows_and_missing_numbers_give_null_and_never_nan(make, rows):
    dataset = make().isel(time=slice(0, rows))
    dataset["x"] = dataset["x"] * np.nan
    found = summary(dataset)
    json.dumps(found, allow_nan=False)
    assert found["rows"] == rows
    if rows:
        assert found["whole_run"]["max_x"] is None
