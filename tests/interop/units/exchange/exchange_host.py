"""Hosts for model exchange: fmpy's CVode, and one of the plainest kind; cases for them."""

import ctypes
from contextlib import contextmanager

import fmpy
import numpy as np
from fmpy import simulate_fmu
from fmpy.fmi2 import FMU2Model
from stickslip import Parameters

from cosim.coupling.fmu.log import FmuLog

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


def values(tables):
    """Start values by the FMU's names."""
    parameters = Parameters(**tables)
    return {**parameters.flat(), "surface_speed": parameters.surface.speed}


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


class Host:
    """An instance for model exchange, and a host of the plainest kind."""

    def __init__(self, fmu, directory, log, **starts):
        self.description = fmpy.read_model_description(str(fmu))
        self.variables = {each.name: each for each in self.description.modelVariables}
        self.log = log
        self.unit = FMU2Model(
            guid=self.description.guid,
            unzipDirectory=str(fmpy.extract(str(fmu), unzipdir=str(directory))),
            modelIdentifier=self.description.modelExchange.modelIdentifier,
        )
        self.unit.instantiate(callbacks=log.callbacks, loggingOn=True)
        self.states = self.description.numberOfContinuousStates
        for name, value in starts.items():
            self.put(name, value)

    def initialise(self, start=0.0):
        self.unit.setupExperiment(startTime=start)
        self.unit.enterInitializationMode()
        self.unit.exitInitializationMode()

    def begin(self, start=0.0):
        self.initialise(start)
        told = self.unit.newDiscreteStates()
        self.unit.enterContinuousTimeMode()
        return told

    def put(self, name, value):
        each = self.variables[name]
        if each.type == "Real":
            self.unit.setReal([each.valueReference], [value])
        else:
            self.unit.setInteger([each.valueReference], [int(value)])

    def get(self, name):
        each = self.variables[name]
        read = self.unit.getReal if each.type == "Real" else self.unit.getInteger
        return read([each.valueReference])[0]

    def numbers(self, call, count):
        kept = (ctypes.c_double * count)()
        call(kept, count)
        return np.array(kept)

    def x(self):
        return self.numbers(self.unit.getContinuousStates, self.states)

    def be_at(self, time, x):
        self.unit.setTime(time)
        self.unit.setContinuousStates((ctypes.c_double * self.states)(*x), self.states)

    def rates(self, time, x):
        self.be_at(time, x)
        return self.numbers(self.unit.getDerivatives, self.states)

    def everything(self):
        return [
            self.get(name).hex() for name, each in self.variables.items() if each.type == "Real"
        ]


@contextmanager
def hosted(fmu, directory, tables=None, **starts):
    log = FmuLog()
    host = Host(fmu, directory, log, **{**values(tables or {}), **starts})
    try:
        yield host
    finally:
        host.unit.freeInstance()
        log.close()
