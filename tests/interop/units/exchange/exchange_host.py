"""Model exchange in fmpy, by CVode, and cases for it."""

import numpy as np
from fmpy import simulate_fmu
from plain_start import values

SPEED = 0.15
SLOW = {"surface": {"speed": 0.03}, "initial": {"vx": 0.03}}
PLANE = {"lateral_friction": {"ratio": 1.0}}
CASES = {
    "line": {},
    "plane": {**PLANE, "initial": {"phi": 0.05, "y": 0.005}, "surface": {"speed": 0.05}},
    "slab": {**PLANE, "turning_surface": {"curvature": 1.0}},
    "static_strengthening": {"static_strengthening": {"rate": 0.02}},
    "thermal_weakening": {"thermal_weakening": {"per_joule": 0.4}},
    "damping and velocity_weakening": {
        "structural_damping": {"coefficient": 0.5},
        "velocity_weakening": {"linear": 0.3},
    },
    "stick_creep": {**SLOW, "friction": {"stick_creep": 4e-3}},
    "stick_creep in the plane": {
        **PLANE,
        "surface": {"speed": 0.03},
        "initial": {"vx": 0.03, "phi": 0.05, "y": 0.005},
        "friction": {"stick_creep": 4e-3},
    },
    "transition_speed": {"friction": {"transition_speed": 5e-3}},
    "bristles": {
        "surface": {"speed": 0.03},
        "friction": {"transition_speed": 5e-3, "presliding_distance": 1e-4},
    },
    "run-up": {"surface": {"speed": 0.05, "run_up_time": 0.9}},
    "speed_ripple": {"speed_ripple": {"amplitude": 0.05}},
}
TOLERANCES = (1e-4, 1e-6, 1e-8, 1e-10)
DURATION = 5.0  # s
EVENTS = 10  # that are compared
# Of the steepest cases the events move more: bristles give way the faster the faster they slide,
# and from mu_s a slip departs at a rate that grows from nothing.
SENSITIVE = {"bristles": 100.0, "transition_speed": 10.0}


def exchanged(fmu, tables, tolerance, **more):
    options = {
        "stop_time": DURATION,
        "output_interval": 0.01,
        "record_events": True,
        "output": ["mode", "slip_count", "energy_residual", "x", "heat", "slip_time"],
    }
    return simulate_fmu(
        str(fmu),
        fmi_type="ModelExchange",
        relative_tolerance=tolerance,
        start_values=values(tables),
        **(options | more),
    )


def changes(result):
    """Times at which the mode changes, and the modes from there on."""
    at = np.flatnonzero(np.diff(result["mode"])) + 1
    return result["time"][at], result["mode"][at]


CREEPING = {
    "default": {"surface": {"speed": 0.05}},
    "slow and stiff": {
        "surface": {"speed": 1e-3},
        "initial": {"vx": 1e-3},
        "springs": {"stiffness": 300.0},
    },
    "plane": {**PLANE, "surface": {"speed": 0.05}, "initial": {"y": 0.005, "phi": 0.05}},
}
