"""Interpreted and compiled kernel: the same internal step, to 1e-12, for every effect.

How: both take each internal step from the same memory ``z``, so that nothing accumulates, and the
end of the step is compared number by number. The interpreted step is then the next start. A number
counts relative to itself or to what it comes to in a run, whichever is larger.
"""

import random

import numpy as np
import pytest
from effect_cases import (
    BESIDE_CREEP,
    IDS,
    draw_parameters,
    with_bristles,
    with_stick_creep,
    with_transition,
)
from kernel_steps import largest_step_difference, memory_of
from stickslip.compiled import compiled_kernel

SETS, STEPS = 10, 60
FILM = 3e-6  # m of water, which mixed_lubrication feels


@pytest.mark.parametrize("effect", IDS)
def test_interpreted_and_compiled_take_the_same_step(effect):
    draw = random.Random(f"kernels {effect}")
    for _ in range(SETS):
        memory = memory_of(draw_parameters((effect,), draw), draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(compiled_kernel(), memory, STEPS) < 1e-12


def test_a_stick_that_creeps():
    draw = random.Random("creep")
    for _ in range(2 * SETS):
        on = tuple(draw.sample(BESIDE_CREEP, 2))
        parameters = with_stick_creep(draw_parameters(on, draw), 5e-3)
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(compiled_kernel(), memory, STEPS) < 1e-12


def test_friction_that_falls_over_a_speed():
    draw = random.Random("transition")
    for _ in range(2 * SETS):
        on = tuple(draw.sample(BESIDE_CREEP, 2))
        parameters = with_transition(draw_parameters(on, draw), 5e-3, draw.choice([1.0, 1.7]))
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(compiled_kernel(), memory, STEPS) < 1e-12


def test_a_contact_with_bristles():
    draw = random.Random("bristles")
    for _ in range(2 * SETS):
        on = tuple(draw.sample([e for e in BESIDE_CREEP if e != "stick_stiffness"], 2))
        parameters = with_bristles(draw_parameters(on, draw), 5e-5, 5e-3)
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(compiled_kernel(), memory, STEPS) < 1e-12


def test_all_effects_at_once():
    draw = random.Random("all")
    for _ in range(SETS):
        memory = memory_of(draw_parameters(IDS, draw), draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(compiled_kernel(), memory, STEPS) < 1e-12


def test_the_comparison_sees_a_difference():
    """A parameter that is off by 1e-9 for one of the two shows."""
    memory = memory_of(draw_parameters((), random.Random(1)))
    other = memory_of(draw_parameters((), random.Random(1)))
    other.p = [value * (1.0 + 1e-9) for value in memory.p]
    found = largest_step_difference(compiled_kernel(), memory, STEPS, other_p=np.array(other.p))
    assert found > 1e-11
