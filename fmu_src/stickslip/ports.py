"""Inputs and outputs of the mechanical model: where the kernel keeps each, what is known of it."""

from dataclasses import dataclass


@dataclass(frozen=True)
class Port:
    """An input or an output.

    slot: name of its place in the kernel's layout; unit: SI, None for an integer; start: of an
    input.
    """

    name: str
    slot: str
    unit: str | None
    nominal: float | None
    description: str
    min: float | int | None = None
    max: float | int | None = None
    start: float | None = None


# The starts are those of the study's reference case.
INPUTS = (
    Port(
        "surface_speed",
        "U_SPEED",
        "m/s",
        0.1,
        "Speed of the surface after its ramp: a host that ramps it sets surface.run_up_time to 0. "
        "In co-simulation that of the step's beginning, with its rate where a host gives one; "
        "without, a stick is led to it up to the step's end",
        start=0.15,
    ),
    Port(
        "interface_temperature",
        "U_TEMPERATURE",
        "degC",
        10.0,
        "Temperature between block and surface",
        min=-273.15,
        start=-8.0,
    ),
    Port("external_force_x", "U_FORCE_X", "N", 1.0, "Force on the block along x", start=0.0),
    Port("external_force_y", "U_FORCE_Y", "N", 1.0, "Force on the block along y", start=0.0),
    Port("external_moment", "U_MOMENT", "N.m", 0.1, "Moment about the vertical", start=0.0),
    Port(
        "film_thickness",
        "U_FILM",
        "m",
        1e-6,
        "Water between block and surface, mean over the contact",
        min=0.0,
        start=0.0,
    ),
)
OUTPUTS = (
    Port("x", "O_X", "m", 0.1, "Position along the motion of the surface; 0 as installed"),
    Port("y", "O_Y", "m", 0.1, "Position across, to the left of x"),
    Port("phi", "O_PHI", "rad", 0.1, "Rotation about the vertical, counter-clockwise"),
    Port("vx", "O_VX", "m/s", 0.1, "Velocity along x"),
    Port("vy", "O_VY", "m/s", 0.1, "Velocity along y"),
    Port("omega", "O_OMEGA", "rad/s", 1.0, "Angular velocity"),
    Port("friction_force_x", "O_FRICTION_X", "N", 1.0, "Friction on the block along x"),
    Port("friction_force_y", "O_FRICTION_Y", "N", 1.0, "Friction on the block along y"),
    Port("friction_moment", "O_FRICTION_MOMENT", "N.m", 0.1, "Friction moment about the vertical"),
    Port(
        "sliding_speed", "O_SLIDING_SPEED", "m/s", 0.1, "Sliding speed, mean of the disc", min=0.0
    ),
    Port(
        "heat_flow",
        "O_HEAT_FLOW",
        "W",
        0.1,
        "Friction heat, mean over the last step; in model exchange that of the moment",
        min=0.0,
    ),
    Port("heat", "O_HEAT", "J", 1.0, "Friction heat since the start", min=0.0),
    Port("sliding_distance", "O_DISTANCE", "m", 1.0, "Distance slid, mean of the disc", min=0.0),
    Port("surface_travel", "O_TRAVEL", "m", 1.0, "Travel of the surface since the start"),
    Port("mode", "O_MODE", None, None, "0 stick, 1 slip", min=0, max=1),
    Port("slip_time", "O_SLIP_TIME", "s", 1.0, "Time spent in slip since the start", min=0.0),
    Port("slip_count", "O_SLIPS", None, None, "Break-aways since the start", min=0),
    Port("energy_residual", "O_ENERGY_RESIDUAL", "J", 1.0, "Energy gained less energy supplied"),
    Port("surface_work", "O_SURFACE_WORK", "J", 1.0, "Work of the surface on the block"),
    Port("external_work", "O_EXTERNAL_WORK", "J", 1.0, "Work of the external forces"),
    Port("damping_heat", "O_DAMPED", "J", 1.0, "Heat in structural damping", min=0.0),
    Port(
        "surface_speed_actual", "O_SURFACE_SPEED", "m/s", 0.1, "Speed of the surface, ramp included"
    ),
)
