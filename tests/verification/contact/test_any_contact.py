"""Any rig whose contact creeps, loses its friction over a speed, or is sheared before it slides:
its ledger is closed, and when anybody looks does not matter."""

import random

import numpy as np
import pytest
from effect_cases import (
    BESIDE_CREEP,
    assert_ledger_is_closed,
    assert_looking_changes_nothing,
    draw_parameters,
    with_bristles,
    with_stick_creep,
    with_transition,
)


def creeping(rig, draw):
    return with_stick_creep(rig, draw.choice([1e-5, 1e-3, 2e-2]))


def falling(rig, draw):
    speed, exponent = draw.choice([1e-4, 2e-3, 2e-2]), draw.choice([1.0, draw.uniform(0.7, 3.0)])
    return with_stick_creep(with_transition(rig, speed, exponent), draw.choice([0.0, 1e-3]))


def sheared(rig, draw):
    distance, speed = draw.choice([1e-5, 5e-5, 2e-4]), 10.0 ** draw.uniform(-3.0, -2.0)
    exponent = draw.choice([1.0, draw.uniform(0.7, 3.0)])
    return with_bristles(rig, distance, speed, exponent, draw.uniform(0.1, 1.0))


def any_rig(contact, seed):
    draw = random.Random(f"{contact.__name__} {seed}")
    beside = [each for each in BESIDE_CREEP if contact is not sheared or each != "stick_stiffness"]
    on = tuple(draw.sample(beside, draw.randint(0, 2 if contact is sheared else 3)))
    return contact(draw_parameters(on, draw), draw)


#: Contact -> how many rigs are run, how many are looked at, and for how long, s.
CONTACTS = {creeping: (45, 25, 2.0), falling: (45, 25, 2.0), sheared: (30, 15, 1.0)}


@pytest.mark.parametrize("contact", CONTACTS)
def test_the_ledger_of_any_rig_is_closed(contact):
    for seed in range(CONTACTS[contact][0]):
        given_back = 1e-6 if contact is sheared else 1e-12  # heat of the scale; by bristles
        run = assert_ledger_is_closed(any_rig(contact, seed), 2.0, given_back)
        if contact is creeping:
            assert np.all(np.diff(run["sliding_distance"]) >= -1e-15)


@pytest.mark.parametrize("contact", CONTACTS)
def test_when_anybody_looks_does_not_matter(contact):
    _, looked_at, duration = CONTACTS[contact]
    for seed in range(looked_at):
        assert_looking_changes_nothing(any_rig(contact, seed), duration)
