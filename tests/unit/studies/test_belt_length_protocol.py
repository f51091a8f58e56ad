"""The belt's length as the experiment is run: ramps, pauses, runs in a row, scenarios."""

from dataclasses import replace

import pytest

from cosim import Scenario
from cosim.studies.belt_length import CAMERA, Case, Protocol, StudyError, scenario_case
from cosim.studies.belt_length.drift import changes, drift, interface_drift, run_drift, wait
from thermal import ParameterError

AS_PRINTED = 0.05


def test_the_ice_warms_itself_whatever_the_belt():
    """0.82 m/s without a ramp: 0.33 K on 7.3 m, 0.28 K where nothing comes round."""
    found = drift(Case(7.3, 0.82, h=15.0, protocol=Protocol(ramp=0.0)))
    assert found.interface_run == found.interface_drift == pytest.approx(0.33, rel=AS_PRINTED)
    assert found.interface_run_endless == pytest.approx(0.28, rel=AS_PRINTED)
    assert found.run == pytest.approx(CAMERA, rel=AS_PRINTED), "and yet the belt comes round cold"


def test_a_belt_that_never_comes_round_enters_cold():
    assert run_drift(Case(4.2, 0.15)) == 0.0 < run_drift(Case(3.5, 0.15))
    warm_rollers = Case(4.2, 0.15).changed({"belt.rollers": 2, "belt.roller_rise": 1.0})
    assert run_drift(warm_rollers) > 0.01


def test_a_second_run_begins_as_the_pause_leaves_it():
    once = Case(2.0, 0.5)
    short, long = (
        run_drift(replace(once, protocol=Protocol(pause=pause, runs=2))) for pause in (5.0, 3600.0)
    )
    assert run_drift(once) < 0.7 * short
    assert long == pytest.approx(run_drift(once), rel=0.03)


@pytest.mark.parametrize("runs", [1, 3])
def test_waiting_so_long_is_enough_and_less_is_not(runs):
    case = Case(2.0, 0.5, protocol=Protocol(runs=runs))
    found = wait(case, CAMERA)
    assert found.before == max(2, runs)
    assert found.drift is None and "enters 0.25 K warm at the end of the first run" in found.reason
    for pause, says in ((1.02 * found.begin, True), (0.95 * found.begin, False)):
        sliding = case.sliding()
        before = replace(case, protocol=replace(case.protocol, runs=found.before - 1, pause=pause))
        before.follow(sliding)
        state = case.rest(sliding, pause)
        warmest = max(state.ice_face, *sliding.face([i * 0.01 for i in range(200)]))
        assert bool(warmest < CAMERA) is says


def test_a_longer_wait_for_a_run_that_must_stay_cool_too():
    found = wait(Case(2.0, 0.15), CAMERA)
    assert 0.0 < found.begin < found.drift
    pause = Protocol(pause=found.drift, runs=2)
    assert run_drift(Case(2.0, 0.15, protocol=pause)) == pytest.approx(CAMERA, rel=0.02)


def test_waiting_in_vain_is_told_with_the_reason():
    warm_rollers = Case(1.0, 0.5).changed(
        {"belt.rollers": 2, "belt.roller_conductance": 1e3, "belt.roller_rise": 1.0}
    )
    found = wait(warm_rollers, CAMERA)
    assert found.belt is None and found.begin is None
    assert "the belt is not within 0.07 K of the air after 6 h" in found.reason


def test_lifting_the_ice_lets_the_belt_cool_sooner():
    resting = wait(Case(1.0, 0.5), CAMERA)
    lifted = wait(Case(1.0, 0.5, protocol=Protocol(lifted=True)), CAMERA)
    assert lifted.belt < resting.belt


def test_what_would_help_is_computed_change_by_change():
    found = {one.what: one for one in changes(Case(2.0, 0.5))}
    start = found["as it is"]
    assert start.interface_drift == pytest.approx(interface_drift(Case(2.0, 0.5)))
    half = found["half the mass"]
    # still air takes 1 % less, per kelvin, of a belt that is half as warm
    assert (half.run, half.interface_run) == pytest.approx(
        (0.5 * start.run, 0.5 * start.interface_run), rel=5e-3
    )
    assert found["belt that never comes round"].run == 0.0
    assert found["belt twice as long"].run < start.run
    assert found["air 8 K colder"].run == pytest.approx(start.run, rel=0.02)
    assert found["sample twice as high"].interface_drift == pytest.approx(
        start.interface_drift, rel=2e-3
    )
    cold = found["sample 1 K colder than the air at the start"]
    warm = found["sample 0.3 K warmer than the air at the start"]
    assert cold.run < start.run < warm.run


TABLES = {
    "rig": {"mass": 0.9}, "friction": {"mu_s": 0.4, "mu_k": 0.25},
    "surface": {"speed": -0.4, "run_up_time": 4.0}, "run": {"duration": 12.0},
    "belt": {"length": 1.5, "railing_length": 0.1, "railing_friction": 0.1, "rollers": 2},
    "contact": {"conductance": 5e3}, "ambient": {"temperature_degC": -12.0},
}  # fmt: skip


def test_a_scenario_says_it_all():
    case = scenario_case(Scenario.from_tables(TABLES))
    assert (case.length, case.speed, case.mass, case.friction) == (1.5, 0.4, 0.9, 0.25)
    assert case.protocol == Protocol(ramp=4.0, run=8.0)
    assert case.h is None and 5.0 < case.film < 10.0
    thermal = case.thermal()
    assert thermal.belt.rollers == 2 and thermal.contact.conductance == 5e3
    assert thermal.belt.railing_load == pytest.approx(0.9 * 9.81)
    assert thermal.ambient.temperature_degC == -12.0
    given = TABLES | {"belt": TABLES["belt"] | {"air_heat_transfer": 15.0}}
    assert scenario_case(Scenario.from_tables(given)).film == 15.0


def test_the_block_presses_on_the_railing_of_a_scenario():
    own = TABLES | {"belt": TABLES["belt"] | {"railing_load": 20.0}}
    assert Scenario.from_tables(own).thermal.belt.railing_load == 20.0
    again = Scenario.from_tables(Scenario.from_tables(TABLES).to_tables())
    assert again.thermal == Scenario.from_tables(TABLES).thermal


def test_scenarios_without_belt_or_constant_speed_are_refused():
    with pytest.raises(StudyError, match="nothing is left at constant speed"):
        scenario_case(Scenario.from_tables(TABLES | {"run": {"duration": 4.0}}))
    with pytest.raises(StudyError, match="has no belt"):
        scenario_case(Scenario.from_tables({"rig": {"surface": "slab"}}))


def test_layers_keep_their_numbers_and_are_not_overridden():
    layers = [
        {"thickness": 3e-4, "density": 2600.0, "heat_capacity": 780.0, "conductivity": 2.0},
        {"thickness": 7e-4, "density": 500.0, "heat_capacity": 1300.0, "conductivity": 0.12},
    ]
    case = scenario_case(Scenario.from_tables(TABLES | {"belt": {"layers": layers}}))
    assert len(case.thermal().belt.layers) == 2
    with pytest.raises(ParameterError, match="layers are both given"):
        replace(case, conductivity=0.6).thermal()
