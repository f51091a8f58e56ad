"""Named parameters to the kernel's vector ``p``. Pure Python: it travels inside the FMU."""

from math import cos, hypot, radians, sin, sqrt

from .kernel.layout import (
    P_ANCHOR,
    P_ATTACH,
    P_CURVATURE,
    P_FREE_PHI,
    P_FREE_Y,
    P_INERTIA,
    P_INITIAL,
    P_LATERAL,
    P_MASS,
    P_MU_K,
    P_MU_S,
    P_NATURAL_LENGTH,
    P_NORMAL_FORCE,
    P_RADIUS,
    P_RATE,
    P_REFERENCE,
    P_RUN_UP,
    P_SENSITIVITY,
    P_SHORTEST,
    P_SIZE,
    P_SPEED_SCALE,
    P_STIFFNESS,
    P_TABLEAU,
    P_TOLERANCE,
)
from .kernel.tableau import flat_tableau

GRAVITY = 9.81  # m/s^2

# where each parameter stands, for those that enter the kernel as they are
SLOTS = {
    "rig.mass": P_MASS,
    "rig.contact_radius": P_RADIUS,
    "rig.free_y": P_FREE_Y,
    "rig.free_phi": P_FREE_PHI,
    "rig.spring_natural_length": P_NATURAL_LENGTH,
    "springs.stiffness": P_STIFFNESS,
    "friction.mu_s": P_MU_S,
    "friction.mu_k": P_MU_K,
    "lateral_friction.ratio": P_LATERAL,
    "turning_surface.curvature": P_CURVATURE,
    "temperature_dependence.sensitivity": P_SENSITIVITY,
    "temperature_dependence.reference_degC": P_REFERENCE,
    "surface.run_up_time": P_RUN_UP,
    "initial.x": P_INITIAL,
    "initial.y": P_INITIAL + 1,
    "initial.phi": P_INITIAL + 2,
    "initial.vx": P_INITIAL + 3,
    "initial.vy": P_INITIAL + 4,
    "initial.omega": P_INITIAL + 5,
    "solver.tolerance": P_TOLERANCE,
}


def pack(values: dict[str, float]) -> list[float]:
    """Kernel vector ``p`` from a mapping ``block.parameter`` -> value in SI units.

    ``values`` holds every key of `SLOTS` and what the geometry is made of: ``rig.inertia`` (0: a
    disc of the contact radius), ``rig.spring_length``, ``rig.attachment_radius``,
    ``rig.attachment_angles_deg[1]`` ... ``[4]``. The values are taken as checked.
    """
    p = [0.0] * P_SIZE
    for name, slot in SLOTS.items():
        p[slot] = float(values[name])
    radius = p[P_RADIUS]
    p[P_INERTIA] = values["rig.inertia"] or 0.5 * p[P_MASS] * radius * radius
    p[P_NORMAL_FORCE] = p[P_MASS] * GRAVITY
    _place_springs(p, values)
    _set_scales(p)
    p[P_TABLEAU:] = flat_tableau()
    return p


def _place_springs(p: list[float], values: dict[str, float]) -> None:
    """Attachments on the block, and anchors one spring length away from them along x.

    A spring shorter than a twentieth of its installed length has collapsed: the block has been
    carried into the anchor, where the direction of the spring force has no meaning any more.
    """
    if p[P_STIFFNESS] > 0.0:
        p[P_SHORTEST] = 0.05 * values["rig.spring_length"]
    radius = values["rig.attachment_radius"]
    for i in range(4):
        angle = radians(values[f"rig.attachment_angles_deg[{i + 1}]"])
        bx, by = radius * cos(angle), radius * sin(angle)
        outward = 1.0 if bx >= 0.0 else -1.0
        p[P_ATTACH + 2 * i : P_ATTACH + 2 * i + 2] = bx, by
        p[P_ANCHOR + 2 * i : P_ANCHOR + 2 * i + 2] = bx + outward * values["rig.spring_length"], by


def _set_scales(p: list[float]) -> None:
    """Rate and speed that belong to this rig; they scale the integrator's error test only.

    Where nothing sets a rate (no springs) it is 1 rad/s, where nothing sets a speed 1e-6 m/s.
    """
    rate = max(sqrt(4.0 * p[P_STIFFNESS] / p[P_MASS]), 1.0)
    x, y, phi, vx, vy, omega = p[P_INITIAL : P_INITIAL + 6]
    arm = p[P_RADIUS]
    p[P_RATE] = rate
    p[P_SPEED_SCALE] = max(
        p[P_MU_S] * GRAVITY / rate,
        rate * hypot(x, y, arm * phi),
        hypot(vx, vy, arm * omega),
        1e-6,
    )
