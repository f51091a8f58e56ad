"""What stands in each of the kernel's flat arrays, from which `layout` is counted.

The kernel speaks only in flat arrays of floats, so that one source runs interpreted (lists)
and as generated C (numpy arrays). Five arrays travel together:

=====  ==========================================================================
``p``  parameters as the motion needs them, constant during a run (`P_*`)
``u``  inputs, constant during a call of `advance` (`U_*`)
``z``  everything that a run remembers; copying it is saving the run (`Z_*`)
``w``  scratch space, without memory between calls (`W_*`)
``e``  log of events (`E_*`)
=====  ==========================================================================

Two more are what ``p`` is made of, once a run:

=====  ==========================================================================
``v``  the value of every parameter as it is given (`V_*`)
``d``  standard random numbers (`D_*`)
``g``  inputs as a host gives them, step by step (`G_*`)
=====  ==========================================================================

An *instant* of the motion is `INSTANT` numbers: time, the integrated state (`X` ...), the mode and
the direction of the last sliding. `z` holds four of them: `HERE`, where the integrator's own step
begins; `NEXT`, where it ends; `SHOWN`, the instant asked for; and `BETWEEN`, for instants on the
way to it.

Nobody numbers by hand: the lists below name what stands in each array and how many numbers it is,
the effects' declarations name theirs, and `constants` counts.
"""

import tomllib
from collections.abc import Iterable, Mapping, Sequence
from math import cos, pi, sin, sqrt
from pathlib import Path

from ..effects import EFFECTS
from ..effects.effect import Effect
from ..generation.slots import draw_slots, effect_slots, seed_of, state_slots, value_slot

Slots = Sequence[tuple[str, int]]

# --- numbers that are no places ---------------------------------------------------------------
GRAVITY = 9.81  # m/s^2
STICK = 0  # modes
SLIP = 1
UNKNOWN = -1.0  # shear of the contact, see BRISTLES
HELD = -2.0  # not known either, but of a block that has stuck for a while
CURVE_LIMIT = 16  # points of a force-length curve, or a table of friction, that ``p`` has room for
CURVE_WIDTH = 4  # extension, force, stiffness, energy
TABLE_WIDTH = 3  # sliding speed, coefficient, its slope
TABLE_ROW = CURVE_LIMIT * TABLE_WIDTH  # of a table of friction, at one temperature
TEMPERATURE_LIMIT = 6  # of a table of friction
TABLE_LIMIT = CURVE_LIMIT * TEMPERATURE_LIMIT  # coefficients of a table
STAGES = 12  # of a step
ALL_STAGES = 16  # with the slope at its end and those that only the interpolant needs
END_OF_STEP = STAGES * ALL_STAGES  # where the weights of the end of a step are in STAGE_WEIGHTS
POWERS = 7  # coefficients of the interpolant for each state
EXTRA_POWERS = 4  # those that need the further stages
LATE = 5  # stages 1 ... LATE - 1 feed later stages only: no result takes their slopes
RAYS = 8
DEPTHS = 4
TRACKED = 3  # outputs at the beginning: x, y and phi, what a tracker sees
# Integrated numbers that the mean of the error norm is taken over. Those of the first effects are
# counted; an effect that brings one of its own changes no other motion by that.
NORM = 14
# what `advance` returns
DONE = 0
STEP_VANISHED = 1  # the error test asks for a step below the resolution of time
NOT_FINITE = 2
SPRING_COLLAPSED = 3  # the block has been carried into the anchor of a spring
TOO_STIFF = 4  # more internal steps than anybody would wait for
MODE_CHANGED = 5  # no failure: what `advance_to_event` was to stop at
SLIDING_BEGINS = 0  # parts of a slip in model exchange, see `exchange`
SLIDING_GOES_ON = 1
SLIDING_ENDS = 2
INDICATORS = 3  # event indicators of model exchange
STEPS_AT_LEAST = 20000  # internal steps that a call of `advance` may always take, and beyond them
STEPS_PER_SECOND = 200000.0  # so many for each second of motion
STEPS_AT_MOST = 4e6  # of a call, which nobody can interrupt: they take some ten seconds

