"""What a run left on disk, read with xarray: every output with its unit, and the scenario."""

import json
import subprocess
import sys

import matplotlib.pyplot as plt
import xarray as xr

# the same as `stickslip simulate study` in a terminal
subprocess.run([sys.executable, "-m", "cosim", "simulate", "study", "-o", "study"], check=True)

with xr.open_dataset("study/result.nc") as result:
    x = result["x"].load()
    stiffness = json.loads(result.attrs["parameters"])["springs"]["stiffness"]

constant_speed = x.sel(time=slice(10.0, None))
swing = float(constant_speed.max() - constant_speed.min())
print(f"x swings by {1e3 * swing:.1f} mm on springs of {stiffness['value']} {stiffness['unit']}")

figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
x.plot(ax=axes)  # xarray takes label and unit from the file
