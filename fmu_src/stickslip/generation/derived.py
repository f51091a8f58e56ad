"""Text of the functions that make the effects' numbers in ``p`` from values and random draws."""

from collections.abc import Callable, Iterable, Sequence

from ..effects.effect import Effect, Term
from .functions import EffectFunctions, arguments
from .places import ARRAY, CONSTANTS, PACKED, Place
from .slots import derived_slots, draw_slot, packed_terms, parameter_slots, value_slot


def packing_functions(effects: Sequence[Effect]) -> list[str]:
    """What `kernel.packing` calls, beside the effects' own functions."""
    return [_set_numbers(effects), *(_packed_function(place, effects) for place in PACKED)]


def is_on(effect: Effect, function: Term) -> str:
    """Condition under which a function counts, by the values of the parameters."""
    taken = [name for name in effect.switch if name in arguments(function)] or effect.switch
    return " or ".join(
        f"v[{_place(effect, name)}] != {effect.table.model_fields[name].default!r}"
        for name in taken
    )


def _place(effect: Effect, name: str) -> str:
    return value_slot(f"{effect.id}.{name}")


def _bound(effect: Effect, function: Callable[..., object], name: str) -> str:
    """The expression for an argument; of member ``i`` where there is a series."""
    if name in effect.table.model_fields:
        return f"v[{_place(effect, name)}]"
    in_series = function.__name__ in effect.series
    if name in derived_slots(effect) and (in_series or name not in effect.series):
        more = " + i" if name in effect.series else ""
        return f"p[{derived_slots(effect)[name][0]}{more}]"
    if name in effect.draws and in_series:
        number = list(effect.draws).index(name)
        return f"d[{draw_slot(effect)} + {len(effect.draws)} * i + {number}]"
    if name in CONSTANTS:
        return CONSTANTS[name]
    raise ValueError(
        f"effect {effect.id}: {function.__name__} takes {name!r}: "
        "no number of the effect, and none that a run begins with"
    )


def _call(effect: Effect, function: Callable[..., object]) -> str:
    given = ", ".join(_bound(effect, function, name) for name in arguments(function))
    return f"{EffectFunctions(effect).name(function)}({given})"


def _set_numbers(effects: Sequence[Effect]) -> str:
    lines = [
        f"def set_effect_numbers(v: {ARRAY}, d: {ARRAY}, p: {ARRAY}):",
        '    """Put parameters and derived numbers of the effects where the kernel looks."""',
    ]
    for effect in effects:
        for name, slot in parameter_slots(effect).items():
            lines.append(f"    p[{slot}] = v[{_place(effect, name)}]")
    for effect in effects:
        for function in effect.derived:
            slot, size = derived_slots(effect)[function.__name__]
            if function.__name__ in effect.series:
                lines.append(f"    for i in range({size}):")
                lines.append(f"        p[{slot} + i] = {_call(effect, function)}")
            else:
                lines.append(f"    p[{slot}] = {_call(effect, function)}")
    return "\n".join([*lines, "    return"])


def _packed_function(place: Place, effects: Sequence[Effect]) -> str:
    terms = [(e, term) for e in effects for term in packed_terms(e) if term.__name__ == place.name]
    calls = [(is_on(effect, term), _call(effect, term)) for effect, term in terms]
    return place_function(place, f"p: {ARRAY}, v: {ARRAY}, value: float", calls)


def place_function(place: Place, signature: str, calls: Iterable[Sequence[str]]) -> str:
    """Of a place; calls: condition and call of each term, and lines that follow it."""
    value = place.so_far or "value"
    joined = {
        "add": f"{value} += {{}}",
        "multiply": f"{value} *= {{}}",
        "replace": f"{value} = {{}}",
        "largest": f"{value} = max({value}, {{}})",
    }[place.joins]
    lines = [
        f"def with_{place.name}({signature}) -> float:",
        f'    """Returns with every effect: {place.meaning}."""',
    ]
    for condition, call, *more in calls:
        lines += [f"    if {condition}:", f"        {joined.format(call)}", *more]
    return "\n".join([*lines, f"    return {value}"])