# --- an instant of the motion -----------------------------------------------------------------
MOVING_STATES = ("X", "Y", "PHI", "VX", "VY", "OMEGA")  # what every motion depends on
BRISTLE_STATES = ("SHEAR_X", "SHEAR_Y", "SHEAR_SPIN")  # of the contact, scaled, m; see bristles
REMEMBERED_STATES = (  # what it can depend on by way of friction; the effects' states follow
    "TRAVEL",  # of the surface since the start, m
    "DISTANCE",  # mean sliding distance of the contact, m
)
COUNTED_STATES = (
    "HEAT",  # friction heat since the start, J
    "WORK_SURFACE",  # work of the surface on the block, J
    "WORK_EXTERNAL",  # work of the external forces, J
    "DAMPED",  # work of the block on the structural damping, J
)
DISCRETE_STATES = (
    ("MODE", 1),
    ("DIRECTION", 3),  # unit vector of the scaled sliding velocity
    ("SLIPS", 1),  # break-aways since the start
    ("HOLD_SINCE", 1),  # since when the contact has aged, s: the present stick's beginning
    ("AGE_AWAY", 1),  # age of the contact when it last broke away, s
    ("DISTANCE_AWAY", 1),  # DISTANCE at that moment, m
    ("SLIP_TIME", 1),  # time spent in slip since the start, s
    ("QUASI_STEADY", 1),  # 1 where the direction of a slow slip follows from the load alone
    ("BRISTLES", 1),  # 1 where the contact's shear is integrated; 0 in a fast slip; else not known
)

# --- u: inputs --------------------------------------------------------------------------------
GIVEN_INPUTS = 6  # those that have values
INPUTS = (
    ("U_SPEED", 1),  # m/s
    ("U_TEMPERATURE", 1),  # interface temperature, degC
    ("U_FORCE_X", 1),
    ("U_FORCE_Y", 1),
    ("U_MOMENT", 1),
    ("U_FILM", 1),  # water between block and surface, mean over the contact, m
    ("U_SINCE", 1),  # time at which the inputs have the values above, s
    ("U_RATE", GIVEN_INPUTS),  # with which those above go on from there, per s
    ("U_SPEED_CURVE", 1),  # the rate of that of the speed, m/s^3
)

# --- g: inputs as a host of the FMU gives them, see rig.drive and rig.history
MOMENTS = 16  # times at which inputs are remembered in model exchange
DEGREES = 4  # of the polynomials through some of them
GIVEN = (
    ("G_VALUE", GIVEN_INPUTS),
    ("G_RATE", GIVEN_INPUTS),  # with which it goes on, per s
    ("G_HAS_RATE", GIVEN_INPUTS),  # 1 where the host has said so for the coming step
    ("G_BEFORE", GIVEN_INPUTS),  # its value at the last regular point
    ("G_LAST", GIVEN_INPUTS),  # its value for the last step
    ("G_LINE", GIVEN_INPUTS),  # where what the host has said of it was when the last step began
    ("G_SLOPE", GIVEN_INPUTS),  # and with which rate that goes on, per s
    ("G_GOING", GIVEN_INPUTS),  # rate of the input itself in the last step, per s
    ("G_REACHED", GIVEN_INPUTS),  # where the last step has left it
    ("G_POINT", 1),  # time of the last regular point, s
    ("G_STEP", 1),  # size of the step that the host has asked for there, s; 0: there was none
    ("G_CUT", 1),  # 1: an event has ended that step, and its own end has not been reached
    ("G_CURVE", 1),  # the rate of that of the surface's speed, m/s^3
    ("G_HAD_RATE", 1),  # 1 where the host has said that one's rate at the last regular point
    ("G_RATE_BEFORE", 1),  # and which, m/s^2
    ("G_FIRST", 1),  # 1: an input without a rate goes on as it has between the last two values
    # in model exchange, see rig.history
    ("G_FOLLOWED", GIVEN_INPUTS),  # each at the time asked for
    ("G_TREND", GIVEN_INPUTS),  # and its rate, per s
    ("G_ASIDE", GIVEN_INPUTS),  # by how much each is looked at beside that
    ("G_SET_TIME", 1),  # when the host has given one last, s
    ("G_IS_NEW", 1),  # 1: it has not asked for anything since
    ("G_IN_EVENT", 1),  # 1 where that was in an event which is not yet decided
    ("G_EVENT_TIME", 1),  # of the last event, s
    ("G_GIVES_ALWAYS", 1),  # 1: the host gives them wherever it asks for rates
    ("G_FIRST_RATE", GIVEN_INPUTS),  # the rate that each begins with where only one time is known
    ("G_COURSE", 2),  # one at a time, and its rate
    ("G_ASKED_BY", 1),  # the latest time that was known when the host last asked for rates, s
    ("G_COUNT", 1),  # how many times are remembered
    ("G_MOMENT_TIME", MOMENTS),
    ("G_MOMENT_VALUE", MOMENTS * GIVEN_INPUTS),  # row by row
    ("G_NEAR", DEGREES + 2),  # numbers of the nearest
    ("G_TABLE", DEGREES + 2),  # divided differences
)

