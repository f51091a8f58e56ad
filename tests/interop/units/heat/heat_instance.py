"""An instance of BeltIceThermal in fmpy, addressed by names, and inputs for it."""

from contextlib import contextmanager

import numpy as np
from fmpy_slave import fmpy_slave

OUTPUTS = (
    "interface_temperature",
    "belt_entry_temperature",
    "belt_exit_temperature",
    "ice_face_temperature",
    "belt_share",
    "melt_rate",
    "melted_mass",
    "heat_received",
    "heat_stored",
    "heat_to_air",
)
H = 0.01  # s, between communication points


class Heat:
    """An instance in fmpy, addressed by names."""

    def __init__(self, description, slave, log):
        self.slave, self.log = slave, log
        self.references = {each.name: each.valueReference for each in description.modelVariables}
        self.whole = {each.name for each in description.modelVariables if each.type == "Integer"}
        self.outputs = [self.references[name] for name in OUTPUTS]

    def set(self, **values):
        for name, value in values.items():
            name = name.replace("__", ".")
            kind = self.slave.setInteger if name in self.whole else self.slave.setReal
            kind([self.references[name]], [value])

    def get(self):
        return np.array(self.slave.getReal(self.outputs))

    def begin(self, **values):
        self.set(**values)
        self.slave.setupExperiment()
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def run(self, heat_flow, surface_speed, x, times):
        """Outputs (steps + 1, outputs) with inputs (steps,)."""
        rows = [self.get()]
        for n in range(len(times) - 1):
            self.set(heat_flow=heat_flow[n], surface_speed=surface_speed[n], x=x[n])
            self.slave.doStep(times[n], times[n + 1] - times[n])
            rows.append(self.get())
        return np.array(rows)


@contextmanager
def instance(fmu, directory):
    with fmpy_slave(fmu, directory) as made:
        yield Heat(*made)


def constant(steps, heat_flow=0.3, surface_speed=0.15, x=0.0):
    """Inputs of sliding, and the times."""
    flat = np.ones(steps)
    return heat_flow * flat, surface_speed * flat, x * flat, np.arange(steps + 1) * H
