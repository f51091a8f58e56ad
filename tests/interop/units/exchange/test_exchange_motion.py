"""Model exchange: a host's integrator and events against the model's own, which are exact.

A host's tolerance is that of one step, of each state by its nominal. Some hundred steps make a slip
and some ten slips a run, each of which begins and ends where the error of the one before has put
it: an event is late by about a thousand tolerances, in the time of the motion itself, 0.1 s and
more. That is what the bounds below say, with what the model itself leaves open where a contact
in the plane comes to rest (`rest_speed` over mu g, some 1e-7 s).
"""

import numpy as np
import pytest
from fmpy import simulate_fmu
from plain_start import values
from stickslip import Parameters, simulate

SLOW = {"surface": {"speed": 0.03}, "initial": {"vx": 0.03}}
PLANE = {"lateral_friction": {"ratio": 1.0}}
CASES = {
    "line": {},
    "plane": {**PLANE, "initial": {"phi": 0.05, "y": 0.005}, "surface": {"speed": 0.05}},
    "slab": {**PLANE, "turning_surface": {"curvature": 1.0}},
    "static_strengthening": {"static_strengthening": {"rate": 0.02}},
    "thermal_weakening": {"thermal_weakening": {"per_joule": 0.4}},
    "damping and velocity_weakening": {"structural_damping": {"coefficient": 0.5},
        "velocity_weakening": {"linear": 0.3}},
    "stick_creep": {**SLOW, "friction": {"stick_creep": 4e-3}},
    "stick_creep in the plane": {**PLANE, "surface": {"speed": 0.03},
        "initial": {"vx": 0.03, "phi": 0.05, "y": 0.005}, "friction": {"stick_creep": 4e-3}},
    "transition_speed": {"friction": {"transition_speed": 5e-3}},
    "bristles": {"surface": {"speed": 0.03},
        "friction": {"transition_speed": 5e-3, "presliding_distance": 1e-4}},
    "run-up": {"surface": {"speed": 0.05, "run_up_time": 0.9}},
    "speed_ripple": {"speed_ripple": {"amplitude": 0.05}},
}  # fmt: skip
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
DURATION = 5.0  # s
EVENTS = 10  # that are compared
# Of the steepest cases the events move more: bristles give way the faster the faster they slide,
# and from mu_s a slip departs at a rate that grows from nothing.
SENSITIVE = {"bristles": 100.0, "transition_speed": 10.0}


def exchanged(fmu, tables, tolerance, **more):
    options = {
        "stop_time": DURATION, "output_interval": 0.01, "record_events": True,
        "output": ["mode", "slip_count", "energy_residual", "x", "heat", "slip_time"],
    }  # fmt: skip
    return simulate_fmu(
        str(fmu), fmi_type="ModelExchange", relative_tolerance=tolerance,
        start_values=values(tables), **(options | more),
    )  # fmt: skip


def changes(result):
    """Times at which the mode changes, and the modes from there on."""
    at = np.flatnonzero(np.diff(result["mode"])) + 1
    return result["time"][at], result["mode"][at]


CREEPING = {
    "default": {"surface": {"speed": 0.05}},
    "slow and stiff": {"surface": {"speed": 1e-3}, "initial": {"vx": 1e-3},
        "springs": {"stiffness": 300.0}},
    "plane": {**PLANE, "surface": {"speed": 0.05}, "initial": {"y": 0.005, "phi": 0.05}},
}  # fmt: skip


@pytest.mark.parametrize("case", CREEPING)
@pytest.mark.parametrize("tolerance", [1e-4, 1e-6])
def test_a_slip_that_creeps_at_first_is_not_begun_again_at_every_step(fmu, case, tolerance):
    """Friction follows speed and age of the contact: a slip begins at speeds far below a coarse
    tolerance. What a host makes of them costs some events, and there is an end of them."""
    law = {"rate_and_state": {"direct": 0.01, "evolution": 0.03}}
    tables = {**law, **CREEPING[case]}
    own = simulate(Parameters(**tables), duration=DURATION).events
    found = exchanged(fmu, tables, tolerance, timeout=100.0)
    assert found["time"][-1] == DURATION
    assert found["slip_count"][-1] == np.count_nonzero(own[:, 1] == 1.0) > 0
    assert len(found) - DURATION / 0.01 < 2000


@pytest.mark.parametrize("case", CASES)
def test_events_converge_to_the_models_own(fmu, case):
    tables = CASES[case]
    tight = {**tables, "solver": {"tolerance": 1e-12}}
    own = simulate(Parameters(**tight), duration=DURATION)
    expected = own.events[:EVENTS]
    assert len(expected) >= 6
    for tolerance in TOLERANCES:
        result = exchanged(fmu, tables, tolerance)
        times, modes = changes(result)
        assert list(modes[: len(expected)]) == list(expected[:, 1])
        late = np.abs(times[: len(expected)] - expected[:, 0])
        residual = np.abs(result["energy_residual"]).max()
        bound = 100.0 * SENSITIVE.get(case, 1.0) * tolerance + 5e-7
        assert late.max() < bound, tolerance
        assert residual < 500.0 * tolerance  # J; heat and works are some joules, of as many steps
    assert result["slip_count"][-1] == own["slip_count"][-1]
    assert result["slip_time"][-1] == pytest.approx(own["slip_time"][-1], abs=1e-6)
    assert result["x"][-1] == pytest.approx(own["x"][-1], abs=1e-6)


SLAB = {"lateral_friction.ratio": 1.0, "turning_surface.curvature": 0.3}
TURNED = {"lateral_friction.ratio": 1.0, "initial.phi": 0.1, "surface_speed": 0.05}
BESIDE = {
    "guided slab, never at rest": {**SLAB, "rig.free_y": 0, "rig.free_phi": 0},
    "guided across": {**TURNED, "initial.vx": 0.05, "rig.free_y": 0},
    "guided on a line": {**TURNED, "rig.free_y": 0, "rig.free_phi": 0},
    "stick_stiffness": {"stick_stiffness.ratio": 0.5},
    "no friction": {"friction.mu_s": 0.0, "friction.mu_k": 0.0, "initial.x": 0.05},
    "mu_k = mu_s": {**TURNED, "friction.mu_s": 0.05, "friction.mu_k": 0.05},
    "surface at rest": {"surface_speed": 0.0, "initial.vx": 0.1, "initial.x": 0.1},
}


@pytest.mark.parametrize("case", BESIDE)
def test_special_contacts_move_as_in_co_simulation(fmu, case):
    common = {
        "stop_time": 4.0, "output_interval": 0.01, "start_values": {**values({}), **BESIDE[case]},
        "output": ["x", "y", "phi", "slip_count", "slip_time"],
    }  # fmt: skip
    result = simulate_fmu(
        str(fmu), fmi_type="ModelExchange", relative_tolerance=1e-8, record_events=False, **common
    )
    own = simulate_fmu(str(fmu), fmi_type="CoSimulation", **common)
    for name in ("x", "y", "phi", "slip_time"):
        assert np.abs(result[name] - own[name]).max() < 5e-6, name
    assert (result["slip_count"] == own["slip_count"]).all()
