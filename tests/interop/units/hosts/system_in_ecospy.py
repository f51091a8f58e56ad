"""ecospy: ``python system_in_ecospy.py SSP STEP COUNT`` prints x and temperature of every step."""

import sys

from ecospy import EcosSimulation

where, step, count = sys.argv[1], *map(float, sys.argv[2:])
with EcosSimulation(ssp_path=where, step_size=step) as simulation:
    simulation.init(parameter_set="reference")
    for _ in range(int(count)):
        simulation.step()
        x = simulation.get_real("mechanics::x")
        print("at", x, simulation.get_real("thermal::interface_temperature"))
