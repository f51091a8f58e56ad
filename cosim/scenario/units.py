"""Numbers that no rig has, and that another unit would make usual: grams, millimetres."""

from stickslip import Parameters

#: Key -> least and most of what rigs have, in the unit of the scenario; the unit in which the same
#: number is often written, and that unit in the scenario's.
USUAL = {
    "rig.mass": ((1e-3, 100.0), "g", 1e-3),
    "rig.contact_radius": ((1e-3, 2.0), "mm", 1e-3),
    "rig.attachment_radius": ((1e-3, 2.0), "mm", 1e-3),
    "rig.spring_length": ((1e-3, 10.0), "mm", 1e-3),
    "rig.spring_natural_length": ((1e-3, 10.0), "mm", 1e-3),
    "springs.stiffness": ((0.1, 1e6), "N/mm", 1e3),
    "surface.speed": ((0.0, 20.0), "mm/s", 1e-3),
}


def doubted(parameters: Parameters) -> str:
    """A sentence on the numbers that are likely in another unit; "" where none is."""
    found = []
    for key, ((least, most), unit, factor) in USUAL.items():
        table, _, name = key.partition(".")
        value = float(getattr(getattr(parameters, table), name))
        size = abs(value)
        if not least <= size <= most and least <= size * factor <= most:
            found.append((f"{key} = {value:g}", unit))
    if not found:
        return ""
    numbers, units = (list(dict.fromkeys(each)) for each in zip(*found, strict=True))
    return f"{', '.join(numbers)}: no rig has that in SI units; are these {', '.join(units)}?"
