"""What a declaration must be for the kernel to be made of it, each rule with its own line."""

from collections import Counter

from ..effects.effect import Effect
from .places import CONSTANTS, PACKED, PLACES, RATE, SCALE, WORDS
from .slots import kernel_terms

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
