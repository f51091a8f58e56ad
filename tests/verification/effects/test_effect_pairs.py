"""Any two effects together: the energy ledger closes to 1e-9 of the heat, and heat only grows."""

import random
from itertools import combinations

import numpy as np
import pytest
from effect_cases import IDS, draw_parameters
from stickslip import simulate

PAIRS = [*combinations(IDS, 2)]


def check(effects, seed, rigs=1):
    draw = random.Random(seed)
    for _ in range(rigs):
        parameters = draw_parameters(effects, draw, initial={})
        run = simulate(parameters, 1.5)
        if not run.complete:
            # carried into an anchor; the contact's age followed on a belt far too fast for it; or
            # creep on the flank of a bell that rises steeply from rest
            assert "spring" in run.reason or {"rate_and_state", "viscoelastic_peak"} & set(effects)
        speed = parameters.surface.speed
        scale = run["heat"][-1] + 0.5 * parameters.rig.mass * speed**2
        assert np.max(np.abs(run["energy_residual"])) < 1e-9 * scale
        assert np.min(np.diff(run["heat"])) >= -1e-12 * scale


@pytest.mark.parametrize("effect", IDS)
def test_with_every_other_effect(effect):
    for pair in PAIRS:
        if pair[0] == effect:
            check(pair, " ".join(pair))


def test_all_at_once():
    check(IDS, "all", 3)
