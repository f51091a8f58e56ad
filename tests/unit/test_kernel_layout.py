"""The kernel's arrays: no two slots overlap, none is left over, the sizes fit what stands there."""

import ast
from pathlib import Path

import numpy as np
import pytest
from stickslip import CATALOGUE, Parameters
from stickslip.kernel import layout
from stickslip.packing import SLOTS, quadrature_tables
from stickslip.ports import OUTPUTS

MOTION = 3  # x, y, turning
# slots of more than one number; every other slot is one
WIDTHS = {
    "DIRECTION": MOTION,
    "HERE": layout.BLOCK,
    "NEXT": layout.BLOCK,
    "SHOWN": layout.BLOCK,
    "BETWEEN": layout.BLOCK,
    "Z_INPUTS": layout.U_SIZE,
    "Z_DENSE": layout.POWERS * layout.STATES,
    "P_ATTACH": 4 * 2,
    "P_ANCHOR": 4 * 2,
    "P_CURVE": 16 * layout.CURVE_WIDTH,
    "P_SCATTER_WAVES": 2 * layout.WAVES,
    "P_INITIAL": 2 * MOTION,
    "P_RELATIVE_STIFFNESS": 4,
    "P_QUADRATURE": len(quadrature_tables()),
    "P_TABLEAU": layout.T_D + layout.EXTRA_POWERS * layout.ALL_STAGES,
    "W_STATE": layout.BLOCK,
    "W_SLOPES": layout.ALL_STAGES * layout.STATES,
    "W_LOAD": MOTION,
    "W_SLIDING": MOTION,
    "W_FRICTION": MOTION,
    "W_SURFACE": 2 * MOTION,
    "W_PAIR": 2,
    "W_DIRECTION": MOTION,
    "W_CREEP": MOTION,
    "T_A": layout.STAGES * layout.ALL_STAGES,
    "T_B": (layout.ALL_STAGES - layout.STAGES) * layout.ALL_STAGES,
    "T_C": layout.ALL_STAGES,
    "T_E5": layout.STAGES,
    "T_E3": layout.STAGES,
    "T_D": layout.EXTRA_POWERS * layout.ALL_STAGES,
    "Q_STRIP": 2 * layout.RAYS,
    "Q_RAY": 2 * layout.RAYS,
    "Q_DEPTH": 2 * layout.DEPTHS,
}


def sections() -> dict[str, dict[str, int]]:
    """The constants of layout.py in its order, by the comment lines that part them."""
    text = Path(layout.__file__).read_text(encoding="utf-8")
    heads = [
        (number, line.strip("# -").strip())
        for number, line in enumerate(text.splitlines(), 1)
        if line.startswith("# ---")
    ]
    found: dict[str, dict[str, int]] = {}
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign):
            (target,) = node.targets
            head = [title for number, title in heads if number < node.lineno][-1]
            found.setdefault(head, {})[target.id] = ast.literal_eval(node.value)
    return found


def starting(*prefixes: str) -> dict[str, int]:
    return {
        name: value
        for part in sections().values()
        for name, value in part.items()
        if name.startswith(prefixes)
    }


ARRAYS = {
    "z": starting("HERE", "NEXT", "SHOWN", "BETWEEN", "Z_"),
    "u": starting("U_"),
    "p": starting("P_"),
    "w": starting("W_"),
    "o": starting("O_"),
    "tableau": starting("T_") | {"T_SIZE": WIDTHS["P_TABLEAU"]},
    "quadrature": starting("Q_") | {"Q_SIZE": WIDTHS["P_QUADRATURE"]},
    "block": {
        name: value
        for head, part in sections().items()
        if "inside a block" in head
        for name, value in part.items()
        if name not in ("STATES", "MOVING", "REMEMBERED")
    },
}


@pytest.mark.parametrize("array", ARRAYS)
def test_slots_stand_end_to_end(array):
    """Sorted by place, each begins where the one before ends, and the last ends at the size."""
    slots = sorted(ARRAYS[array].items(), key=lambda entry: entry[1])
    assert slots[0][1] == 0
    for (name, place), (_, following) in zip(slots, slots[1:], strict=False):
        assert place + WIDTHS.get(name, 1) == following, name
    assert slots[-1][0].endswith("SIZE") or slots[-1][0] == "BLOCK"


def test_every_wide_slot_exists():
    assert set(WIDTHS) <= {name for part in sections().values() for name in part}


def test_the_integrated_states_come_first():
    states = {name: ARRAYS["block"][name] for name in ("X", "OMEGA", "AGE", "DAMPED")}
    ends = {"OMEGA": layout.MOVING, "AGE": layout.REMEMBERED, "DAMPED": layout.STATES}
    assert states == {"X": 1} | ends
    assert layout.MODE == 1 + layout.STATES


def test_parameters_fill_the_vector():
    p = Parameters().pack()
    assert len(p) == layout.P_SIZE
    assert np.all(np.isfinite(p))


def test_every_parameter_of_an_effect_reaches_the_vector():
    """Changing any of them, its effect on, changes ``p``."""
    for effect in CATALOGUE:
        on = {name: effect.block.model_fields[name].default for name in effect.switch}
        for name in effect.switch:
            on[name] += 0.125 if effect.id != "stick_stiffness" else -0.125
        plain = Parameters(**{effect.id: on}).pack()
        for name, field in effect.block.model_fields.items():
            value = on.get(name, field.default)
            changed = value + 1 if isinstance(value, int) else 0.75 * value + 0.03125 * (value == 0)
            other = Parameters(**{effect.id: on | {name: changed}}).pack()
            assert other != plain, f"{effect.id}.{name}"


def test_named_slots_are_slots_and_named_once():
    assert set(SLOTS.values()) <= set(starting("P_"))
    assert len(set(SLOTS.values())) == len(SLOTS)


def test_outputs_name_every_slot_of_a_row():
    assert sorted(getattr(layout, port.slot) for port in OUTPUTS) == list(range(layout.O_SIZE))
