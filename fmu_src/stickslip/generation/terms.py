"""Text of the functions through which the kernel calls the effects' terms, and makes their numbers.

For each of the `PLACES` one function ``with_<place>`` that takes what is there and returns it with
every effect that is on; for the states their rates, starts and scales; the questions that the core
asks of the effects: whether they feel an input, have a memory, or vary over the contact; and what
makes their numbers in ``p`` from values and random draws when parameters are packed. The calls are
direct, and what is off costs a comparison.

Before that it is checked that a declaration is what the kernel can be made of, each rule with its
own line.
"""

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence

from ..effects.effect import Effect, Term
from .functions import EffectFunctions, arguments
from .places import ARRAY, CONSTANTS, LOCAL, MEMORY, PACKED, PLACES, RATE, SCALE, WORDS, Place
from .slots import (
    derived_slots,
    draw_slot,
    functions_in_kernel,
    kernel_terms,
    packed_terms,
    parameter_slots,
    state_slot,
    value_slot,
)


def terms_source(effects: Sequence[Effect]) -> str:
    """The whole text. Raises ValueError for a term whose place or argument nobody knows."""
    for effect in effects:
        check(effect)
    texts, imports = [], set()
    for effect in effects:
        wanted = [*functions_in_kernel(effect), *effect.derived, *packed_terms(effect)]
        text, taken = EffectFunctions(effect).text(wanted)
        texts += [text] if text else []
        texts += [_sum(effect, word) for word in effect.sums]
        imports |= taken
    texts += [_place_function(place, effects) for place in PLACES]
    texts += _state_functions(effects)
    texts += _questions(effects)
    texts.append(_set_numbers(effects))
    texts += [_packed_function(place, effects) for place in PACKED]
    head = [f"from math import {', '.join(sorted(imports))}"] if imports else []
    return "\n\n\n".join([*head, *texts]) + "\n"


def _in_motion(effect: Effect, function: Term, name: str, place: Place) -> str:
    """The kernel's expression for an argument of a term, or of a sum or state's function."""
    if name in place.local:
        return name
    if name in effect.sums:
        return _sum_call(effect, name, place)
    for other in kernel_terms(effect):
        if other.__name__ == name:
            return _call(effect, other, place)
    if name in parameter_slots(effect):
        return f"p[{parameter_slots(effect)[name]}]"
    if name in derived_slots(effect):
        return f"p[{derived_slots(effect)[name][0]}]"
    if name in CONSTANTS:
        return CONSTANTS[name]
    moving = WORDS | {
        state.name: f"w[W_STATE + {state_slot(effect, state.name)}]" for state in effect.states
    }
    term = f"{function.__name__} takes {name!r}"
    if name not in moving:
        effect.refuse(f"{term}: neither a number of the effect nor a word of {place.name}")
    if not place.sees_motion:
        effect.refuse(f"{term}: {place.name} knows nothing of the motion but its own words")
    return moving[name]


def _in_packing(effect: Effect, function: Term, name: str) -> str:
    """The expression for an argument; of member ``i`` where there is a series."""
    if name in effect.table.model_fields:
        return f"v[{_values(effect)[name]}]"
    in_series = function.__name__ in effect.series
    if name in derived_slots(effect) and (in_series or name not in effect.series):
        more = " + i" if name in effect.series else ""
        return f"p[{derived_slots(effect)[name][0]}{more}]"
    if name in effect.draws and in_series:
        number = list(effect.draws).index(name)
        return f"d[{draw_slot(effect)} + {len(effect.draws)} * i + {number}]"
    if name in CONSTANTS:
        return CONSTANTS[name]
    effect.refuse(
        f"{function.__name__} takes {name!r}: no number of the effect, and none that a run begins "
        "with"
    )


def guard(effect: Effect, function: Term) -> str:
    """Condition under which a term counts."""
    return _condition(effect, function, "p", parameter_slots(effect))


def is_on(effect: Effect, function: Term) -> str:
    """Condition under which a function counts, by the values of the parameters."""
    return _condition(effect, function, "v", _values(effect))


def _values(effect: Effect) -> dict[str, str]:
    """Parameter -> its place in ``v``."""
    return {name: value_slot(f"{effect.id}.{name}") for name in effect.table.model_fields}


def _condition(effect: Effect, function: Term, array: str, slots: Mapping[str, str]) -> str:
    """That one of its switches is on; of a function that takes none, one of its effect's."""
    taken = [name for name in effect.switch if name in arguments(function)] or effect.switch
    fields = effect.table.model_fields
    return " or ".join(f"{array}[{slots[name]}] != {fields[name].default!r}" for name in taken)


def _written(effect: Effect, function: Term, bound: Callable[[str], str]) -> str:
    given = ", ".join(bound(name) for name in arguments(function))
    return f"{EffectFunctions(effect).name(function)}({given})"


