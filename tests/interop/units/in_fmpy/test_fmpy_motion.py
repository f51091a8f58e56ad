"""The motion in fmpy, whatever the host's steps, start and tolerance; its ledger is closed."""

import math

import numpy as np
import pytest
from fmpy_instance import SPEED, instance


def trajectory(block, size, stop=3.0, **values):
    block.slave.reset()
    block.initialise(**values)
    x, count = [], round(stop / size)
    for n in range(count):
        block.slave.doStep(n * size, size)
        x.append(block.get("x"))
    return np.array(x)


def test_heat_flow_is_the_difference_quotient_of_heat(block):
    block.initialise()
    before = 0.0
    for n in range(100):
        block.slave.doStep(n * 0.03125, 0.03125)
        heat = block.get("heat")
        assert block.get("heat_flow") == (heat - before) / 0.03125
        before = heat


RAMP_AND_RIPPLE = {
    "surface.run_up_time": 10.0, "speed_ripple.amplitude": 0.1, "speed_ripple.frequency": 3.0,
}  # fmt: skip


@pytest.mark.parametrize("start", [-5.0, 5.0, 1e6])
def test_the_time_at_which_a_run_starts_is_no_matter(block, start):
    """The ramp begins then, and the ripple."""
    names = ("x", "vx", "heat", "surface_speed_actual")
    runs = []
    for begin in (0.0, start):
        block.slave.reset()
        block.initialise(start=begin, **RAMP_AND_RIPPLE)
        rows = []
        for n in range(100):
            block.slave.doStep(begin + n * 0.03125, 0.03125)
            rows.append([block.get(name) for name in names])
        runs.append(rows)
    np.testing.assert_allclose(runs[1], runs[0], rtol=0, atol=1e-9)
    assert 0.0 < runs[0][-1][3] < SPEED


def test_friction_can_be_tuned_in_the_run(unit, tmp_path):
    """The ledger stays closed; a state from before brings the old friction back."""
    with instance(unit, tmp_path / "tuned") as block:
        block.initialise()
        block.march(0, 100, 0.01)
        state = block.slave.getFMUState()
        block.march(100, 50, 0.01)
        as_it_was = block.everything()
        for _ in range(2):
            block.slave.setFMUState(state)
            block.set("friction.mu_s", 0.4)
            block.set("friction.mu_k", 0.1)
            block.march(100, 50, 0.01)
            assert abs(block.get("energy_residual")) < 1e-9 and block.everything() != as_it_was
        block.slave.setFMUState(state)
        block.march(100, 50, 0.01)
        assert block.everything() == as_it_was
        block.slave.freeFMUState(state)


def test_the_ledger_has_the_work_of_forces_from_outside(block):
    block.initialise(**{"lateral_friction.ratio": 1.0, "initial.x": 0.01})
    for push in ("force_x", "force_y", "moment"):
        block.set(f"external_{push}", {"moment": 0.05}.get(push, 0.8))
    block.march(0, 100, 0.01)
    assert abs(block.get("energy_residual")) < 1e-10 < 1e-3 < abs(block.get("external_work"))


@pytest.mark.parametrize("hold", [0, 1])
def test_the_units_move_alike_to_the_last_bit(fmu, python_fmu, tmp_path, hold):
    seen = []
    for path, folder in ((fmu, "native"), (python_fmu, "python")):
        with instance(path, tmp_path / folder) as block:
            values = {"lateral_friction.ratio": 1.0, "initial.x": 0.01, "input.hold": hold}
            block.initialise(**values)
            for n in range(200):
                block.set("surface_speed", SPEED * (1.0 + 0.1 * math.sin(0.2 * n)))
                if n == 100:
                    block.set("friction.mu_k", 0.1)
                    block.set("external_force_y", 0.2)
                block.slave.doStep(n * 0.01, 0.01)
            seen.append({name: float(block.get(name)).hex() for name in block.variables})
    native, python = seen
    assert {name: native[name] for name in python} == python


@pytest.mark.parametrize("tolerance, same", [(1e-3, True), (0.0, True), (1e-30, False)])
def test_a_host_s_tolerance_tightens_and_never_loosens(block, tolerance, same):
    own = trajectory(block, 0.25)[-1]
    block.slave.reset()
    block.initialise(tolerance=tolerance)
    block.march(0, 12, 0.25)
    assert bool(block.get("x") == own) is same
    assert block.get("x") == pytest.approx(own, abs=1e-9)
