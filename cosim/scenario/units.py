"""Numbers that no rig has, and that another unit would make usual: grams, millimetres."""

from math import log

from stickslip import Parameters

from cosim.scenario.validation import WORDS


def doubted(parameters: Parameters) -> str:
    """A sentence on the numbers that are likely in another unit; "" where none is.

    That one is named which makes the number most like the default.
    """
    found, usual = [], Parameters()
    for key, ((least, most), units) in WORDS["usual"].items():
        value, default = _number(parameters, key), _number(usual, key)
        size = abs(value)
        off = {
            unit: abs(log(size * factor / default))
            for unit, factor in units.items()
            if not least <= size <= most and least <= size * factor <= most
        }
        if off:
            found.append(f"{key} = {value:g} ({min(off, key=off.__getitem__)}?)")
    return f"{', '.join(found)}: no rig has that in SI units" if found else ""


def _number(parameters: Parameters, key: str) -> float:
    table, _, name = key.partition(".")
    return float(getattr(getattr(parameters, table), name))
