"""Parameters that cannot stand side by side, in words. Pure Python: it travels inside the FMU."""

import re
from collections.abc import Mapping

from .kernel.packing import contradictions as codes
from .names import NAMES
from .packing import in_order

#: What is said of each. ``{name:g}`` stands for the value of the parameter of that name, written
#: as by "%g"; there is nothing else in braces.
SAID = {
    codes.NO_CONTRADICTION: "",
    codes.CREEP_BESIDE_STATE_LAW: "friction.stick_creep = {friction.stick_creep:g} m/s beside "
    "rate_and_state, whose contact creeps by its own law; give one of the two",
    codes.TRANSITION_BESIDE_STATE_LAW: "friction.transition_speed = {friction.transition_speed:g} "
    "m/s "
    "beside rate_and_state, whose contact has no mu_s to fall from; give one of the two",
    codes.BRISTLES_WITHOUT_TRANSITION: "friction.presliding_distance = "
    "{friction.presliding_distance:g} m with friction.transition_speed = 0: bristles give way over "
    "a sliding speed; allowed is a transition_speed above 0 m/s",
    codes.BRISTLES_BESIDE_CREEP: "friction.presliding_distance = {friction.presliding_distance:g} "
    "m "
    "beside friction.stick_creep, another law of the same shear; give one of the two",
    codes.BRISTLES_BESIDE_STICK_STIFFNESS: "friction.presliding_distance = "
    "{friction.presliding_distance:g} m beside stick_stiffness, which judges a rigid stick; give "
    "one of the two",
    codes.SPRINGS_COIL_ON_COIL: "rig.spring_natural_length = {rig.spring_natural_length:g} m is "
    "more "
    "than twice rig.spring_length = {rig.spring_length:g} m: a spring pressed below half its "
    "length lies coil on coil; allowed is at most twice the installed length",
    codes.FORCE_CURVE_OF_ONE_POINT: "springs.force_curve_extension begins at "
    "{springs.force_curve_extension[1]:g} m and does not grow to a second value: allowed are no "
    "force curve (all 0) or 2 to 16 points",
    codes.FORCE_CURVE_GOES_BACK: "springs.force_curve_extension and springs.force_curve_force: "
    "extensions must grow from value to value; beyond the last point the places of each repeat "
    "its last value, or all are 0",
    codes.FORCE_CURVE_FALLS: "springs.force_curve_force must not fall from value to value",
    codes.TABLE_OF_ONE_POINT: "friction.table_speed begins at {friction.table_speed[1]:g} m/s and "
    "does "
    "not grow to a second value: allowed are no table (all 0) or 2 to 16 points",
    codes.TABLE_GOES_BACK: "friction.table_speed and friction.table_mu: speeds must grow from "
    "value to "
    "value; beyond the last point the places of each repeat its last value, or all are 0",
    codes.TABLE_AT_NEGATIVE_SPEED: "friction.table_speed begins at {friction.table_speed[1]:g} "
    "m/s: "
    "allowed is at least 0 m/s",
    codes.TABLE_TEMPERATURES_GO_BACK: "friction.table_temperature_degC must grow from value to "
    "value; "
    "allowed are none (all 0) or 2 to 6, and beyond the last one its value again",
    codes.TABLE_ROW_WITHOUT_FRICTION: "friction.table_mu has no friction at one of the "
    "temperatures of "
    "friction.table_temperature_degC: beyond the last temperature, places repeat its value",
    codes.TABLE_OF_NEGATIVE_FRICTION: "friction.table_mu has a negative value: allowed is at least "
    "0",
    codes.TABLE_BESIDE_DRY_LAW: "friction.table_speed beside an effect with another law of the "
    "sliding "
    "speed; give one of the two",
    codes.SURFACE_TURNS_UNDER_BLOCK: "turning_surface.curvature = {turning_surface.curvature:g} "
    "1/m puts "
    "the centre of turning under the block; allowed is a distance 1/|curvature| above "
    "rig.contact_radius = {rig.contact_radius:g} m",
    codes.FULL_RIPPLE_TOO_FAST: "speed_ripple.amplitude = 1 with speed_ripple.frequency = "
    "{speed_ripple.frequency:g} Hz: a full ripple above 100 Hz is no belt; allowed is a smaller "
    "amplitude, or at most 100 Hz",
    codes.GUIDED_Y_MOVES: "initial.vy = {initial.vy:g} m/s in a rig that is guided in y "
    "(rig.free_y = 0): a guided direction has no velocity; allowed is 0 m/s",
    codes.GUIDED_PHI_TURNS: "initial.omega = {initial.omega:g} rad/s in a rig that is guided in "
    "phi "
    "(rig.free_phi = 0): a guided direction has no velocity; allowed is 0 rad/s",
}
#: What a single value must be, whatever its own bounds are.
COMPUTABLE = f"must be 0, or of a size from {codes.SMALLEST:g} to {codes.LARGEST:g}"
_VALUE = re.compile(r"\{([^:{}]+):g\}")


def contradiction(values: Mapping[str, float]) -> str:
    """What two of the parameters (names as of `Parameters.flat`) contradict in; "" if nothing.

    Or why one of them, within its bounds, cannot be computed with.
    """
    v = in_order(values)
    place = codes.beyond_numbers(v)
    if place >= 0:
        return f"{NAMES[place]} = {v[place]:g}: {COMPUTABLE}"
    said = SAID[codes.contradiction(v)]
    return _VALUE.sub(lambda found: f"{values[found[1]]:g}", said)
