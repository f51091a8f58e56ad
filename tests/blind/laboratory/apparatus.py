"""One run's apparatus as a flat record: rig, contact and everything that may be hidden in it.

A record is a zero-dimensional structured array that the compiled functions read by field name. A
field at zero is an effect that is off. SI units throughout.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

GRAVITY = 9.81
POINTS = 12  # contact points of the disc: two rings of six
MODES = 8  # relaxing parts of a heat memory
OTHERS = 8  # numbers of an effect that no catalogue holds
LEVELS = 2  # elements of the Iwan contact at each contact point of the disc
ELEMENTS = LEVELS * POINTS  # of them in all; on a line, all of different strengths

_FLOATS = """
    mass inertia inverse_mass_y inverse_inertia stiffness
    spring_b slack
    mu_s mu_k scatter fall_speed fall_power presliding bristle_damping elastic_share creep_speed
    weakening weakening_speed weakening_power
    film film_speed film_power
    ageing ageing_time ageing_power ageing_slip
    heat heat_static heat_reference
    run_in run_in_distance run_in_power run_in_static
    pattern pattern_length pattern_width pattern_start
    load load_reference
    damping damping_power damping_speed
    ripple ripple_frequency ripple_start ripple_width
    belt_speed slab_x slab_y
    phase
    rebuild_time slider_creep
"""
_FORMS = """
    contact planar spring_form weakening_form film_form ageing_form heat_form run_in_form
    pattern_form load_form ripple_form other_form damping_form
"""
APPARATUS = np.dtype(
    [(name, np.float64) for name in _FLOATS.split()]
    + [(name, np.int64) for name in _FORMS.split()]
    + [(name, np.float64, 4) for name in ("anchor_x", "anchor_y", "hook_x", "hook_y", "natural")]
    + [(name, np.float64, POINTS) for name in ("point_x", "point_y", "point_weight")]
    + [(name, np.float64, MODES) for name in ("heat_weight", "heat_rate")]
    + [("other", np.float64, OTHERS)]
    + [(name, np.float64, ELEMENTS) for name in ("element_share", "element_give")]
    + [(name, np.float64, LEVELS) for name in ("level_share", "level_give")],
    align=True,
)
Record = NDArray[np.void]

LUGRE, ELASTO_PLASTIC, SMOOTH, JUMP = 0, 1, 2, 3
CONTACTS = {"lugre": LUGRE, "elasto_plastic": ELASTO_PLASTIC, "smooth": SMOOTH, "jump": JUMP}
# not one of those that the suites of old are drawn from: it has laws and suites of its own
IWAN = 4
FORMS = CONTACTS | {"iwan": IWAN}

# Radii (of the contact's) and shares of the load of two rings that integrate r, over the pressure
# stated: Gauss points in r^2, and in r for the rim.
PRESSURES = {
    "uniform": ((0.45970, 0.88807), (0.5, 0.5)),
    "rim": ((0.90, 1.0), (0.5, 0.5)),
    "domed": ((0.39376, 0.80309), (0.63608, 0.36392)),  # p falls as 1 - r^2 to the edge
}
HOLLOW = {"hollow": ((0.59587, 0.91921), (0.36392, 0.63608))}  # p grows as r^2 to the edge


def apparatus(
    mass: float,
    stiffness: float,
    belt_speed: float,
    mu_s: float,
    mu_k: float,
    *,
    contact: str = "lugre",
    guided: bool = True,
    planar: bool = False,
    spring_length: float = 0.2,
    natural_length: float = 0.17,
    attachment_radius: float = 0.05,
    attachment_angles_deg: tuple[float, ...] = (160.0, 20.0, 200.0, 340.0),
    contact_radius: float = 0.04,
    pressure: str = "uniform",
) -> Record:
    """A rig with a plain contact: nothing hidden in it.

    Parameters
    ----------
    mass, stiffness : kg; N/m of one of the four springs
    belt_speed : m/s, positive along x
    mu_s, mu_k : static and kinetic friction; without static excess where they are equal
    guided : the block can move along x only
    planar : friction acts over the disc in the plane; else along x alone, at the centre
    """
    p = np.zeros((), APPARATUS)
    p["mass"], p["stiffness"], p["belt_speed"] = mass, stiffness, belt_speed
    p["inertia"] = 0.5 * mass * contact_radius**2
    p["inverse_mass_y"] = 0.0 if guided else 1 / mass
    p["inverse_inertia"] = 0.0 if guided else 1 / p["inertia"]
    p["mu_s"], p["mu_k"], p["scatter"] = mu_s, mu_k, 1.0
    p["contact"], p["planar"] = FORMS[contact], int(planar and not guided)
    p["fall_speed"], p["fall_power"] = 4e-3, 1.0
    p["presliding"], p["bristle_damping"], p["elastic_share"] = 5e-5, 0.5, 0.7
    p["creep_speed"], p["rebuild_time"] = 5e-4, 0.01
    p["ageing_slip"] = 3e-4
    p["load_reference"] = mass * GRAVITY
    angles = np.radians(attachment_angles_deg)
    p["hook_x"], p["hook_y"] = (
        attachment_radius * np.cos(angles),
        attachment_radius * np.sin(angles),
    )
    p["anchor_x"] = p["hook_x"] + spring_length * np.sign(p["hook_x"])
    p["anchor_y"] = p["hook_y"]
    p["natural"] = natural_length
    spread_contact(p, contact_radius, pressure)
    return p


def spread_contact(p: Record, radius: float, pressure: str) -> None:
    """Put the contact points on two rings, symmetric about x and about y."""
    radii, shares = (PRESSURES | HOLLOW)[pressure]
    angles = (np.arange(6) + 0.5) * np.pi / 3
    p["point_x"] = np.concatenate([radius * r * np.cos(angles) for r in radii])
    p["point_y"] = np.concatenate([radius * r * np.sin(angles) for r in radii])
    p["point_weight"] = np.repeat(np.array(shares) / 6, 6)
