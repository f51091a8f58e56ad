"""The kernel as C: the same as interpreted and as compiled by numba, to the last bit.

All take the operations in the order in which they are written, the compiler contracts none, and
`exp`, `sin` and the like are those of the same C library. Skipped where there is no C compiler.
Compared are steps, each from the same memory, and whole runs.
"""

import random

import numpy as np
import pytest
from c_library import Library, compiler
from effect_cases import (
    BESIDE_CREEP,
    IDS,
    draw_parameters,
    with_bristles,
    with_stick_creep,
    with_transition,
)
from kernel_steps import largest_step_difference, memory_of
from stickslip.arrays import RunArrays, inputs
from stickslip.generation.source import kernel_source
from stickslip.kernel.layout import E_COUNT, O_SIZE

pytestmark = pytest.mark.skipif(not compiler(), reason="no C compiler")
SETS, STEPS = 10, 60
FILM = 3e-6  # m of water, which mixed_lubrication feels


@pytest.fixture(scope="module")
def translated(tmp_path_factory):
    return Library(kernel_source(), tmp_path_factory.mktemp("kernel"))


def test_the_compiler_has_nothing_to_say(translated):
    assert translated.said == ""


@pytest.mark.parametrize("effect", IDS)
def test_interpreted_and_translated_take_the_same_step(translated, effect):
    draw = random.Random(f"kernels {effect}")
    for _ in range(SETS):
        memory = memory_of(draw_parameters((effect,), draw), draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) == 0.0


def test_a_stick_that_creeps(translated):
    draw = random.Random("creep")
    for _ in range(2 * SETS):
        on = tuple(draw.sample(BESIDE_CREEP, 2))
        parameters = with_stick_creep(draw_parameters(on, draw), 5e-3)
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) == 0.0


def test_friction_that_falls_over_a_speed(translated):
    draw = random.Random("transition")
    for _ in range(2 * SETS):
        on = tuple(draw.sample(BESIDE_CREEP, 2))
        parameters = with_transition(draw_parameters(on, draw), 5e-3, draw.choice([1.0, 1.7]))
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) == 0.0


def test_a_contact_with_bristles(translated):
    draw = random.Random("bristles")
    for _ in range(2 * SETS):
        on = tuple(draw.sample([e for e in BESIDE_CREEP if e != "stick_stiffness"], 2))
        parameters = with_bristles(draw_parameters(on, draw), 5e-5, 5e-3)
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) == 0.0


def test_all_effects_at_once(translated):
    draw = random.Random("all")
    for _ in range(SETS):
        memory = memory_of(draw_parameters(IDS, draw), draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) == 0.0


def run(parameters, duration, kernel=None):
    """Outputs, memory and events of a run: compiled, by another kernel, or "interpreted"."""
    interpreted = kernel == "interpreted"
    u = inputs(parameters.surface.speed, -8.0, FILM)
    arrays = RunArrays.begin(parameters.pack(), u, events=1000, interpreted=interpreted)
    if kernel is not None and not interpreted:
        arrays.kernel = kernel
        kernel.initialise(arrays.p, arrays.z, 0.0)
    array = list if interpreted else np.array
    times = np.arange(0.0, duration, 0.01)
    o = array(np.zeros(O_SIZE * len(times)))
    assert arrays.kernel.record(*arrays.all, array(times), o, 0, len(times)) == len(times)
    return np.array(o), np.array(arrays.z), np.array(arrays.e)


def assert_identical(one, other):
    for found, expected in zip(one, other, strict=True):
        np.testing.assert_array_equal(found, expected)


# random rigs of which each breaks away and sticks again several times
@pytest.mark.parametrize("seed", (82, 124, 253))
def test_whole_runs_are_the_same_as_interpreted(translated, seed):
    parameters = draw_parameters(BESIDE_CREEP, random.Random(seed))
    found = run(parameters, 4.0, translated)
    assert found[2][E_COUNT] > 6
    assert_identical(found, run(parameters, 4.0, "interpreted"))


@pytest.mark.parametrize("seed", (82, 124, 253))
def test_long_runs_are_the_same_as_compiled(translated, seed):
    parameters = draw_parameters(BESIDE_CREEP, random.Random(seed))
    assert_identical(run(parameters, 20.0, translated), run(parameters, 20.0))


@pytest.mark.parametrize("seed", (3, 6))
def test_long_runs_with_every_effect_are_the_same_as_compiled(translated, seed):
    parameters = draw_parameters(IDS, random.Random(seed))
    assert_identical(run(parameters, 20.0, translated), run(parameters, 20.0))