# --- p: parameters; those of the effects follow -----------------------------------------------
PARAMETERS = (
    ("P_MASS", 2),  # against motion along x and along y; with the inertia three in a row
    ("P_INERTIA", 1),
    ("P_NORMAL_FORCE", 1),
    ("P_RADIUS", 1),  # contact radius, m
    ("P_FREE", 1),  # of x, y and phi in a row: 1 free, 0 guided
    ("P_FREE_Y", 1),
    ("P_FREE_PHI", 1),
    ("P_SCALES", 3),  # of a sliding velocity x, y, phi as the contact feels it: 1, kappa, kappa a
    ("P_STIFFNESS", 1),  # one spring, N/m
    ("P_NATURAL_LENGTH", 1),
    ("P_ATTACH", 8),  # x, y of each attachment in the block's frame
    ("P_ANCHOR", 8),  # x, y of each anchor in the frame of the rig
    ("P_CURVE_POINTS", 1),  # points of the tabulated force-length curve; 0: none
    ("P_CURVE", CURVE_LIMIT * CURVE_WIDTH),
    ("P_MU_S", 1),
    ("P_MU_K", 1),  # at rest, where a table gives it
    ("P_LOCAL_LAW", 1),  # 1 where mu_k depends on the local sliding speed
    ("P_RUN_UP", 1),  # time of the surface's speed ramp, s
    ("P_TOLERANCE", 1),
    ("P_RATE", 1),  # characteristic rate of the motion, rad/s
    ("P_FEW_POINTS", 1),  # rim speed over sliding speed up to which a few points of the disc do
    ("P_LONGEST_STEP", 1),  # s
    ("P_LONGEST_STICK", 1),  # the same in stick, s
    ("P_SPEED_SCALE", 1),  # speed that the motion reaches by itself, m/s; scales the error test
    ("P_SHORTEST", 1),  # length below which a spring counts as collapsed, m
    ("P_INITIAL", 6),  # x, y, phi, vx, vy, omega
    ("P_FEEDING", 1),  # integrated numbers that the motion depends on: MOVING, SHEARED, REMEMBERED
    ("P_PRESLIDING", 1),  # sliding speed of a stick per load, m/(s N), see stick
    ("P_RELATIVE_STIFFNESS", 4),  # of each spring: what its force is multiplied by
    ("P_TRANSITION_SPEED", 1),  # over which friction falls from mu_s to mu_k, m/s; 0: at once
    ("P_TRANSITION_EXPONENT", 1),
    ("P_BRISTLE_STIFFNESS", 1),  # of the contact against shear, N/m; 0: it is rigid
    ("P_BRISTLE_DAMPING", 1),  # N s/m
    ("P_FAST_SLIP", 1),  # sliding speed from which the shear follows from the slip alone, m/s
    ("P_MU_SCALE", 1),  # what the factors of mu_k multiply: mu_k, or 1 where a table gives it
    ("P_TABLE_POINTS", 1),  # points of the table of mu_k over the sliding speed; 0: none
    ("P_TABLE_ROWS", 1),  # temperatures at which it has them
    ("P_TABLE_TEMPERATURE", TEMPERATURE_LIMIT),  # degC
    ("P_TABLE", TABLE_ROW * TEMPERATURE_LIMIT),
)

