"""States and instances in fmpy: a run goes on from a state, and no instance knows of another."""

import os
from pathlib import Path

import fmpy_slave
import pytest
from command_line import python
from fmpy_instance import SPEED, instance

from cosim.fmu import python_unit


def test_a_serialised_state_continues_in_another_process(unit, block, tmp_path):
    block.initialise(**{"lateral_friction.ratio": 1.0, "initial.x": 0.01})
    block.march(0, 137, 0.01)
    (tmp_path / "state").write_bytes(block.slave.serializeFMUState(block.slave.getFMUState()))
    block.march(137, 100, 0.01)
    program = (
        "import os, sys; from pathlib import Path; sys.path[:0] = sys.argv[1].split(os.pathsep);"
        "from fmpy_instance import instance; directory = Path(sys.argv[3])\n"
        "with instance(Path(sys.argv[2]), directory / 'other') as other:\n"
        "    other.initialise()\n"
        "    state = other.slave.deserializeFMUState((directory / 'state').read_bytes())\n"
        "    other.slave.setFMUState(state)\n"
        "    other.march(137, 100, 0.01)\n"
        "    print(*other.everything())\n"
    )
    helpers = (Path(__file__).parent, Path(fmpy_slave.__file__).parent)
    said = python(program, os.pathsep.join(map(str, helpers)), unit, tmp_path)
    assert said.split() == block.everything()


def test_two_instances_do_not_know_each_other(unit, tmp_path):
    with instance(unit, tmp_path / "a") as a, instance(unit, tmp_path / "b") as b:
        a.initialise()
        b.initialise(surface_speed=0.3)
        for n in range(100):
            a.slave.doStep(n * 0.01, 0.01)
            b.slave.doStep(n * 0.01, 0.01)
        together = a.everything(), b.everything()
    for alone, speed in zip(together, (SPEED, 0.3), strict=True):
        with instance(unit, tmp_path / "c") as c:
            c.initialise(surface_speed=speed)
            c.march(0, 100, 0.01)
            assert c.everything() == alone


def test_two_builds_run_side_by_side(python_fmu, tmp_path):
    """Doubled gravity in the second build; each keeps its own numbers in one process."""
    files = python_unit.sources()
    heavier = files["stickslip/kernel.py"].replace(b"GRAVITY = 9.81", b"GRAVITY = 19.62")
    assert heavier != files["stickslip/kernel.py"]
    changed = python_unit.build(tmp_path, files | {"stickslip/kernel.py": heavier})
    forces = []
    for path, folder in ((python_fmu, "a"), (changed, "b"), (python_fmu, "c")):
        with instance(path, tmp_path / folder) as one:
            one.initialise()
            one.march(0, 1, 0.001)
            forces.append(one.get("friction_force_x"))
    assert forces[1] == pytest.approx(2 * forces[0], rel=1e-12) and forces[2] == forces[0]
