"""Laws that the catalogue lacks and a plug-in brings; drawn only where they are asked for."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .ingredients import Ingredient

Draw = Callable[[np.random.Generator], Ingredient]


def flash_heating(rng) -> Ingredient:
    """Contacts get hot in their short lives above a sliding speed, and lose friction."""
    speed = rng.uniform(0.04, 0.08)
    return Ingredient(
        "flash_heating",
        f"above {speed:.3f} m/s",
        lambda p, s: p._replace(flash=s, flash_speed=speed),
    )


PLUG_INS: dict[str, Draw] = {"flash_heating": flash_heating}
