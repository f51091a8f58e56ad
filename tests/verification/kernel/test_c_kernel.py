"""The kernel as C and interpreted: the same to the last bit, for every effect.

Both take the operations in the order in which they are written, the compiler contracts none, and
`exp`, `sin` and the like are those of the same C library. Compared are internal steps, each from
the same memory ``z``, so that nothing accumulates, and whole runs.
"""

import random

import numpy as np
import pytest
from effect_cases import IDS, any_rig, creeping, draw_parameters, falling, sheared
from kernel_steps import largest_step_difference, memory_of
from stickslip.catalogue import CATALOGUE
from stickslip.compiled import Library

SETS, STEPS = 4, 60
FILM = 3e-6  # m of water, which mixed_lubrication feels


def test_what_is_compared_is_compiled():
    assert isinstance(CATALOGUE.compiled, Library)


def assert_same_steps(parameters, draw):
    memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
    assert largest_step_difference(CATALOGUE.compiled, memory, STEPS) == 0.0


@pytest.mark.parametrize("effect", IDS)
def test_an_effect(effect):
    draw = random.Random(f"kernels {effect}")
    for _ in range(SETS):
        assert_same_steps(draw_parameters((effect,), draw), draw)


@pytest.mark.parametrize("contact", [creeping, falling, sheared])
def test_any_contact(contact):
    draw = random.Random(contact.__name__)
    for _ in range(2 * SETS):
        assert_same_steps(any_rig(contact, draw), draw)


def test_all_effects_at_once():
    draw = random.Random("all")
    for _ in range(SETS):
        assert_same_steps(draw_parameters(IDS, draw), draw)


def test_the_comparison_sees_a_difference():
    """A parameter that is off by 1e-9 for one of the two shows."""
    memory = memory_of(draw_parameters((), random.Random(1)))
    other = np.array(memory.p) * (1.0 + 1e-9)
    assert largest_step_difference(CATALOGUE.compiled, memory, STEPS, other_p=other) > 1e-11
