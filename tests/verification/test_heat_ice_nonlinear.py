"""How much the constant properties of the ice cost: against conductivity and capacity that vary.

Reference: a half-space of ice under constant flux, finite volumes for the enthalpy with

    k = 9.828 exp(-0.0057 T) W/mK,  c = 152.5 + 7.122 T J/kgK,  T in K

(Yen, Review of thermal properties of snow, ice and sea ice, CRREL 81-10, 1981), between -16 and 0
degC 2.27 ... 2.07 W/mK and 1985 ... 2098 J/kgK: what one loses the other gains, the effusivity that
the face feels changes less than either.
"""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from thermal import Ice

RHO, ZERO = 917.0, 273.15
DURATION, CELLS, DEEP = 30.0, 400, 0.12


def conductivity(kelvin):
    return 9.828 * np.exp(-0.0057 * kelvin)


def capacity(kelvin):
    return 152.5 + 7.122 * kelvin


def face_rise(ambient, flux, k=conductivity, c=capacity):
    """Rise of the face (K) after 30 s under flux (W/m2), from ambient (degC)."""
    edges = DEEP * (np.expm1(np.linspace(0.0, 6.0, CELLS + 1)) / np.expm1(6.0))
    size = np.diff(edges)
    centres = 0.5 * (edges[1:] + edges[:-1])
    start = np.full(CELLS, ambient + ZERO)

    def rate(_, kelvin):
        between = -k(0.5 * (kelvin[1:] + kelvin[:-1])) * np.diff(kelvin) / np.diff(centres)
        through = np.concatenate(([flux], between, [0.0]))
        return -np.diff(through) / (size * RHO * c(kelvin))

    bands = np.eye(CELLS) + np.eye(CELLS, k=1) + np.eye(CELLS, k=-1)
    run = solve_ivp(rate, (0.0, DURATION), start, "BDF", rtol=1e-8, atol=1e-8, jac_sparsity=bands)
    first = run.y[0, -1]
    return first + flux * centres[0] / k(first) - start[0]


def flux_for(ambient, rise):
    """Flux (W/m2) that warms a face by about `rise` (K) in 30 s."""
    kelvin = ambient + ZERO + 0.5 * rise
    effusivity = np.sqrt(conductivity(kelvin) * RHO * capacity(kelvin))
    return 0.5 * rise * effusivity / np.sqrt(DURATION / np.pi)


def constant(value):
    return lambda kelvin: value + 0.0 * kelvin


def test_the_reference_itself():
    """Constant properties: 2 q sqrt(t/pi)/e."""
    found = face_rise(-8.0, 1e3, constant(2.2), constant(2050.0))
    exact = 2e3 * np.sqrt(DURATION / np.pi) / np.sqrt(2.2 * RHO * 2050.0)
    assert found == pytest.approx(exact, rel=1e-4)


#: degC of the air, rise in K; errors of the rise in %: default properties, those at the air's
#: temperature, those at the temperature that the face comes to.
FOUND = {
    (-8.0, 0.85): (-1.03, -0.09, 0.01),
    (-16.0, 0.85): (-0.17, -0.09, 0.0),
    (-8.0, 8.0): (-1.78, -0.84, 0.06),
    (-16.0, 16.0): (-1.74, -1.65, 0.10),
}


def errors(ambient, rise):
    """As in `FOUND`."""
    flux = flux_for(ambient, rise)
    exact = face_rise(ambient, flux)
    kinds = Ice(), Ice.at(ambient), Ice.at(ambient + rise)
    return [
        100.0
        * (
            face_rise(ambient, flux, constant(ice.conductivity), constant(ice.heat_capacity))
            / exact
            - 1.0
        )
        for ice in kinds
    ]


@pytest.mark.parametrize(("ambient", "rise"), FOUND)
def test_error_of_constant_properties(ambient, rise):
    assert errors(ambient, rise) == pytest.approx(FOUND[ambient, rise], abs=0.02)
