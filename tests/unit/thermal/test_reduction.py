"""The reduced belt and ice answer heat at the contact as the whole ones do."""

import numpy as np
import pytest
from scipy.linalg import eigh

from thermal import BeltIceModel, ParameterError, ThermalParameters
from thermal.reduction import reduce
from thermal.relaxation import mean_response

STEPS = [1e-3, 5e-3, 1e-2, 0.1, 1.0, 30.0, 1000.0]  # s


def mean_rise(matrix, load, duration):
    """Step-mean at the load's place for 1 W of it, K."""
    rates, shapes = eigh(matrix)
    return float((load @ shapes) ** 2 @ (duration * mean_response(rates * duration)))


@pytest.fixture(scope="module")
def made():
    return reduce(ThermalParameters())


@pytest.mark.parametrize(
    ("air", "close"), [(None, 1e-6), (0.0, 2e-4), (100.0, 2e-4), (300.0, 2e-4)]
)
def test_ice(made, air, close):
    """Its space is made for one heat transfer, and good for others."""
    air = made.parameters.ice.air_heat_transfer if air is None else air
    whole = BeltIceModel(ThermalParameters.checked({"ice": {"air_heat_transfer": air}}))
    matrix = made.ice.across + made.ice.upwards + air * (made.ice.side + made.ice.top)
    for duration in STEPS:
        expected = whole.ice.face_response(duration)[0]
        found = mean_rise(matrix, made.ice.contact, duration)
        assert found == pytest.approx(expected, rel=close), duration


def test_belt(made):
    """The face of a column; a millisecond is shorter than any step of a run."""
    belt, whole = made.belt, BeltIceModel(ThermalParameters()).belt
    matrix = belt.conduction + made.parameters.belt.film * belt.film
    for duration in STEPS:
        expected = float(whole.response(duration).kernels[0, 0].sum()) * whole.cell
        close = 2e-3 if duration < 5e-3 else 2e-4
        assert mean_rise(matrix, belt.face, duration) == pytest.approx(expected, rel=close)


def test_no_heat_is_lost_but_to_the_air(made):
    """The constant is in both spaces: without films, the slowest rate is none."""
    for matrix in (made.belt.conduction, made.ice.across + made.ice.upwards):
        rates = np.linalg.eigvalsh(matrix)
        assert abs(rates[0]) < 1e-9 * rates[1]


def test_a_belt_with_few_elements_keeps_them_all():
    few = reduce(ThermalParameters.checked({"belt": {"elements": 2}}))
    assert few.belt.face.size == 5


@pytest.mark.parametrize(("belt", "key"), [
    ({"railing_length": 0.2, "railing_conductance": 10.0}, "belt.railing_length = 0.2"),
    ({"rollers": 2}, "belt.rollers = 2"),
])  # fmt: skip
def test_supports_are_refused(belt, key):
    with pytest.raises(ParameterError, match=key):
        reduce(ThermalParameters.checked({"belt": belt}))
