"""A block on springs along one line, so that they are linear; and the rig of the source study."""

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


def published(pretension: float = 0.03, damping: float = 0.0, **blocks) -> Parameters:
    """The published rig on a belt that runs up in 10 s, its friction in the plane.

    pretension: m of each spring; with 30 mm the block keeps to its line
    """
    tables = {
        "rig": {"spring_natural_length": 0.2 - pretension},
        "lateral_friction": {"ratio": 1.0},
        "surface": {"speed": 0.15, "run_up_time": 10.0},
        "structural_damping": {"coefficient": damping},
    }
    merged = {name: tables.get(name, {}) | blocks.get(name, {}) for name in {**tables, **blocks}}
    return Parameters(**merged)
