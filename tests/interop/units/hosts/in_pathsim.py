"""pathsim-fmi: ``python in_pathsim.py FILE SPEED STEP COUNT`` prints x after every step.

Every input has to be connected that is not 0; what the unit says after a step is shown under the
time at which the step began.
"""

import sys

from pathsim import Connection, Simulation
from pathsim.blocks import Constant, Scope
from pathsim_fmi import CoSimulationFMU

file, speed, step, count = sys.argv[1], *map(float, sys.argv[2:])
block = CoSimulationFMU(file, start_values={"surface_speed": speed}, dt=step)
surface, cold, scope = Constant(speed), Constant(-8.0), Scope()
wires = [
    Connection(surface, block["surface_speed"]),
    Connection(cold, block["interface_temperature"]),
    Connection(block["x"], scope),
]
simulation = Simulation([surface, cold, block, scope], wires, dt=step, log=False)
simulation.run((count - 1) * step)
_, (x,) = scope.read()
for value in x:
    print("x", float(value))
