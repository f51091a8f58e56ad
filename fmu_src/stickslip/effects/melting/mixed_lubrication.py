"""Water of the melting face floods part of the contact and is sheared in place of dry friction.

Colbeck, J. Glaciol. 34 (1988). Water of the mean thickness h floods the share w = f h / (h + s):
(1 - w) mu + w^2 eta v / (h p), with the mean pressure p of the contact. All that holds for the dry
contact holds for the rest of it; the water, h / w thick where it is, is sheared in Couette flow,
eta v w / h on the share w. Water holds nothing at rest.
"""

from math import pi

from ...quantity import Table, quantity
from ..effect import Case, Effect


class MixedLubrication(Table):
    """Water of the melting face floods part of the contact and is sheared in place of dry friction.

    Its mean thickness h is an input: that of the heat model in a coupled run. It fills the share
    w = f h / (h + s) of a surface of roughness s, h / w thick there, and bears that share of the
    load: mu = (1 - w) mu_dry + w^2 eta v / (h p), p the mean pressure.

    share : f, part of the contact that water can fill; 0 is off, 1 a surface that ends up afloat
    roughness : s, of both faces together: water as thick as this fills half of what it can
    viscosity : eta of water at 0 degC
    """

    share: float = quantity(0.0, "1", ge=0, le=1, typical=(0.2, 1.0))
    roughness: float = quantity(5e-6, "m", ge=1e-9, le=1e-2, typical=(1e-6, 1e-4))
    viscosity: float = quantity(1.79e-3, "Pa.s", gt=0, le=1e3, typical=(1.79e-3, 3e-3))


def couette(viscosity: float, radius: float, normal_force: float) -> float:
    """Friction coefficient of a film of 1 m at 1 m/s over the whole contact, s."""
    whole = pi * (radius * radius)
    return viscosity * whole / normal_force


def flooded_share(film_thickness: float, share: float, roughness: float) -> float:
    """Part of the contact that water fills, and with it of the load that it bears.

    Water of the mean thickness h first fills the valleys of a surface of roughness s, and all
    that it can fill (f) once it is much thicker: f h / (h + s).
    """
    if film_thickness <= 0.0:
        return 0.0
    return share * film_thickness / (film_thickness + roughness)


def mixed(mu: float, speed: float, flooded: float, film_thickness: float, couette: float) -> float:
    """Friction of the dry part and the flooded one."""
    return (1.0 - flooded) * mu + flooded * flooded / film_thickness * couette * speed


EFFECT = Effect(
    id="mixed_lubrication",
    table=MixedLubrication,
    switch=("share",),
    enters="friction",
    axis="sliding speed",
    source="melt water shares the load with the dry contact: Colbeck, J. Glaciol. 34 (1988)",
    terms=(flooded_share, mixed),
    derived=(couette,),
    feels_melting=("share",),
    case=Case({"share": 0.8}, window=(0.0, 8.0), water=5e-6),
)
