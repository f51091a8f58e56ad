"""The coupled case from Python: the block as an FMU, belt and ice as finite elements.

Friction heat crosses from the block to belt and ice, the temperature of the interface back. The
first run builds the FMU, half a minute; later ones take some seconds.
"""

from cosim import read_scenario, run_scenario

scenario = read_scenario("reference").changed(
    {"surface.speed": 0.25, "surface.run_up_time": 1.0, "run.duration": 3.0, "belt.length": 0.5}
)
run = run_scenario(scenario)

time = run.result.time  # s
x = run.result["mechanics.x"]  # m
rise = run.result["thermal.interface_temperature"] - scenario.ambient.temperature_degC  # K
heat = run.result["mechanics.heat"][-1]  # J of friction since the start
lost = run.result["thermal.heat_residual"][-1]  # J that belt, ice and air do not have

print(
    f"{time[-1]:g} s: the block is at {1e3 * x[-1]:.1f} mm, the interface {rise[-1]:.3f} K warmer"
)
print(f"friction heat {heat:.3f} J, of which {lost:.1e} J are unaccounted for")

figure = run.plot("temperatures")  # as on the page of `stickslip run`; figure.savefig("t.png")
