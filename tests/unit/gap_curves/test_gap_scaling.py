"""A strength that goes with the mass is told, and one that does not is not."""

import numpy as np
import pytest
from settled_campaigns import SETUPS, campaign_of, prepared_of, settled_on, strength
from stickslip.effects.candidate import Candidate

from cosim.gap.estimation.drive import strength_keys, with_strengths_scaled
from cosim.gap.selection.scaling import _with_part, exponents, rescaled

KEY = "velocity_weakening.hyperbolic"
LAW = Candidate("velocity_weakening", "hyperbolic", (strength(KEY, 1.0, 0.5),))
#: A set-up's mass at which both laws are as strong.
MIDDLE = 0.7


def of(folder, power, seed):
    """Campaign, segmented runs and the settled law, its strength (m / MIDDLE)^power s/m."""
    campaign = campaign_of(
        folder,
        lambda mass, speed: {"velocity_weakening": {"hyperbolic": 1.0 * (mass / MIDDLE) ** power}},
        seed,
    )
    segmented = prepared_of(campaign)
    return campaign, segmented, settled_on(campaign, segmented, LAW.free_parameters, turns=3)


def test_a_strength_per_kilogram_is_told_and_fitted(tmp_path):
    campaign, segmented, law = of(tmp_path, -1.0, 1)
    found = exponents(law, campaign.runs, LAW)
    assert found["mass"].needed and not found["speed"].needed
    assert found["mass"].value == pytest.approx(-1.0, abs=0.2)
    after = rescaled(segmented, campaign.runs, law, LAW, found)
    ((key, (low, high)),) = after.intervals.items()
    assert key == "scaling.mass.velocity_weakening"
    assert low < after.settled.values[key] < high
    assert after.settled.values[key] == pytest.approx(-1.0, abs=0.2)
    assert after.repairs and after.gain > 10.0
    # where the strength counts from, the geometric mean of the masses, and what it is there
    reference = after.settled.model.settings["reference.mass"]
    assert reference == pytest.approx(np.exp(np.mean(np.log([m for m, _ in SETUPS[:-1]]))))
    assert after.settled.values[KEY] == pytest.approx(1.0 * MIDDLE / reference, rel=0.2)


def test_none_is_claimed_of_a_law_that_is_the_catalogues(tmp_path):
    campaign, _, law = of(tmp_path, 0.0, 2)
    found = exponents(law, campaign.runs, LAW)
    assert set(found) == {"mass", "speed"}  # stiffness is the same in all
    assert not any(one.needed for one in found.values())
    assert all(abs(one.value) < 0.1 for one in found.values())


def test_strengths_are_scaled_and_nothing_else():
    values = {KEY: 2.0, "friction.mu_k": 0.2, "scaling.mass.velocity_weakening": -1.0}
    at = {"mass": 2.0, "speed": 0.1, "stiffness": 20.0}
    assert with_strengths_scaled(values, at) == {KEY: 1.0, "friction.mu_k": 0.2}
    counted = {**values, "reference.mass": 4.0}
    assert with_strengths_scaled(counted, at) == {KEY: 4.0, "friction.mu_k": 0.2}
    assert with_strengths_scaled({"friction.mu_k": 0.2}, at) == {"friction.mu_k": 0.2}
    assert KEY in strength_keys("velocity_weakening")
    assert "velocity_weakening.stribeck_speed" not in strength_keys("velocity_weakening")


def test_products_with_another_strength_are_those_of_the_columns():
    """Columns own, two shared of which the second is a strength at 3 steps, residuals."""
    random = np.random.default_rng(3)
    rows, part, shared = 20, 0.4, np.array([0.0, 3.0])
    own, other, strength, residuals = random.standard_normal((4, rows))
    before = np.column_stack([own, other, strength, residuals])
    found = _with_part(before.T @ before, 2, shared, part)[0]
    scaled = part * strength
    # at part 0.4 of 3 steps
    columns = [own, 3.0 * scaled, other, scaled, residuals + (part - 1.0) * 3.0 * strength]
    after = np.column_stack(columns)
    assert found == pytest.approx(after.T @ after)
