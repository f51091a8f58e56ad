"""Which numbers of an effect have a slot in the kernel's arrays, and by which names."""

from collections.abc import Iterable, Iterator

from ..effects.effect import Effect, Term
from .functions import arguments
from .places import PACKED

_PACKED = {place.name for place in PACKED}


def kernel_terms(effect: Effect) -> list[Term]:
    """Those of its terms that the motion calls; the others count when parameters are packed."""
    return [term for term in effect.terms if term.__name__ not in _PACKED]


def packed_terms(effect: Effect) -> list[Term]:
    """Those that count when parameters are packed."""
    return [term for term in effect.terms if term.__name__ in _PACKED]


def functions_in_kernel(effect: Effect) -> list[Term]:
    """Everything of the effect that the motion needs."""
    rates = [state.rate for state in effect.states]
    scales = [state.scale for state in effect.states if state.scale is not None]
    return [*effect.sums.values(), *kernel_terms(effect), *rates, *scales]


def parameter_slots(effect: Effect) -> dict[str, str]:
    """Parameter -> name of its slot in ``p``, of those that the kernel has use for.

    They are what its functions take, the switches of an effect that has any, and what the core
    knows by a name of its own.
    """
    functions = functions_in_kernel(effect)
    wanted = {name for function in functions for name in arguments(function)}
    wanted |= {state.start for state in effect.states}
    if functions:
        wanted |= set(effect.switch)
    return {
        name: f"P_{effect.core[name]}" if name in effect.core else slot(effect, name)
        for name in effect.table.model_fields
        if name in wanted or name in effect.core
    }


def slot(effect: Effect, name: str) -> str:
    """Slot of a parameter or a derived number."""
    return f"P_{effect.id}_{name}".upper()


def derived_slots(effect: Effect) -> dict[str, tuple[str, int]]:
    """Derived number -> name of its slot and how many it is."""
    names = [function.__name__ for function in effect.derived]
    return {name: (slot(effect, name), effect.series.get(name, 1)) for name in names}


def effect_slots(effects: Iterable[Effect]) -> Iterator[tuple[str, int]]:
    """Name and size of every slot in ``p`` that the effects need, in order."""
    for effect in effects:
        for name in parameter_slots(effect).values():
            yield name, 1
        yield from derived_slots(effect).values()


def value_slot(name: str) -> str:
    """Place in ``v`` of a parameter, by its name in the FMU."""
    return f"V_{name}".replace(".", "_").upper()


def draw_slots(effects: Iterable[Effect]) -> Iterator[tuple[str, int]]:
    """Name and size of the places in ``d`` that the effects need, in order.

    Member after member of an effect's series, each with all its random numbers.
    """
    for effect in effects:
        if effect.draws:
            yield draw_slot(effect), effect.members * len(effect.draws)


def draw_slot(effect: Effect) -> str:
    """Where the random numbers of an effect begin in ``d``."""
    return f"D_{effect.id}".upper()


def seed_of(effect: Effect) -> str:
    """Place in ``v`` of the seed by which an effect draws."""
    return value_slot(f"{effect.id}.seed")


def state_slots(effects: Iterable[Effect]) -> list[str]:
    """Names of the effects' states among the integrated numbers, in order."""
    return [state_slot(effect, state.name) for effect in effects for state in effect.states]


def state_slot(effect: Effect, name: str) -> str:
    """Slot of a state in an instant of the motion."""
    return f"{effect.id}_{name}".upper()
