"""Kinetic friction by a table over sliding speed and temperature, against scipy and the unit."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator
from stickslip import Parameters, simulate
from stickslip.friction.table_file import read_table
from stickslip.kernel.friction.coefficient import is_felt
from stickslip.kernel.friction.table import table_coefficient
from stickslip.kernel.layout import P_MU_K, U_FILM, U_SIZE, U_TEMPERATURE

from cosim.scenario import read_scenario

SPEED = (0.0, 0.05, 0.1, 0.3, 0.6)
TEMPERATURE = (-20.0, -10.0, -4.0, -1.0)
#: Colder ice rubs more, at no two speeds in the same proportion; the last row has a minimum.
MU = (
    0.40, 0.38, 0.35, 0.30, 0.28,
    0.30, 0.24, 0.20, 0.18, 0.17,
    0.25, 0.15, 0.12, 0.10, 0.09,
    0.12, 0.06, 0.04, 0.05, 0.08,
)  # fmt: skip


def table(speed=SPEED, temperature=TEMPERATURE, mu=MU) -> dict:
    numbers = {"table_speed": speed, "table_temperature_degC": temperature, "table_mu": mu}
    return {"friction": {"mu_s": 0.5, **{key: tuple(value) for key, value in numbers.items()}}}


def peer(speed, temperature, mu):
    """(v, T) -> scipy's PCHIP over T of its PCHIPs over v, constant beyond the ends."""
    rows = np.reshape(mu, (len(temperature), len(speed)))
    if len(temperature) == 1:
        return lambda v, _: float(PchipInterpolator(speed, mu)(np.clip(v, speed[0], speed[-1])))

    def at(v, degrees):
        v = np.clip(v, speed[0], speed[-1])
        degrees = np.clip(degrees, temperature[0], temperature[-1])
        values = [float(PchipInterpolator(speed, row)(v)) for row in rows]
        return float(PchipInterpolator(temperature, values)(degrees))

    return at


steps = st.lists(st.floats(0.5, 15.0), max_size=5)
spans = st.lists(st.floats(1e-3, 0.3), min_size=1, max_size=15)


@settings(max_examples=40)
@given(spans, steps, st.randoms(use_true_random=False))
def test_it_is_scipys_pchip_of_pchips(spans, steps, draw):
    """None of the temperatures: a row over the speed alone, scipy's PCHIP itself."""
    speed, temperature = np.cumsum([0.0, *spans]), np.cumsum([-25.0, *steps])
    size = len(speed) * len(temperature)
    mu = [draw.choice([0.1, 0.2, draw.uniform(0.01, 0.5)]) for _ in range(size)]
    given, there = temperature if steps else (), peer(speed, temperature, mu)
    p = Parameters(**table(speed, given, mu)).pack()
    corners = [(speed[0], temperature[-1] + 1.0), (speed[-1] + 1.0, temperature[0] - 1.0)]
    drawn = [
        (draw.uniform(0.0, speed[-1]), draw.uniform(temperature[0], temperature[-1]))
        for _ in range(8)
    ]
    for v, degrees in [
        *corners,
        *drawn,
        (speed[-1], temperature[0]),
        (speed[1], temperature[len(steps) // 2]),
    ]:
        assert table_coefficient(p, v, degrees) == pytest.approx(there(v, degrees), abs=1e-14)


def test_the_temperature_is_felt_only_through_it():
    with_it, without = (
        Parameters(**each).pack() for each in (table(), table(temperature=(), mu=MU[:5]))
    )
    u = [0.0] * U_SIZE
    assert is_felt(with_it, u, U_TEMPERATURE) and not is_felt(with_it, u, U_FILM)
    assert not is_felt(without, u, U_TEMPERATURE)
    assert with_it[P_MU_K] == 0.40  # what any row holds at rest


def test_a_slip_has_the_friction_of_the_interface():
    """At the temperature of a point: the motion of the table of that row alone; and the ledger."""
    rig = {"rig": {"spring_natural_length": 0.17}, "initial": {"vx": 0.15}}
    for number, degrees in enumerate(TEMPERATURE[1:3], 1):
        row = MU[5 * number : 5 * number + 5]
        both, alone = (
            simulate(
                Parameters(**rig, **each), 1.0, 0.05,
                interface_temperature=degrees, interpreted=True,
            )
            for each in (table(), table(temperature=(), mu=row))
        )  # fmt: skip
        # mu_k at rest, which scales the error test, is that of the coldest row in one of them
        np.testing.assert_allclose(both["x"], alone["x"], rtol=0, atol=1e-9)
        assert np.abs(both["energy_residual"]).max() < 1e-9


def test_a_file_in_any_order(tmp_path):
    rows = [(v, MU[5 * i + j], t) for j, v in enumerate(SPEED) for i, t in enumerate(TEMPERATURE)]
    text = "".join(f"{v},{mu},{t}\n" for v, mu, t in rows)
    (tmp_path / "mu.csv").write_text(f"v,mu,T_degC\n{text}", encoding="utf-8")
    assert read_table(tmp_path / "mu.csv") == (SPEED, TEMPERATURE, MU)
    friction = read_scenario("reference", {"friction.table": str(tmp_path / "mu.csv")}).friction
    assert (friction.table_mu, friction.table_temperature_degC) == (MU, TEMPERATURE)


@pytest.mark.parametrize(("change", "what"), [
    ({"temperature": (-4.0,), "mu": MU[:5]}, "table_temperature_degC has 1 value"),
    ({"temperature": (-4.0, -8.0), "mu": MU[:10]}, "table_temperature_degC must grow"),
    ({"mu": MU[:-1]}, "table_mu has 19 values: allowed are 20"),
    ({"mu": (*MU[:15], *[0.0] * 5)}, "no friction at one of the temperatures"),
])  # fmt: skip
def test_numbers_that_are_no_table(change, what):
    with pytest.raises(ValueError, match=what):
        Parameters(**table(**change))
