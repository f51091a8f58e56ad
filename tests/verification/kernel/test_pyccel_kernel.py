"""The kernel as C, made by pyccel: the same internal step as interpreted, to 1e-12.

Skipped where pyccel (the extra `native`) or a C compiler is missing. The comparison is that of
`test_effect_kernels`: step for step from the same memory.
"""

import importlib.util
import os
import random
import shutil
import subprocess
import sys

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
from stickslip.generation.source import kernel_source

pytestmark = pytest.mark.skipif(
    importlib.util.find_spec("pyccel") is None
    or not any(shutil.which(name) for name in ("gcc", "cc", "clang")),
    reason="no pyccel (pip install 'stickslip[native]') or no C compiler",
)
SETS, STEPS = 10, 60
FILM = 3e-6  # m of water, which mixed_lubrication feels
NAME = "kernel_in_c"
# the command `pyccel` of this very interpreter, wherever its script may be
PYCCEL = "from pyccel.commands.console import pyccel_command; pyccel_command()"


@pytest.fixture(scope="module")
def translated(tmp_path_factory):
    """The flattened kernel, translated to C, compiled, imported."""
    folder = tmp_path_factory.mktemp("pyccel")
    (folder / f"{NAME}.py").write_text(kernel_source(), encoding="utf-8")
    # pyccel names its folder after the worker of a parallel run, if there is one
    environment = {k: v for k, v in os.environ.items() if k != "PYTEST_XDIST_WORKER"}
    done = subprocess.run(
        [sys.executable, "-c", PYCCEL, "compile", f"{NAME}.py", "--language", "c"],
        cwd=folder,
        env=environment,
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert (folder / "__pyccel__" / f"{NAME}.c").exists()
    (library,) = folder.glob(f"{NAME}.*.so")
    spec = importlib.util.spec_from_file_location(NAME, library)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.mark.parametrize("effect", IDS)
def test_interpreted_and_translated_take_the_same_step(translated, effect):
    draw = random.Random(f"kernels {effect}")
    for _ in range(SETS):
        memory = memory_of(draw_parameters((effect,), draw), draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) < 1e-12


def test_a_stick_that_creeps(translated):
    draw = random.Random("creep")
    for _ in range(2 * SETS):
        on = tuple(draw.sample(BESIDE_CREEP, 2))
        parameters = with_stick_creep(draw_parameters(on, draw), 5e-3)
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) < 1e-12


def test_friction_that_falls_over_a_speed(translated):
    draw = random.Random("transition")
    for _ in range(2 * SETS):
        on = tuple(draw.sample(BESIDE_CREEP, 2))
        parameters = with_transition(draw_parameters(on, draw), 5e-3, draw.choice([1.0, 1.7]))
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) < 1e-12


def test_a_contact_with_bristles(translated):
    draw = random.Random("bristles")
    for _ in range(2 * SETS):
        on = tuple(draw.sample([e for e in BESIDE_CREEP if e != "stick_stiffness"], 2))
        parameters = with_bristles(draw_parameters(on, draw), 5e-5, 5e-3)
        memory = memory_of(parameters, draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) < 1e-12


def test_all_effects_at_once(translated):
    draw = random.Random("all")
    for _ in range(SETS):
        memory = memory_of(draw_parameters(IDS, draw), draw.uniform(-20.0, 2.0), FILM)
        assert largest_step_difference(translated, memory, STEPS) < 1e-12
