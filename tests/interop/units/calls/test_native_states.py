"""States of the native unit: taken at any time, put back, and as bytes."""

import random
from ctypes import byref, c_void_p

from c_unit import CInstance

SETS, TIMES, AHEAD = 10, 20, 3  # 200 states in all
#: Blocks of which each run has some at random, with the least and the largest of each parameter.
BLOCKS = [
    {"lateral_friction.ratio": (0.1, 1.0), "initial.phi": (-0.1, 0.1), "initial.y": (-0.01, 0.01)},
    {"turning_surface.curvature": (-4.0, 4.0)},
    {"static_strengthening.rate": (0.01, 0.1), "static_strengthening.hold_time": (0.01, 0.1)},
    {"velocity_weakening.stribeck": (0.1, 0.5)}, {"film_drag.coefficient": (0.1, 2.0)},
    {"thermal_weakening.per_joule": (0.01, 0.1), "thermal_weakening.relaxation_time": (0.5, 5.0)},
    {"run_in.change": (-0.3, 0.3), "run_in.distance": (0.1, 1.0)},
    {"structural_damping.coefficient": (0.1, 1.0), "spring_hardening.cubic": (10.0, 1e3)},
    {"speed_ripple.amplitude": (0.1, 0.6), "speed_ripple.frequency": (0.5, 3.0)},
    {"surface_pattern.amplitude": (0.05, 0.3), "surface_scatter.deviation": (0.01, 0.1)},
    {"friction.stick_creep": (1e-3, 4e-3)}, {"surface.run_up_time": (0.1, 3.0)},
    {"imperfections.spring_stiffness": (0.01, 0.1), "imperfections.seed": (1, 1000)},
    {"rig.mass": (0.3, 2.0), "springs.stiffness": (10.0, 60.0)},
]  # fmt: skip


def drawn(numbers: random.Random) -> dict[str, float]:
    """Parameters and inputs of a run."""
    chosen = {
        name: numbers.uniform(*bounds)
        for block in numbers.sample(BLOCKS, 4)
        for name, bounds in block.items()
    }
    return {"surface_speed": numbers.uniform(0.02, 0.4)} | chosen


def run(block: CInstance, sizes: list[float]):
    """State, bytes and all variables before each step."""
    time, rows = 0.0, []
    for size in sizes:
        state = block.save()
        rows.append((time, state, block.as_bytes(state), block.everything()))
        block.done("DoStep", time, size, 1)
        time += size
    return rows


def goes_on_alike(block: CInstance, sizes: list[float], rows, n: int) -> None:
    for k in range(n, min(n + AHEAD, len(rows))):
        assert block.everything() == rows[k][3]
        block.done("DoStep", rows[k][0], sizes[k], 1)


def test_a_run_goes_on_to_the_last_bit_from_any_of_its_states(unit):
    modes = []
    for seed in range(SETS):
        numbers = random.Random(seed)
        values = drawn(numbers)
        sizes = [10.0 ** numbers.uniform(-4.0, -0.5) for _ in range(TIMES)]
        with unit.instance() as block, unit.instance() as other:
            block.begin(**values)
            rows = run(block, sizes)
            order = numbers.sample(range(TIMES), TIMES)
            for n in order:
                _, state, content, _ = rows[n]
                block.restore(state)
                modes.append(block.get("mode"))
                goes_on_alike(block, sizes, rows, n)
                loaded = other.from_bytes(content)  # an instance that never began the run
                other.restore(loaded)
                goes_on_alike(other, sizes, rows, n)
                assert other.as_bytes(loaded) == content
                other.forget(loaded)
                block.forget(state)
    assert len(modes) == SETS * TIMES and min(modes.count(0), modes.count(1)) > 20


def test_a_state_that_is_overwritten_is_the_later_one(unit):
    with unit.instance().begin() as block:
        state = block.save()
        first = state.value
        block.march(range(100), 0.01)
        then = block.everything()
        block.done("GetFMUstate", byref(state))
        assert state.value == first
        block.march(range(100, 120), 0.01)
        block.restore(state)
        assert block.everything() == then
        block.forget(state)


def test_what_stands_where_a_state_is_put_need_not_be_one(unit):
    """Deserialising makes a state; a host in C need not have cleared the pointer before."""
    with unit.instance().begin() as block:
        state = block.save()
        content = block.as_bytes(state)
        made = c_void_p(1)
        block.done("DeSerializeFMUstate", content, len(content), byref(made))
        assert made.value not in {None, 1, state.value}
        block.restore(made)
        block.forget(made)
        block.forget(state)


def test_any_damage_to_the_bytes_is_found(unit):
    numbers = random.Random(7)
    with unit.instance().begin() as block:
        block.march(range(30), 0.01)
        content = block.as_bytes(block.save())
        then = block.everything()
        for _ in range(200):
            at = numbers.randrange(len(content))
            damaged = bytearray(content)
            damaged[at] ^= 1 << numbers.randrange(8)
            given = bytes(damaged)
            with unit.instance() as other:
                assert "is damaged" in refusal(other, given)
        for given in (b"", content[:-1], content + b"\0", content[:64]):
            with unit.instance() as other:
                assert "is damaged" in refusal(other, given)
        block.restore(block.from_bytes(content))
        assert block.everything() == then


def refusal(block: CInstance, content: bytes) -> str:
    state = c_void_p()
    said = block.reason("DeSerializeFMUstate", content, len(content), byref(state))
    assert state.value is None
    return said
