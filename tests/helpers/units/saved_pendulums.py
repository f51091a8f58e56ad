"""Two pendulums of plain Python on one spring: cheap, and can be saved."""

import math
import struct

from part import Restorable

from cosim.coupling import Connection, CoupledSystem, inputs, outputs, port_table


class Pendulum(Restorable):
    """angle'' = -sin(angle) - 0.1 angle' + torque, by Heun steps; its state is two numbers."""

    def __init__(self, name, angle):
        self.name = name
        self.ports = port_table(inputs(torque="N.m") + outputs(angle="rad", rate="rad/s"))
        self._first = angle
        self.state, self.torque = (angle, 0.0), 0.0

    def enter_initialisation(self, start, stop):
        self.state = (self._first, 0.0)

    def write(self, values):
        self.torque = values.get("torque", self.torque)

    def read(self):
        return {"angle": self.state[0], "rate": self.state[1]}

    def step(self, time, size):
        angle, rate = self.state
        first = self._bend(angle, rate)
        second = self._bend(angle + size * rate, rate + size * first)
        self.state = (
            angle + size * rate + 0.5 * size * size * first,
            rate + 0.5 * size * (first + second),
        )

    def _bend(self, angle, rate):
        return self.torque - math.sin(angle) - 0.1 * rate

    def save_state(self):
        return struct.pack("<3d", *self.state, self.torque)

    def load_state(self, saved):
        angle, rate, self.torque = struct.unpack("<3d", saved)
        self.state = (angle, rate)


class Spring(Restorable):
    """Turns both towards each other."""

    def __init__(self, stiffness=2.0):
        self.name, self.stiffness = "spring", stiffness
        self.ports = port_table(
            inputs(one="rad", other="rad") + outputs(on_one="N.m", on_other="N.m")
        )
        self.given = {"one": 0.0, "other": 0.0}

    def write(self, values):
        self.given = self.given | dict(values)

    def read(self):
        torque = self.stiffness * (self.given["other"] - self.given["one"])
        return {"on_one": torque, "on_other": -torque}

    def save_state(self):
        return struct.pack("<2d", *self.given.values())

    def load_state(self, saved):
        self.given = dict(zip(("one", "other"), struct.unpack("<2d", saved), strict=True))


ORDER = ("left", "right", "spring")


def pendulums(stiffness=2.0):
    """A coupled system of both and the spring; fresh, as another process would have it."""
    return CoupledSystem(
        [Pendulum("left", 1.0), Pendulum("right", -0.3), Spring(stiffness)],
        [
            Connection("left.angle", "spring.one"),
            Connection("right.angle", "spring.other"),
            Connection("spring.on_one", "left.torque"),
            Connection("spring.on_other", "right.torque"),
        ],
    )
