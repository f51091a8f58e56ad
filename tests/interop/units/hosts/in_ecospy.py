"""ecospy: ``python in_ecospy.py WHERE SPEED STEP COUNT`` prints x after every step.

WHERE: a file, or ``proxyfmu://localhost?file=FILE`` for a process of its own without Python.
"""

import sys

from ecospy import EcosSimulation, EcosSimulationStructure

where, speed, step, count = sys.argv[1], *map(float, sys.argv[2:])
with EcosSimulationStructure() as structure:
    structure.add_model("block", where)
    structure.add_parameter_set("chosen", {"block::surface_speed": speed})
    with EcosSimulation(structure=structure, step_size=step) as simulation:
        simulation.init(parameter_set="chosen")
        for _ in range(int(count)):
            simulation.step()
            print("x", simulation.get_real("block::x"))
