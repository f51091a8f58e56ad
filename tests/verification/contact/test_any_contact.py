"""Any rig whose contact creeps, loses its friction over a speed, or is sheared before it slides:
its ledger is closed, and when anybody looks does not matter."""

import random

import effect_cases
import numpy as np
import pytest
from effect_cases import creeping, falling, sheared


def rig_of(contact, seed):
    draw = random.Random(f"{contact.__name__} {seed}")
    return effect_cases.any_rig(contact, draw, 2 if contact is sheared else 3)


#: Contact -> how many rigs are run, how many are looked at, and for how long, s.
CONTACTS = {creeping: (45, 25, 2.0), falling: (45, 25, 2.0), sheared: (30, 15, 1.0)}


@pytest.mark.parametrize("contact", CONTACTS)
def test_the_ledger_of_any_rig_is_closed(contact):
    for seed in range(CONTACTS[contact][0]):
        given_back = 1e-6 if contact is sheared else 1e-12  # heat of the scale; by bristles
        run = effect_cases.assert_ledger_is_closed(rig_of(contact, seed), 2.0, given_back)
        if contact is creeping:
            assert np.all(np.diff(run["sliding_distance"]) >= -1e-15)


@pytest.mark.parametrize("contact", CONTACTS)
def test_when_anybody_looks_does_not_matter(contact):
    _, looked_at, duration = CONTACTS[contact]
    for seed in range(looked_at):
        effect_cases.assert_looking_changes_nothing(rig_of(contact, seed), duration)