# --- v: values of the parameters, those of the effects before them ------------------------------
VALUES = (
    *((f"rig.{name}", 1) for name in ("mass", "contact_radius", "attachment_radius")),
    *((f"rig.{name}", 1) for name in ("spring_length", "spring_natural_length")),
    ("springs.stiffness", 1),
    *((f"friction.{name}", 1) for name in ("mu_s", "mu_k", "stick_creep", "transition_speed")),
    *((f"friction.{name}", 1) for name in ("transition_exponent", "presliding_distance")),
    ("friction.bristle_damping", 1),
    ("surface.run_up_time", 1),
    *((f"initial.{name}", 1) for name in ("x", "y", "phi", "vx", "vy", "omega")),
    *((f"imperfections.{name}", 1) for name in ("seed", "mass", "spring_stiffness")),
    *((f"imperfections.{name}", 1) for name in ("anchor_position", "start_position")),
    ("imperfections.start_angle_deg", 1),
    ("solver.tolerance", 1),
    ("rig.inertia", 1),
    ("rig.attachment_angles_deg", 4),
    ("springs.force_curve_extension", CURVE_LIMIT),
    ("springs.force_curve_force", CURVE_LIMIT),
    ("friction.table_speed", CURVE_LIMIT),
    ("friction.table_mu", TABLE_LIMIT),
    ("friction.table_temperature_degC", TEMPERATURE_LIMIT),
    ("rig.free_y", 1),
    ("rig.free_phi", 1),
)

# --- d: random numbers; those of the effects follow ----------------------------------------------
DRAWS = (  # normal deviates of the rig's imperfections, by imperfections.seed
    ("D_MASS", 1),
    ("D_SPRING_STIFFNESS", 4),
    ("D_ANCHOR_POSITION", 8),  # x, y of each
    ("D_START_POSITION", 2),
    ("D_START_ANGLE", 1),
)

# --- e: log of events -------------------------------------------------------------------------
EVENTS = (("E_COUNT", 1), ("E_CAPACITY", 1))
E_WIDTH = 3  # time, mode after the event, x; from E_FIRST on

# --- r: restarts, one after the other (see `restarts`) -----------------------------------------
RESTART = (
    ("R_ROW", 1),  # number of the time at which it happens
    ("R_STATE", 6),  # x, y, phi, vx, vy, omega; what is not finite stays the model's own
    ("R_HOLD_SINCE", 1),  # when the stick began that the block is in, s; not finite: not in stick
    ("R_MU_S", 1),  # friction from there on
    ("R_MU_K", 1),
    ("R_MU_SCALE", 1),
)

# --- o: what a run shows at an instant --------------------------------------------------------
OUTPUTS = (
    *("O_X", "O_Y", "O_PHI", "O_VX", "O_VY", "O_OMEGA"),
    *("O_FRICTION_X", "O_FRICTION_Y", "O_FRICTION_MOMENT", "O_SLIDING_SPEED", "O_HEAT_FLOW"),
    *("O_HEAT", "O_DISTANCE", "O_MODE", "O_SLIPS", "O_ENERGY_RESIDUAL", "O_TRAVEL"),
    *("O_SURFACE_SPEED", "O_DAMPED", "O_SURFACE_WORK", "O_EXTERNAL_WORK", "O_SLIP_TIME"),
)


def instant(effects: Iterable[Effect]) -> Slots:
    """What an instant of the motion is made of."""
    remembered = (*MOVING_STATES, *BRISTLE_STATES, *REMEMBERED_STATES, *state_slots(effects))
    states = ("TIME", *remembered, *COUNTED_STATES)
    return [*((name, 1) for name in states), *DISCRETE_STATES]