def _call(effect: Effect, function: Term, place: Place) -> str:
    return _written(effect, function, lambda name: _in_motion(effect, function, name, place))


def _packed_call(effect: Effect, function: Term) -> str:
    return _written(effect, function, lambda name: _in_packing(effect, function, name))


def _terms_at(place: str, effects: Iterable[Effect]) -> list[tuple[Effect, Term]]:
    return [(e, term) for e in effects for term in kernel_terms(e) if term.__name__ == place]


def _signature(place: Place) -> str:
    arrays = [f"{name}: {ARRAY}" for name in place.arrays.split()]
    value = f"{place.so_far or 'value'}: float"
    return ", ".join([*arrays, value, *(f"{word}: float" for word in place.words)])


def _place_function(place: Place, effects: Sequence[Effect]) -> str:
    terms, calls = _terms_at(place.name, effects), []
    for number, (effect, term) in enumerate(terms):
        calls.append([guard(effect, term), _call(effect, term, place)])
        if place.name == "surface_acceleration" and number + 1 < len(terms):
            calls[-1] += _speed_for_the_next(effect, effects)
    return _place_text(place, _signature(place), calls)


def _speed_for_the_next(effect: Effect, effects: Sequence[Effect]) -> list[str]:
    """The speed that the next effect's acceleration is made of, with that of this effect."""
    place = next(place for place in PLACES if place.name == "surface_speed")
    for other, term in _terms_at(place.name, effects):
        if other is effect:
            return [f"        {place.so_far} = {_call(other, term, place)}"]
    return []


def _place_text(place: Place, signature: str, calls: Iterable[Sequence[str]]) -> str:
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


def _sum(effect: Effect, word: str) -> str:
    """A function that adds up what a function gives for each member of its series."""
    function = effect.sums[word]
    names = arguments(function)
    series = [name for name in names if name in effect.series]
    others = [name for name in names if name not in effect.series]
    slots = derived_slots(effect)
    given = ", ".join(f"p[{slots[n][0]} + i]" if n in series else n for n in names)
    signature = ", ".join([f"p: {ARRAY}", *(f"{name}: float" for name in others)])
    return "\n".join(
        [
            f"def {effect.id}_{word}({signature}) -> float:",
            f'    """Sum of `{effect.id}_{function.__name__}` over its series."""',
            "    total = 0.0",
            f"    for i in range({effect.series[series[0]]}):",
            f"        total += {EffectFunctions(effect).name(function)}({given})",
            "    return total",
        ]
    )


def _sum_call(effect: Effect, word: str, place: Place) -> str:
    member = effect.sums[word]
    names = [name for name in arguments(member) if name not in effect.series]
    given = ", ".join(["p", *(_in_motion(effect, member, name, place) for name in names)])
    return f"{effect.id}_{word}({given})"


def _state_functions(effects: Sequence[Effect]) -> list[str]:
    rates = [
        f"def set_state_rates(p: {ARRAY}, u: {ARRAY}, w: {ARRAY}, out: int, "
        "friction_power: float, speed: float):",
        '    """Rates of the effects\' states, into ``w[out:]``: power in W, mean speed in m/s."""',
    ]
    starts = [
        f"def set_starting_states(p: {ARRAY}, z: {ARRAY}, at: int):",
        '    """Put the effects\' states at the start of a run into the instant ``z[at:]``."""',
    ]
    scales = [
        f"def with_state_scale(p: {ARRAY}, i: int, value: float, speed: float) -> float:",
        '    """Of state i, what counts as much as ``speed`` (m/s); ``value`` for the others."""',
    ]
    for effect in effects:
        for state in effect.states:
            at = state_slot(effect, state.name)
            rates += [
                "    rate = 0.0",
                f"    if {guard(effect, state.rate)}:",
                f"        rate = {_call(effect, state.rate, RATE)}",
                f"    w[out + {at} - 1] = rate",
            ]
            value = f"p[{parameter_slots(effect)[state.start]}]" if state.start else "0.0"
            starts.append(f"    z[at + {at}] = {value}")
            if state.scale is not None:
                scales.append(f"    if i == {at}:")
                scales.append(f"        value = {_call(effect, state.scale, SCALE)}")
    return ["\n".join(rates), "\n".join(starts), "\n".join([*scales, "    return value"])]


