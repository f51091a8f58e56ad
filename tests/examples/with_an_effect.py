"""The mechanics alone, plain and with an effect: what friction that falls with speed does."""

import matplotlib.pyplot as plt
import numpy as np
from stickslip import Friction, Parameters, Rig, Springs, Surface, VelocityWeakening, simulate

plain = Parameters(
    rig=Rig(mass=0.87, spring_natural_length=0.17),
    springs=Springs(stiffness=38.5),
    friction=Friction(mu_s=0.30, mu_k=0.22),
    surface=Surface(speed=0.10),
)
weakening = plain.model_copy(update={"velocity_weakening": VelocityWeakening(linear=0.8)})

motions = {}
stroke = {}  # m, from the end of one slip to the next break-away
for name, parameters in {"plain": plain, "with velocity weakening": weakening}.items():
    run = simulate(parameters, duration=20.0)
    motions[name] = run
    stroke[name] = float(np.ptp(run["x"][1000:]))
    print(f"{name}: {1e3 * stroke[name]:.1f} mm, slips {100 * run.slip_share:.0f} % of the time")

ledger = run["energy_residual"][-1]  # J

figure, axes = plt.subplots(figsize=(7, 2.6), layout="constrained")
for name, motion in motions.items():
    axes.plot(motion.time, 1e3 * motion["x"], label=name)
axes.set(xlabel="t [s]", ylabel="x [mm]", xlim=(0, 10))
axes.legend(loc="upper right", ncols=2)