def memory(size: int, states: int, inputs: int) -> Slots:
    """z, of instants of a size: four of them, and what else a run remembers."""
    return (
        ("HERE", size),
        ("NEXT", size),
        ("SHOWN", size),
        ("BETWEEN", size),
        ("Z_STEP", 1),  # size that the next internal step wants, s
        ("Z_HAS_NEXT", 1),  # 1 while NEXT holds the end of the internal step that begins in HERE
        ("Z_ENERGY", 1),  # kinetic and spring energy at the start, J
        ("Z_STARTED", 1),
        ("Z_INPUTS", inputs),  # the inputs that HERE and NEXT were computed with
        ("Z_HEAT_BEFORE", 1),  # friction heat at the communication point before, J
        ("Z_TIME_BEFORE", 1),
        ("Z_STATUS", 1),  # what the last call of `advance` returned
        ("Z_SPAN", 1),  # size of the internal step from HERE to NEXT, s
        ("Z_SMOOTH", 1),  # 1 where the interpolant over that step is accurate enough
        ("Z_DENSE", POWERS * states),  # the interpolant: POWERS rows of coefficients
        ("Z_RAMPING", 1),  # in model exchange: 1 until the end of the speed ramp
        ("Z_SLIDING", 1),  # in model exchange: which part of a slip, SLIDING_...
        ("Z_FASTER", 1),  # in model exchange: sliding speed of the next event of a slip, m/s
    )


def scratch(size: int, states: int) -> Slots:
    """w, for instants of a size."""
    return (
        ("W_STATE", size),  # the instant at which the right-hand side is wanted
        ("W_SLOPES", ALL_STAGES * states),  # ALL_STAGES rows of slopes
        ("W_LOAD", 3),  # springs, damping and external loads on the block: x, y, phi
        ("W_SLIDING", 3),  # velocity of the block relative to the surface: x, y, phi
        ("W_SCALED", 3),  # the same as the contact feels it: U_x, kappa U_y, kappa a Omega, m/s
        ("W_FRICTION", 3),  # friction on the block: x, y, phi
        ("W_MEAN_SPEED", 1),  # local sliding speed, mean over the contact, m/s
        ("W_SURFACE", 6),  # velocity and acceleration of the surface under the block
        ("W_PAIR", 2),  # return values of functions with two results
        ("W_DIRECTION", 3),  # direction of sliding where the velocity is too small to tell
        ("W_STEADY", 3),  # direction of sliding that the load asks for, see steady_sliding
        ("W_TURNING", 3),  # acceleration of a sliding that turns, see steady_sliding
        ("W_HELD", 3),  # the load that the surface would have to hold then
        ("W_BEFORE", 3),  # a direction of sliding that is put back
        ("W_STORED", 3),  # a sliding velocity, and what it becomes, see steady_sliding
        ("W_PLACE", 4),  # time and place that are put back
        ("W_RATES", 3),  # rates of velocities
        ("W_RUNNING_UP", 1),  # 1 while the internal step lies in the surface's speed ramp
        ("W_SPAN", 1),  # size of the step that the slopes belong to, s
        ("W_EXCESS", 1),  # of friction at the first instant of a slip over mu_k, see coefficient
        ("W_KINETIC", 1),  # mu_k before the local sliding speed, for the integral over the disc
        ("W_AGED", 1),  # what the contact's age adds to it
        ("W_WHOLE", 1),  # friction of the whole contact, which the integral is to correct
        ("W_SHEARING", 3),  # rates of the contact's shear, m/s
        ("W_YIELD_RATE", 1),  # at which it gives way, 1/s
    )


def values(effects: Iterable[Effect]) -> Slots:
    """Every parameter and how many numbers it is, in the order of `Parameters.flat`."""
    own = [(f"{effect.id}.{name}", 1) for effect in effects for name in effect.table.model_fields]
    return (*own, *VALUES)


def value_names(effects: Iterable[Effect] = EFFECTS) -> tuple[str, ...]:
    """The FMU's name of every number in ``v``, in order."""
    return tuple(
        name if size == 1 else f"{name}[{i + 1}]"
        for name, size in values(effects)
        for i in range(size)
    )


def drawn(effects: Sequence[Effect], places: Mapping[str, int]) -> dict[str, tuple[float, ...]]:
    """How each number of ``d`` comes about; `places`: of the parameters.

    ``DRAW_SEED``: where in ``v`` the seed is; what one seed draws stands together.
    ``DRAW_UNIFORM``: 1 for a uniform number from 0 to 1, 0 for a normal deviate.
    """
    count = sum(size for _, size in DRAWS)
    seeds = [float(places[value_slot("imperfections.seed")])] * count
    uniform = [0.0] * count
    for effect in effects:
        kinds = [float(kind == "uniform") for kind in effect.draws.values()] * effect.members
        seeds += [float(places[seed_of(effect)])] * len(kinds) if kinds else []
        uniform += kinds
    return {"DRAW_SEED": tuple(seeds), "DRAW_UNIFORM": tuple(uniform)}


