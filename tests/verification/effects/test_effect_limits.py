"""Every effect tends to the plain model as its parameter tends to off, and with which order.

Seen where the effect acts: in the position after 0.2 s of a slip without events, or in the moment
of the first break-away for what acts through stick. A parameter is halved three times; the order is
that of the last halving, so it also says that nothing is left over at off.
"""

import numpy as np
import pytest
from stickslip import EFFECTS, Parameters, simulate
from stickslip.catalogue import CATALOGUE
from stickslip.kernel import layout
from stickslip.quantity import details

RADIUS = 0.04
WARMER = -6.0  # interface, degC; the reference is -8
WATER = 3e-6  # m in the contact
IN_SLIP = {
    "rig": {"spring_natural_length": 0.17, "contact_radius": RADIUS},
    "lateral_friction": {"ratio": 1.0},
    "initial": {"x": 0.02, "y": 0.005, "phi": 0.05, "vx": -0.1, "vy": 0.01, "omega": -0.3},
}
AT_REST = {
    "rig": {"degrees_of_freedom": ("x",), "spring_length": 1.0, "spring_natural_length": 1.0},
    "initial": {"vx": 0.15},
}
# parameter -> (distance from off at first, what else the table needs, order): what is not of the
# first order, needs more in its table, or is of another at its least typical size
STATED = {
    "lateral_friction.ratio": (0.4, {}, 2),
    "run_in.change": (0.2, {"distance": 0.1}, 1),
    "speed_ripple.amplitude": (0.1, {"frequency": 3.0}, 1),
    "load_dependence.exponent": (0.2, {"reference_force": 3.0}, 1),
    "spring_misalignment.diagonal_offset": (0.01, {}, 1),
    "asperity_melting.length": (5e-6, {"conductivity": 0.0, "roughness": 0.0}, 1),
    "melt_film.wetted_share": (2e-3, {}, 2),
    "rate_and_state.evolution": (0.01, {"distance": 1e-3}, 1),
}
STICKING = {
    "static_strengthening.rate": (0.04, {}, 1), "static_strengthening.saturating": (0.1, {}, 1),
    "static_strengthening.power": (0.1, {}, 1), "stick_stiffness.ratio": (-0.1, {}, 1),
    "temperature_dependence.static_sensitivity": (0.02, {}, 1),
    "rate_and_state.direct": (4e-3, {}, 1), "rate_and_state.evolution": (4e-3, {}, 1),
}  # fmt: skip
# a switch of which nothing is stated acts in slip, to first order from its least typical size
SLIDING = {
    f"{effect.id}.{key}": (details(effect.table.model_fields[key])["typical"][0], {}, 1)
    for effect in EFFECTS
    for key in effect.switch
    if f"{effect.id}.{key}" not in STICKING
} | STATED


def with_effect(base: dict, name: str, share: float, size: float, other: dict) -> Parameters:
    """The rig with one parameter at ``share`` of ``size`` away from off."""
    table, key = name.split(".")
    entry = next(effect for effect in EFFECTS if effect.id == table)
    off = entry.table.model_fields[key].default
    return Parameters(**(base | {table: other | {key: off + share * size}}))


def position_in_slip(parameters: Parameters) -> np.ndarray:
    """(x, y, a phi) in m after 0.2 s on a film of water, 2 K warmer than the reference."""
    kernel = CATALOGUE.compiled
    p, u, z = np.array(parameters.pack()), np.zeros(layout.U_SIZE), np.zeros(layout.Z_SIZE)
    w, e = np.zeros(layout.W_SIZE), np.zeros(layout.E_FIRST)
    u[layout.U_SPEED], u[layout.U_TEMPERATURE], u[layout.U_FILM] = (
        parameters.surface.speed, WARMER, WATER,
    )  # fmt: skip
    kernel.initialise(p, z, 0.0)
    kernel.advance(p, u, z, w, e, 0.2)
    assert e[layout.E_COUNT] == 0.0 and z[layout.SHOWN + layout.MODE] == layout.SLIP
    place = z[layout.SHOWN + layout.X : layout.SHOWN + layout.PHI + 1].copy()
    place[2] *= RADIUS
    return place


def order(value_at, plain) -> float:
    """Order at which the distance from the plain model falls in the last of three halvings."""
    sizes = [np.linalg.norm(value_at(0.5**k) - plain) for k in range(4)]
    assert sizes[3] < sizes[2] < sizes[1] < sizes[0]
    return np.log2(sizes[2] / sizes[3])


@pytest.mark.parametrize("name", SLIDING)
def test_slip_tends_to_the_plain_one(name):
    size, other, expected = SLIDING[name]

    def place(share):
        return position_in_slip(with_effect(IN_SLIP, name, share, size, other))

    plain = position_in_slip(Parameters(**(IN_SLIP | {name.split(".")[0]: {}})))
    # the next order still shows at an eighth of the first size: 0.02 at most was found
    assert order(place, plain) == pytest.approx(expected, abs=0.03)


@pytest.mark.parametrize("name", STICKING)
def test_break_away_tends_to_the_plain_one(name):
    """With rate_and_state mu_s is not used: its plain model is the one with mu_s = mu_k."""
    size, other, expected = STICKING[name]
    friction = {"mu_s": 0.2086, "mu_k": 0.2086} if name.startswith("rate_and_state") else {}
    base = AT_REST | {"friction": friction}

    def first_slip(parameters):
        return simulate(parameters, 3.0, 1.0, interface_temperature=WARMER).slip_starts[0]

    plain = first_slip(Parameters(**base))
    found = order(lambda share: first_slip(with_effect(base, name, share, size, other)), plain)
    assert found == pytest.approx(expected, abs=0.03)


def test_every_switch_of_every_effect_is_tried():
    switches = {f"{effect.id}.{key}" for effect in EFFECTS for key in effect.switch}
    assert switches == set(SLIDING) | set(STICKING)
