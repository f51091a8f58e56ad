"""Two participants of one's own, coupled: a mass, and the spring that pulls at it.

A participant is any class of this shape (`cosim.coupling.participant`): ports with units, values
read and written, a step. Each macro step the spring sees where the mass has got to (Gauss-Seidel),
so the force that the mass feels is one step old: the swing grows by pi^2 h / T a period.
"""

from math import pi, sqrt

import matplotlib.pyplot as plt

from cosim.coupling import Connection, CoupledSystem, GaussSeidel, inputs, outputs, port_table, run


class Part:
    """What both have in common: nothing to initialise, nothing to close."""

    def __init__(self, name, ports):
        self.name = name
        self.ports = port_table(ports)

    def enter_initialisation(self, start, stop):
        """Nothing to prepare."""

    def exit_initialisation(self):
        """Nothing to finish."""

    def close(self):
        """Nothing to let go of."""


class Mass(Part):
    """m x'' = F, exact for a force that is held over the step."""

    def __init__(self, mass, x):
        super().__init__("mass", inputs(force="N") + outputs(x="m", v="m/s"))
        self.mass, self.x, self.v, self.force = mass, x, 0.0, 0.0

    def write(self, values):
        self.force = values.get("force", self.force)

    def read(self):
        return {"x": self.x, "v": self.v}

    def step(self, time, size):
        acceleration = self.force / self.mass
        self.x += size * (self.v + 0.5 * size * acceleration)
        self.v += size * acceleration


class Spring(Part):
    """F = -k x."""

    def __init__(self, stiffness):
        super().__init__("spring", inputs(x="m") + outputs(force="N"))
        self.stiffness, self.x = stiffness, 0.0

    def write(self, values):
        self.x = values.get("x", self.x)

    def read(self):
        return {"force": -self.stiffness * self.x}

    def step(self, time, size):
        """A spring has no memory."""


MASS, STIFFNESS, STEP = 0.67, 80.0, 1e-4
PERIOD = 2.0 * pi * sqrt(MASS / STIFFNESS)  # s

connections = [Connection("mass.x", "spring.x"), Connection("spring.force", "mass.force")]
with CoupledSystem([Mass(MASS, x=0.01), Spring(STIFFNESS)], connections) as system:
    result = run(system, GaussSeidel(("mass", "spring")), stop=PERIOD, macro_step=STEP)

end = float(result["mass.x"][-1])
print(
    f"{result.status}: after a period of {PERIOD:.4f} s the mass is at {1e3 * end:.3f} mm of 10 mm"
)

figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
axes.plot(result.time, 1e3 * result["mass.x"])
axes.set(xlabel="t [s]", ylabel="x [mm]")