def tableau() -> dict[str, tuple[float, ...]]:
    """The method's coefficients, row after row; each stage's row is filled up with zeros."""
    found = tomllib.loads(Path(__file__).with_name("dormand_prince.toml").read_text("utf-8"))
    found["STAGE_WEIGHTS"] = [
        row + [0.0] * (ALL_STAGES - len(row)) for row in [[], *found["STAGE_WEIGHTS"]]
    ]
    return {name: tuple(number for row in table for number in row) for name, table in found.items()}


def quadrature() -> dict[str, tuple[float, ...]]:
    """By which `friction.disc` integrates over the contact.

    Angles of strips and of rays about the centre of rotation (midpoint rule), and the four nodes of
    Gauss and Legendre, in pairs from the inner to the outer, with their weights.
    """
    found: dict[str, tuple[float, ...]] = {}
    for name, parts in (("STRIP", 2 * RAYS), ("RAY", RAYS)):  # parts of half a turn
        angles = [(j + 0.5) * pi / parts for j in range(RAYS)]
        found[f"{name}_COSINES"] = tuple(map(cos, angles))
        found[f"{name}_SQUARED_SINES"] = tuple(sin(angle) * sin(angle) for angle in angles)
    pairs = [
        (sqrt(3.0 / 7.0 + inner * 2.0 / 7.0 * sqrt(6.0 / 5.0)), inner) for inner in (-1.0, 1.0)
    ]
    found["DEPTH_NODES"] = tuple(node for root, _ in pairs for node in (-root, root))
    found["DEPTH_WEIGHTS"] = tuple(
        (18.0 - inner * sqrt(30.0)) / 36.0 for _, inner in pairs for _ in range(2)
    )
    return found


def constants(effects: Sequence[Effect] = EFFECTS) -> dict[str, int | float | tuple[float, ...]]:
    """Name -> value of everything that the kernel knows as a constant, with these effects."""
    plain = (int, float)
    own = {k: v for k, v in _OWN.items() if k.isupper() and type(v) in plain}
    inside = _placed(instant(effects))
    states = inside["MODE"] - 1
    own |= {
        "STATES": states,  # integrated numbers: X ... DAMPED
        "EXCHANGED": states + 1,  # the same and the time in slip: states of model exchange
        "MOVING": len(MOVING_STATES),
        "SHEARED": len(MOVING_STATES) + len(BRISTLE_STATES),
        "REMEMBERED": states - len(COUNTED_STATES),
    }
    size = own["INSTANT"] = inside.pop("SIZE")
    inputs, outputs = _placed(INPUTS), _placed([(name, 1) for name in OUTPUTS])
    given = _placed([(value_slot(name), size) for name, size in values(effects)])
    return {
        **own,
        **inside,
        **_sized(_placed(memory(size, states, inputs["SIZE"])), "Z_SIZE"),
        **_sized(inputs, "U_SIZE"),
        **_sized(_placed([*PARAMETERS, *effect_slots(effects)]), "P_SIZE"),
        **_sized(given, "V_SIZE"),
        **_sized(_placed([*DRAWS, *draw_slots(effects)]), "D_SIZE"),
        **drawn(effects, given),
        **tableau(),
        **quadrature(),
        **_sized(_placed(scratch(size, states)), "W_SIZE"),
        **_sized(_placed(EVENTS), "E_FIRST"),
        **_sized(_placed(GIVEN), "G_SIZE"),
        **_sized(outputs, "O_SIZE"),
        **_sized(_placed(RESTART), "R_SIZE"),
    }


def _placed(slots: Slots) -> dict[str, int]:
    """Where each begins, one after the other, and "SIZE"."""
    places, at = {}, 0
    for name, size in slots:
        if name in places:
            raise ValueError(f"two numbers of the kernel are called {name}")
        places[name] = at
        at += size
    return places | {"SIZE": at}


def _sized(places: dict[str, int], name: str) -> dict[str, int]:
    return {name if key == "SIZE" else key: place for key, place in places.items()}


_OWN = dict(globals())
