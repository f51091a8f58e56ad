"""The unit in another tool: fmpy loads it, as any FMI 2.0 co-simulation unit.

`stickslip build` makes it. Here it is built from Python, for this machine.
"""

import matplotlib.pyplot as plt
from fmpy import read_model_description, simulate_fmu

from cosim.fmu.build import ensure_fmu

fmu = ensure_fmu("build")
units = {v.name: v.unit for v in read_model_description(fmu).modelVariables}

rest = {"surface_speed": 0.2, "initial.vx": 0.2, "surface.run_up_time": 0.0}
result = simulate_fmu(
    fmu,
    stop_time=10.0,
    output_interval=0.01,
    start_values=rest | {"friction.mu_s": 0.3, "friction.mu_k": 0.2},
    output=["x", "mode", "slip_count", "heat", "energy_residual"],
)

slip_share = result["mode"].mean()  # mode: 0 stick, 1 slip
print(f"{result['slip_count'][-1]:.0f} slips, {100 * slip_share:.0f} % of the time")
print(f"friction heat {result['heat'][-1]:.3f} {units['heat']}")

figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
axes.plot(result["time"], 1e3 * result["x"])
axes.set(xlabel="t [s]", ylabel="x [mm]")
