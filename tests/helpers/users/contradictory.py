"""Parameters that cannot stand side by side, as given to a unit or a scenario by their names."""


def places(name, *numbers):
    """The first places of a parameter of several numbers."""
    return {f"{name}[{i + 1}]": number for i, number in enumerate(numbers)}


CURVE = places("springs.force_curve_extension", 0.0, 0.1, 0.2)
TABLE = places("friction.table_speed", 0.0, 0.1, 0.2)
MU = places("friction.table_mu", 0.3, 0.2, 0.1)
DEGREES = "friction.table_temperature_degC"
BRISTLES = {"friction.presliding_distance": 5e-5, "friction.transition_speed": 3e-3}
STATE = {"rate_and_state.direct": 0.01}

EXTENSION, FORCE = "springs.force_curve_extension", "springs.force_curve_force"
SPEED, FRICTION = "friction.table_speed", "friction.table_mu"
GIVEN = {**TABLE, **MU}

#: What is given, of which something is said; each code at least once.
CONTRADICTIONS = {
    "CREEP_BESIDE_STATE_LAW": [({**STATE, "friction.stick_creep": 1e-3}, "0.001 m/s beside rate")],
    "TRANSITION_BESIDE_STATE_LAW": [
        ({"rate_and_state.evolution": 0.1, **BRISTLES}, "friction.transition_speed = 0.003 m/s")],
    "BRISTLES_WITHOUT_TRANSITION": [
        ({"friction.presliding_distance": 5e-5}, "friction.presliding_distance = 5e-05 m with")],
    "BRISTLES_BESIDE_CREEP": [
        ({**BRISTLES, "friction.stick_creep": 1e-3}, "5e-05 m beside friction.stick_creep")],
    "BRISTLES_BESIDE_STICK_STIFFNESS": [
        ({**BRISTLES, "stick_stiffness.ratio": 0.25}, "5e-05 m beside stick_stiffness")],
    "SPRINGS_COIL_ON_COIL": [
        ({"rig.spring_natural_length": 0.41}, "0.41 m is more than twice rig.spring_length = 0.2")],
    "FORCE_CURVE_OF_ONE_POINT": [
        (places(EXTENSION, *[0.1] * 16), "begins at 0.1 m"),
        (places(EXTENSION, 0.2, 0.1), "does not grow to a second value"),
        (places(FORCE, 0.0, 1.0), "no force curve (all 0) or 2 to 16")],
    "FORCE_CURVE_GOES_BACK": [
        (places(EXTENSION, 0.0, 0.1, 0.05), "extensions must grow"),
        (places(EXTENSION, 0.0, 0.1, 0.0, 0.0, 0.2), "or all are 0"),
        ({**CURVE, **places(FORCE, 0.0, 1.0, 2.0, 3.0)}, "or all are 0")],
    "FORCE_CURVE_FALLS": [({**CURVE, **places(FORCE, 0.0, 2.0, 1.0)}, "must not fall")],
    "TABLE_OF_ONE_POINT": [
        (places(FRICTION, 0.1), "begins at 0 m/s and does not grow"),
        (places(SPEED, 0.1), "no table (all 0) or 2 to 16 points")],
    "TABLE_GOES_BACK": [
        (places(SPEED, 0.0, 0.1, 0.05), "speeds must grow"),
        ({**GIVEN, "friction.table_mu[9]": 0.2}, "or all are 0")],
    "TABLE_AT_NEGATIVE_SPEED": [({**MU, **places(SPEED, -0.1, 0.1, 0.2)}, "begins at -0.1 m/s")],
    "TABLE_OF_NEGATIVE_FRICTION": [({**GIVEN, f"{FRICTION}[2]": -0.2}, "allowed is at least 0")],
    "TABLE_BESIDE_DRY_LAW": [
        ({**GIVEN, "velocity_weakening.linear": 0.1}, "friction.table_speed beside an effe"),
        ({**GIVEN, "viscoelastic_peak.height": 0.1}, "give one of the two")],
    "TABLE_TEMPERATURES_GO_BACK": [
        ({**GIVEN, **places(DEGREES, -8.0, -9.0)}, "friction.table_temperature_degC must"),
        # not ended by its last value: is 0 degC one of them, or none?
        ({**TABLE, **places(FRICTION, *[0.2] * 9), **places(DEGREES, -9.0, -8.0, 0.0, -1.0)},
         "beyond the last one its value again")],
    "TABLE_ROW_WITHOUT_FRICTION": [
        # a single temperature, and 0 degC in the places behind it
        ({**GIVEN, f"{DEGREES}[1]": -8.0}, "places repeat its value"),
        ({**TABLE, **places(FRICTION, *[0.2] * 6), **places(DEGREES, -9.0, -8.0)},
         "no friction at one of the temperatures")],
    "SURFACE_TURNS_UNDER_BLOCK": [
        ({"turning_surface.curvature": -20.0, "rig.contact_radius": 0.05}, "curvature = -20 1/m")],
    "FULL_RIPPLE_TOO_FAST": [
        ({"speed_ripple.amplitude": 1.0, "speed_ripple.frequency": 100.5},
         "speed_ripple.frequency = 100.5 Hz: a full ripple")],
    "GUIDED_Y_MOVES": [
        ({"rig.free_y": 0, "initial.vy": -0.1}, "initial.vy = -0.1 m/s in a rig that is guided")],
    "GUIDED_PHI_TURNS": [
        ({"rig.free_phi": 0, "initial.omega": 2.0}, "initial.omega = 2 rad/s in a rig that is")],
}  # fmt: skip
