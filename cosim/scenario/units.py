"""Numbers that no rig has, and that another unit would make usual: grams, millimetres."""

from stickslip import Parameters

from cosim.scenario.validation import WORDS


def doubted(parameters: Parameters) -> str:
    """A sentence on the numbers that are likely in another unit; "" where none is."""
    found = []
    for key, ((least, most), unit, factor) in WORDS["usual"].items():
        table, _, name = key.partition(".")
        value = float(getattr(getattr(parameters, table), name))
        size = abs(value)
        if not least <= size <= most and least <= size * factor <= most:
            found.append((f"{key} = {value:g}", unit))
    if not found:
        return ""
    numbers, units = (list(dict.fromkeys(each)) for each in zip(*found, strict=True))
    return f"{', '.join(numbers)}: no rig has that in SI units; are these {', '.join(units)}?"
