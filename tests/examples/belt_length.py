"""How warm a belt comes round: ramp and run of an experiment, then for ever, at four lengths."""

import matplotlib.pyplot as plt

from thermal import Belt, SteadySliding, ThermalParameters

SPEED, FORCE = 0.5, 4.03  # m/s, N of friction

after_a_run, for_ever = {}, {}  # rise where the belt enters the contact, K; key: length, m
for length in (1.0, 2.0, 4.0, 8.0):
    sliding = SteadySliding(ThermalParameters(belt=Belt(length=length)), SPEED, FORCE)
    sliding.ramp(10.0)
    after_a_run[length] = sliding.run(20.0).entry
    for_ever[length] = sliding.settle().entry
    print(
        f"{length:g} m: {after_a_run[length]:.3f} K after a run, {for_ever[length]:.3f} K for ever"
    )

figure, axes = plt.subplots(figsize=(7, 3), layout="constrained")
for label, rises in {"after a run": after_a_run, "for ever": for_ever}.items():
    axes.plot(list(rises), list(rises.values()), marker="o", label=label)
axes.set(xlabel="length of the belt [m]", ylabel="comes round warmer by [K]")
axes.legend()
