import pytest

from thermal.belt.single_pass import FROM_FACTORS, PRINTED, SinglePass

PRINTED_TABLE = {1.0: -7.9435, 2.0: -7.9583, 3.0: -7.9693, 4.0: -7.9774}


def table(check):
    return {length: round(check.temperature_degC(length), 4) for length in PRINTED_TABLE}


def test_printed_force_gives_the_printed_table():
    assert table(PRINTED) == PRINTED_TABLE
    assert round(PRINTED.rise, 4) == 0.0748
    assert round(PRINTED.temperature_degC(0.08), 4) == -7.9252


def test_the_studys_own_factors_do_not():
    assert round(FROM_FACTORS.friction_force, 4) == 4.0349
    assert table(FROM_FACTORS) == {1.0: -7.9447, 2.0: -7.9593, 3.0: -7.97, 4.0: -7.9779}


def test_the_rounded_belt_mass_does_not_either():
    assert table(SinglePass(friction_force=4.1261, heated_mass=5.3e-3))[1.0] == -7.944


@pytest.mark.parametrize(
    "bad", [{"speed": 0.0}, {"heated_mass": -1.0}, {"cooling_rate": float("nan")}]
)
def test_bad_input(bad):
    with pytest.raises(ValueError, match=next(iter(bad))):
        SinglePass(friction_force=4.0, **bad)


def test_belt_shorter_than_the_contact():
    with pytest.raises(ValueError, match=r"belt_length = 0\.07 m: must be at least"):
        PRINTED.temperature_degC(0.07)
