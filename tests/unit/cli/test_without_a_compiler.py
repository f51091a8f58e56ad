"""What commands say, and leave, on a machine that has no compiler for the unit they need."""

import pytest
from command_line import refusal

REMEDY = (
    "no C compiler: install one (cc, gcc or clang), or `pip install ziglang`, which compiles for "
    "every platform"
)
INSTEAD = (
    "; StickSlip3DOF-python.fmu needs none: `stickslip build StickSlip3DOF-python.fmu -o .`, "
    "`run --fmu StickSlip3DOF-python.fmu`"
)
BRIEF = ("--set", "run.duration=0.05", "-o", "out")


@pytest.fixture
def without(tmp_path, monkeypatch):
    """An empty folder to be in, a cache with nothing in it, and no compiler."""
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    monkeypatch.setattr("cosim.fmu.libraries.PREBUILT", "none")  # an installed package has them
    monkeypatch.setattr("platformdirs.user_cache_path", lambda name: tmp_path / "cache" / name)
    monkeypatch.setattr("stickslip.generation.compiler.has_zig", lambda: False)
    monkeypatch.setattr("stickslip.generation.compiler.system_compiler", lambda: None)
    return here


@pytest.mark.parametrize("command", [
    ("run", *BRIEF),
    ("build", "-o", "out"),
    ("build", "StickSlip3DOF-fmi3.fmu", "-o", "out"),
    ("sweep", "reference", "--vary", "springs.stiffness=20,21", "--coupled", *BRIEF),
    ("friction-map", "-o", "out"),
])  # fmt: skip
def test_it_says_in_a_line_what_is_lacking_and_leaves_nothing(without, command, capsys):
    name = command[1] if command[1].endswith(".fmu") else "StickSlip3DOF.fmu"
    assert refusal(capsys, *command) == f"{name} was not built: {REMEDY}{INSTEAD}"
    assert not list(without.iterdir())


@pytest.mark.parametrize("name", ["BeltIceThermal.fmu", "StickSlipThermal.ssp"])
def test_what_no_other_unit_can_stand_for_is_said_without_one(without, name, capsys):
    assert refusal(capsys, "build", name, "-o", "out") == f"{name} was not built: {REMEDY}"
    assert not list(without.iterdir())