def _questions(effects: Sequence[Effect]) -> list[str]:
    """Functions of ``p`` that say whether any effect is on that takes a word."""
    in_kernel = [(effect, term) for effect in effects for term in functions_in_kernel(effect)]

    def taking(word: str) -> list[tuple[Effect, Term]]:
        return [(e, term) for e, term in in_kernel if word in _taken(e, term)]

    def remembers(effect: Effect, term: Term) -> bool:
        return bool({*MEMORY, *(state.name for state in effect.states)} & _taken(effect, term))

    local = [each for name in LOCAL for each in _terms_at(name, effects)]
    asked = {
        "feels_temperature": "Does the interface temperature matter to friction?",
        "feels_film": "Does water in the contact matter to friction?",
        "has_state_law": "Does a law of speed and state say what the contact holds, from rest on?",
        "has_local_law": "Does mu_k vary with the local sliding speed?",
        "has_ageing": "Does what a contact holds grow with its age?",
        "has_memory": "Does friction depend on place, distance slid or a state of an effect?",
    }
    by = (
        *(taking("temperature"), taking("film_thickness"), _terms_at("state_law", effects)),
        [each for each in local if "speed" in _taken(*each)],
        *(_terms_at("static_growth", effects), [each for each in in_kernel if remembers(*each)]),
    )
    questions = [
        _asked(f"{name}(p", meaning, [guard(effect, term) for effect, term in terms])
        for (name, meaning), terms in zip(asked.items(), by, strict=True)
    ]
    meaning = "Does an effect say how mu_k of the dry contact varies with the local sliding speed?"
    dry = [is_on(effect, term) for effect, term in _terms_at("dry_factor", effects)]
    return [*questions, _asked("has_dry_law(v", meaning, dry)]


def _taken(effect: Effect, function: Term) -> set[str]:
    """Words that a function takes, by itself or by way of a sum."""
    names = set(arguments(function))
    for word in names & set(effect.sums):
        names |= set(arguments(effect.sums[word]))
    return names


def _asked(begins: str, meaning: str, conditions: list[str]) -> str:
    lines = [f"def {begins}: {ARRAY}) -> bool:", f'    """{meaning}"""']
    for condition in dict.fromkeys(conditions):
        lines += [f"    if {condition}:", "        return True"]
    return "\n".join([*lines, "    return False"])


def _set_numbers(effects: Sequence[Effect]) -> str:
    lines = [
        f"def set_effect_numbers(v: {ARRAY}, d: {ARRAY}, p: {ARRAY}):",
        '    """Put parameters and derived numbers of the effects where the kernel looks."""',
    ]
    for effect in effects:
        for name, slot in parameter_slots(effect).items():
            lines.append(f"    p[{slot}] = v[{_values(effect)[name]}]")
    for effect in effects:
        for function in effect.derived:
            slot, size = derived_slots(effect)[function.__name__]
            if function.__name__ in effect.series:
                lines.append(f"    for i in range({size}):")
                lines.append(f"        p[{slot} + i] = {_packed_call(effect, function)}")
            else:
                lines.append(f"    p[{slot}] = {_packed_call(effect, function)}")
    return "\n".join([*lines, "    return"])


def _packed_function(place: Place, effects: Sequence[Effect]) -> str:
    terms = [(e, term) for e in effects for term in packed_terms(e) if term.__name__ == place.name]
    calls = [(is_on(effect, term), _packed_call(effect, term)) for effect, term in terms]
    return _place_text(place, f"p: {ARRAY}, v: {ARRAY}, value: float", calls)


#: Every name that means something to a term of some place.
KERNEL_WORDS = {
    *WORDS,
    *CONSTANTS,
    *(word for place in (*PLACES, RATE, SCALE) for word in (*place.words, place.so_far) if word),
}


def check(effect: Effect) -> None:
    """That terms have places, names are told apart, and what is off is zero; else ValueError."""
    places = [place.name for place in (*PLACES, *PACKED)]
    for term in effect.terms:
        if term.__name__ not in places:
            there = ", ".join(sorted(places))
            effect.refuse(f"no place {term.__name__!r} in the kernel; there are {there}")
    if kernel_terms(effect):
        _check_zero_is_off(effect)
    _check_names(effect)


def _check_zero_is_off(effect: Effect) -> None:
    for name in effect.switch:
        if effect.table.model_fields[name].default != 0.0:
            effect.refuse(f"{name} is not off at 0")


def _check_names(effect: Effect) -> None:
    """A term takes its numbers by their names: each must have one, which is no word's."""
    states = [state.name for state in effect.states]
    derived = [function.__name__ for function in effect.derived]
    own = Counter([*effect.table.model_fields, *derived, *states, *effect.sums, *effect.draws])
    words = sorted(own.keys() & KERNEL_WORDS)
    if words:
        effect.refuse(f"{', '.join(words)}: the kernel's own words")
    twice = sorted(name for name, times in own.items() if times > 1)
    if twice:
        effect.refuse(f"{', '.join(twice)}: two numbers of one name")
    for state in effect.states:
        if state.start and state.start not in effect.table.model_fields:
            effect.refuse(
                f"state {state.name} starts from {state.start!r}, which is no parameter; there are "
                f"{', '.join(effect.table.model_fields)}"
            )
