"""What stands in each of the kernel's flat arrays, from which `layout` is counted.

The kernel speaks only in flat arrays of floats, so that one source runs interpreted (lists)
and as generated C (numpy arrays). Five arrays travel together:

=====  ==========================================================================
``p``  parameters as the motion needs them, constant during a run (`P_*`)
``u``  inputs, constant during a call of `advance` (`U_*`)
``z``  everything that a run remembers; copying it is saving the run (`Z_*`)
``w``  scratch space, without memory between calls (`W_*`)
``e``  log of events (`E_*`)
=====  ==========================================================================

Two more are what ``p`` is made of, once a run:

=====  ==========================================================================
``v``  the value of every parameter as it is given (`V_*`)
``d``  standard random numbers (`D_*`)
``g``  inputs as a host gives them, step by step (`G_*`)
=====  ==========================================================================

An *instant* of the motion is `INSTANT` numbers: time, the integrated state (`X` ...), the mode and
the direction of the last sliding. `z` holds four of them: `HERE`, where the integrator's own step
begins; `NEXT`, where it ends; `SHOWN`, the instant asked for; and `BETWEEN`, for instants on the
way to it.

Nobody numbers by hand: ``layout.toml`` names what stands in each array and how many numbers it is,
the effects' declarations name theirs, and `constants` counts.
"""

from collections.abc import Iterable, Mapping, Sequence
from math import cos, pi, prod, sin, sqrt
from typing import Any

from ..effects import EFFECTS
from ..effects.effect import Effect
from ..generation.slots import draw_slots, effect_slots, seed_of, state_slots, value_slot
from ..packaged import packaged_tables

Slots = Sequence[tuple[str, int]]


def _size(said: Any, known: Mapping[str, Any]) -> Any:
    """A number as the file has it: itself, by a name that is known, or a product of such."""
    if isinstance(said, list):
        return prod(_size(each, known) for each in said)
    return known[said] if isinstance(said, str) else said


_LAYOUT = packaged_tables(__package__, "layout.toml")
#: Numbers that are no places.
NUMBERS: dict[str, Any] = {}
for _name, _said in _LAYOUT["numbers"].items():
    NUMBERS[_name] = _size(_said, NUMBERS)


def _slots(array: str, known: Mapping[str, Any] = NUMBERS) -> Slots:
    """What stands in an array, the effects' numbers left out. known: sizes beside `NUMBERS`."""
    sizes = {**NUMBERS, **known}
    return [(name, _size(said, sizes)) for name, said in _LAYOUT[array].items()]


def instant(effects: Iterable[Effect]) -> Slots:
    """What an instant of the motion is made of."""
    remembered = (slots for part in ("moving", "bristles", "remembered") for slots in _slots(part))
    of_effects = [(name, 1) for name in state_slots(effects)]
    return [("TIME", 1), *remembered, *of_effects, *_slots("counted"), *_slots("discrete")]


def values(effects: Iterable[Effect]) -> Slots:
    """Every parameter and how many numbers it is, in the order of `Parameters.flat`."""
    own = [(f"{effect.id}.{name}", 1) for effect in effects for name in effect.table.model_fields]
    return [*own, *_slots("V")]


def value_names(effects: Iterable[Effect] = EFFECTS) -> tuple[str, ...]:
    """The FMU's name of every number in ``v``, in order."""
    return tuple(
        name if size == 1 else f"{name}[{i + 1}]"
        for name, size in values(effects)
        for i in range(size)
    )


def drawn(effects: Sequence[Effect], places: Mapping[str, int]) -> dict[str, tuple[float, ...]]:
    """How each number of ``d`` comes about; `places`: of the parameters.

    ``DRAW_SEED``: where in ``v`` the seed is; what one seed draws stands together.
    ``DRAW_UNIFORM``: 1 for a uniform number from 0 to 1, 0 for a normal deviate.
    """
    count = sum(size for _, size in _slots("D"))
    seeds = [float(places[value_slot("imperfections.seed")])] * count
    uniform = [0.0] * count
    for effect in effects:
        kinds = [float(kind == "uniform") for kind in effect.draws.values()] * effect.members
        seeds += [float(places[seed_of(effect)])] * len(kinds) if kinds else []
        uniform += kinds
    return {"DRAW_SEED": tuple(seeds), "DRAW_UNIFORM": tuple(uniform)}


