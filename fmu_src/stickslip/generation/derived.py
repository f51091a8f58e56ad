"""Text of the functions that make the effects' numbers in ``p`` from their parameters."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from ..effects.effect import Effect
from .functions import EffectFunctions, arguments, imports_text
from .places import CONSTANTS, PACKED, Place
from .slots import derived_slots, parameter_slots

_TYPES = "p: list[float], values: Mapping[str, float]"


def derived_source(effects: Sequence[Effect]) -> str:
    """The whole text: for `packing`, in plain Python, without the kernel's restrictions."""
    packed = {place.name for place in PACKED}
    texts: list[str] = []
    imports = {("collections.abc", "Mapping")}
    for effect in effects:
        wanted = [*effect.derived, *(term for term in effect.terms if term.__name__ in packed)]
        text, taken = EffectFunctions(effect).text(wanted)
        texts += [text] if text else []
        imports |= taken
    texts.append(_set_numbers(effects))
    texts += [_packed_function(place, effects) for place in PACKED]
    return imports_text(imports) + "\n\n\n" + "\n\n\n".join(texts) + "\n"


def effect_slot_names(effects: Sequence[Effect]) -> dict[str, str]:
    """``effect.parameter`` -> its slot, for those that enter the kernel as they are."""
    return {
        f"{effect.id}.{name}": slot
        for effect in effects
        for name, slot in parameter_slots(effect).items()
    }


def _bound(effect: Effect, name: str) -> str:
    if name in effect.table.model_fields:
        return f'values["{effect.id}.{name}"]'
    if name in derived_slots(effect):
        return f"p[{derived_slots(effect)[name][0]}]"
    if name in CONSTANTS:
        return CONSTANTS[name]
    raise ValueError(f"effect {effect.id}: nothing that a run begins with is called {name!r}")


def _call(effect: Effect, function: Callable[..., object]) -> str:
    given = ", ".join(_bound(effect, name) for name in arguments(function))
    return f"{EffectFunctions(effect).name(function)}({given})"


def _set_numbers(effects: Sequence[Effect]) -> str:
    lines = [
        f"def set_effect_numbers({_TYPES}) -> None:",
        '    """Put parameters and derived numbers of the effects where the kernel looks."""',
    ]
    for name, slot in effect_slot_names(effects).items():
        lines.append(f'    p[{slot}] = float(values["{name}"])')
    for effect in effects:
        for function in effect.derived:
            slot, size = derived_slots(effect)[function.__name__]
            target = f"p[{slot}]" if size == 1 else f"p[{slot} : {slot} + {size}]"
            lines.append(f"    {target} = {_call(effect, function)}")
    return "\n".join([*lines, "    return None"])


def _packed_function(place: Place, effects: Sequence[Effect]) -> str:
    lines = [
        f"def with_{place.name}({_TYPES}, value: float) -> float:",
        f'    """Returns with every effect: {place.meaning}."""',
    ]
    for effect in effects:
        for term in effect.terms:
            if term.__name__ != place.name:
                continue
            call = _call(effect, term)
            switches = [name for name in effect.switch if name in arguments(term)]
            on = " or ".join(
                f"{_bound(effect, name)} != {effect.table.model_fields[name].default!r}"
                for name in switches or effect.switch
            )
            lines.append(f"    if {on}:")
            lines.append(
                {
                    "add": f"        value += {call}",
                    "multiply": f"        value *= {call}",
                    "largest": f"        value = max(value, {call})",
                }[place.joins]
            )
    return "\n".join([*lines, "    return value"])
