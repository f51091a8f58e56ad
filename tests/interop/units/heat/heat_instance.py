"""An instance of BeltIceThermal in fmpy, addressed by names, and inputs for it."""

import numpy as np
from fmpy_slave import Slave, fmpy_slave

OUTPUTS = (
    "interface_temperature", "belt_entry_temperature", "belt_exit_temperature",
    "ice_face_temperature", "belt_share", "melt_rate", "melted_mass", "heat_received",
    "heat_stored", "heat_to_air",
)  # fmt: skip
H = 0.01  # s, between communication points


class Heat(Slave):
    """One of the heat's units; of names that are keywords __ is the dot."""

    def put(self, **values):
        for name, value in values.items():
            self.set(name.replace("__", "."), value)

    def outputs(self):
        return np.array([self.get(name) for name in OUTPUTS])

    def start(self, **values):
        self.put(**values)
        return self.begin()

    def run(self, heat_flow, surface_speed, x, times):
        """Outputs (steps + 1, outputs) with inputs (steps,)."""
        rows = [self.outputs()]
        for n in range(len(times) - 1):
            self.put(heat_flow=heat_flow[n], surface_speed=surface_speed[n], x=x[n])
            self.slave.doStep(times[n], times[n + 1] - times[n])
            rows.append(self.outputs())
        return np.array(rows)


def instance(fmu, directory):
    return fmpy_slave(fmu, directory, kind=Heat)


def constant(steps, heat_flow=0.3, surface_speed=0.15, x=0.0):
    """Inputs of sliding, and the times."""
    flat = np.ones(steps)
    return heat_flow * flat, surface_speed * flat, x * flat, np.arange(steps + 1) * H
