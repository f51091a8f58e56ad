"""A block on springs along one line, so that they are linear; on the surface at the start."""

from stickslip import Parameters

GRAVITY = 9.81
MASS, STIFFNESS, MU_S, MU_K = 0.67, 4.0 * 20.17, 0.3, 0.2  # stiffness: of all springs
ONE_LINE = (180.0, 0.0, 180.0, 0.0)


def line(speed: float, law: dict[str, float], **tables) -> Parameters:
    """On a surface of that speed (m/s); law: of friction, beside mu; tables: more of others.

    What a table has more wins over what the line has of it.
    """
    own = {
        "rig": {"mass": MASS, "degrees_of_freedom": ("x",), "attachment_angles_deg": ONE_LINE},
        "friction": {"mu_s": MU_S, "mu_k": MU_K} | law,
        "surface": {"speed": speed},
        "initial": {"vx": speed},
    }
    merged = {name: own.get(name, {}) | tables.get(name, {}) for name in {**own, **tables}}
    return Parameters(**merged)