def tableau() -> dict[str, tuple[float, ...]]:
    """The method's coefficients, row after row; each stage's row is filled up with zeros."""
    found = packaged_tables(__package__, "dormand_prince.toml")
    found["STAGE_WEIGHTS"] = [
        row + [0.0] * (NUMBERS["ALL_STAGES"] - len(row)) for row in [[], *found["STAGE_WEIGHTS"]]
    ]
    return {name: tuple(number for row in table for number in row) for name, table in found.items()}


def quadrature() -> dict[str, tuple[float, ...]]:
    """By which `friction.disc` integrates over the contact.

    Angles of strips and of rays about the centre of rotation (midpoint rule), and the four nodes of
    Gauss and Legendre, in pairs from the inner to the outer, with their weights.
    """
    found: dict[str, tuple[float, ...]] = {}
    rays = NUMBERS["RAYS"]
    for name, parts in (("STRIP", 2 * rays), ("RAY", rays)):  # parts of half a turn
        angles = [(j + 0.5) * pi / parts for j in range(rays)]
        found[f"{name}_COSINES"] = tuple(map(cos, angles))
        found[f"{name}_SQUARED_SINES"] = tuple(sin(angle) * sin(angle) for angle in angles)
    pairs = [
        (sqrt(3.0 / 7.0 + inner * 2.0 / 7.0 * sqrt(6.0 / 5.0)), inner) for inner in (-1.0, 1.0)
    ]
    found["DEPTH_NODES"] = tuple(node for root, _ in pairs for node in (-root, root))
    found["DEPTH_WEIGHTS"] = tuple(
        (18.0 - inner * sqrt(30.0)) / 36.0 for _, inner in pairs for _ in range(2)
    )
    return found


def constants(effects: Sequence[Effect] = EFFECTS) -> dict[str, int | float | tuple[float, ...]]:
    """Name -> value of everything that the kernel knows as a constant, with these effects."""
    inside = _placed(instant(effects))
    states = inside["MODE"] - 1
    moving = len(_slots("moving"))
    own = {
        "STATES": states,  # integrated numbers: X ... DAMPED
        "EXCHANGED": states + 1,  # the same and the time in slip: states of model exchange
        "MOVING": moving,
        "SHEARED": moving + len(_slots("bristles")),
        "REMEMBERED": states - len(_slots("counted")),
        "INSTANT": inside.pop("SIZE"),
    }
    inputs = _sized(_placed(_slots("U")), "U_SIZE")
    known = own | inputs
    given = _placed([(value_slot(name), size) for name, size in values(effects)])
    return {
        **NUMBERS,
        **own,
        **inside,
        **_sized(_placed(_slots("Z", known)), "Z_SIZE"),
        **inputs,
        **_sized(_placed([*_slots("P"), *effect_slots(effects)]), "P_SIZE"),
        **_sized(given, "V_SIZE"),
        **_sized(_placed([*_slots("D"), *draw_slots(effects)]), "D_SIZE"),
        **drawn(effects, given),
        **tableau(),
        **quadrature(),
        **_sized(_placed(_slots("W", known)), "W_SIZE"),
        **_sized(_placed(_slots("E")), "E_FIRST"),
        **_sized(_placed(_slots("G")), "G_SIZE"),
        **_sized(_placed(_slots("O")), "O_SIZE"),
        **_sized(_placed(_slots("R")), "R_SIZE"),
    }


def _placed(slots: Slots) -> dict[str, int]:
    """Where each begins, one after the other, and "SIZE"."""
    places, at = {}, 0
    for name, size in slots:
        if name in places:
            raise ValueError(f"two numbers of the kernel are called {name}")
        places[name] = at
        at += size
    return places | {"SIZE": at}


def _sized(places: dict[str, int], name: str) -> dict[str, int]:
    return {name if key == "SIZE" else key: place for key, place in places.items()}
