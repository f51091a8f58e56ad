"""The coupled case on the real FMU: what crosses, the closed loop, pictures, state."""

from types import SimpleNamespace
from xml.etree import ElementTree

import numpy as np
import pytest
from ledgers import exchanged, largest_residual

from cosim import Scenario, run_scenario
from cosim.coupling.case.snapshots import Snapshots
from cosim.coupling.case.thermal_participant import ThermalParticipant
from thermal import BeltIceModel

SHORT = {"run.duration": 2.0, "run.snapshot_interval": 0.5}
#: Coarse enough to be quick; conservation does not depend on the mesh.
COARSE = {"belt.cell_length": 5e-3, "belt.elements": 3, "ice.axial_elements": 4}


def case(**changes):
    changes = {key.replace("__", "."): value for key, value in changes.items()}
    return Scenario().changed(SHORT | COARSE | changes)


def last(run, name):
    return run.result[name][-1]


@pytest.fixture(scope="module")
def plain(fmu):
    return run_scenario(case(), fmu=fmu)


def test_a_run_is_complete_and_no_joule_is_lost(plain):
    run = plain
    assert run.result.status == "complete" and run.result.time[-1] == 2.0
    assert len(run.result.time) == 201
    ledger = run.result.ledger
    assert exchanged(ledger) > 0.1
    np.testing.assert_allclose(ledger.flows[0].in_transit, 0.0, atol=1e-13)
    assert largest_residual(ledger) < 1e-10 * exchanged(ledger)


def test_temperature_acts_on_friction_only_when_it_is_asked_to(plain, fmu):
    fed = "mechanics.interface_temperature"
    assert plain.result[fed][-1] == plain.result["thermal.interface_temperature"][-2]
    warm = run_scenario(case(temperature_dependence__sensitivity=5.0), fmu=fmu)
    slip = (plain.result["mechanics.mode"] == 1) & (warm.result["mechanics.mode"] == 1)
    # mu_k of the step is that of the temperature which its start was given
    rise = warm.result[fed][slip] - -8.0
    force = np.abs(warm.result["mechanics.friction_force_x"][slip])
    expected = 0.2086 * 0.67 * 9.81 * (1.0 - 5.0 * rise)
    np.testing.assert_allclose(force, expected, rtol=1e-6)
    assert np.ptp(expected) > 1e-3


def test_pictures_at_every_interval_and_at_the_end(fmu, tmp_path):
    short = case(run__duration=0.7, run__snapshot_interval=0.25)
    run = run_scenario(short, fmu=fmu, fields=tmp_path)
    np.testing.assert_allclose(run.snapshots.time, [0.0, 0.25, 0.5, 0.7])
    assert run.snapshots.temperature.shape == (4, 200) == (4, run.snapshots.position.size)
    entries = ElementTree.parse(run.snapshots.file).iter("DataSet")
    assert [float(entry.get("timestep")) for entry in entries] == run.snapshots.time.tolist()
    true, thicker = (len(list(tmp_path.glob(name))) for name in ("*e_0*.vtu", "*x_0*.vtu"))
    assert true == thicker == 4 and len(list(tmp_path.glob("*.vtu"))) == 8


def test_fields_that_cannot_be_written_fail_the_run_and_keep_the_rest(
    fmu, tmp_path, monkeypatch, full_disk
):
    monkeypatch.setattr("thermal.output.FieldSeries.write", full_disk)
    run = run_scenario(case(), fmu=fmu, fields=tmp_path)
    assert run.result.status == "failed" and "No space left" in run.result.reason


#: Ice so near to melting that the first friction melts it.
WARM = {
    "ambient.temperature_degC": -1e-6, "surface.run_up_time": 0.5, "run.duration": 0.8,
    "run.snapshot_interval": 0.5,
}  # fmt: skip
FEELING = {
    "temperature_dependence.sensitivity": 0.02,
    "asperity_melting.length": 1e-3,
    "mixed_lubrication.share": 0.5,
}


@pytest.mark.parametrize("effect", FEELING)
def test_melting_goes_on_where_friction_feels_it(fmu, effect):
    run = run_scenario(case().changed(WARM | {effect: FEELING[effect]}), fmu=fmu)
    assert run.result.status == "complete"
    if effect != "asperity_melting.length":  # which leaves no friction where the ice would melt
        assert last(run, "thermal.melted_mass") > 0.0
    if effect == "mixed_lubrication.share":  # the film is handed over
        fed, film = run.result["mechanics.film_thickness"], run.result["thermal.film_thickness"]
        np.testing.assert_array_equal(fed[1:], film[:-1])


@pytest.mark.parametrize("effect", [{}, {"melt_film.wetted_share": 1e-3}])
def test_melting_beside_dry_friction_ends_the_run_before_it(fmu, effect):
    run = run_scenario(case().changed(WARM | effect), fmu=fmu)
    assert run.result.status == "failed"
    assert "the face of the ice has come to 0 degC and melts" in run.result.reason
    assert last(run, "thermal.melted_mass") == 0.0 and len(run.result.time) > 1
    assert run.snapshots.time[-1] == run.result.time[-1]
    assert run.snapshots.temperature[-1].max() <= 0.0


def model():
    return BeltIceModel(case().thermal)


def started(model, observer=None):
    part = ThermalParticipant(model, observer=observer)
    part.enter_initialisation(0.0, 1.0)
    part.exit_initialisation()
    return part


def fed(part, time, size, **values):
    """What it gives after a step with these inputs."""
    part.write(values)
    part.step(time, size)
    return part.read()


def test_a_participant_takes_differences_of_totals():
    part, direct = ThermalParticipant(model()), model()
    part.enter_initialisation(0.0, 1.0)
    part.write({"heat": 2.0, "surface_travel": 1.0, "x": 0.5})
    part.exit_initialisation()
    found = fed(part, 0.0, 0.1, heat=2.5, surface_travel=1.2, x=0.55)
    direct.step(0.1, heat=0.5, displacement=0.15)
    assert found["heat_received"] == pytest.approx(0.5, rel=1e-14)
    assert found == pytest.approx(direct.outputs(), abs=1e-12)


def test_a_total_that_falls_by_rounding_is_made_up_for_and_one_that_falls_is_refused():
    part = started(model())
    for heat in (1.0, 1.0 - 1e-15, 1.5):
        found = fed(part, 0.0, 0.1, heat=heat)
    assert found["heat_received"] == 1.5
    with pytest.raises(ValueError, match="must not be negative"):
        fed(part, 0.0, 0.1, heat=1.4)


def test_stick_is_no_movement_whatever_rounding_says():
    part = started(model())
    entry = fed(part, 0.0, 0.1, heat=1.0, surface_travel=0.3, x=0.1)["belt_entry_temperature"]
    at = part.model.contact_position
    found = fed(part, 0.1, 1e-6, surface_travel=0.4, x=0.2 + 1e-16)
    assert part.model.contact_position == at
    assert found["belt_entry_temperature"] == pytest.approx(entry, abs=1e-3)
    fed(part, 0.2, 0.1, surface_travel=0.45)
    assert part.model.contact_position == pytest.approx(at - 0.05, abs=1e-14)


def test_a_creep_far_below_a_millimetre_a_second_is_movement():
    """1 um in a step after 3 m of travel: a contact that creeps at 0.1 mm/s."""
    part = started(model())
    fed(part, 0.0, 0.1, surface_travel=3.0, x=0.1)
    at = part.model.contact_position
    fed(part, 0.1, 0.01, surface_travel=3.1, x=0.2 - 1e-6)
    assert part.model.contact_position == pytest.approx(at - 1e-6, abs=1e-14)


def test_a_participant_goes_back_and_on_bit_for_bit():
    part = started(model())
    fed(part, 0.0, 0.1, heat=0.1, surface_travel=0.02)
    state = part.get_state()
    first = fed(part, 0.1, 0.1, heat=0.3, x=0.01)
    part.set_state(state)
    assert fed(part, 0.1, 0.1, heat=0.3, x=0.01) == first
    part.enter_initialisation(0.0, 1.0)
    assert part.read()["heat_received"] == 0.0


def test_a_state_that_is_taken_back_is_in_no_picture():
    seen = model()
    pictures = Snapshots(seen, 0.1)
    part = started(seen, pictures)
    part.observe()
    start = part.get_state()
    for heat in (9.0, 0.1):  # a first try, and the step that counts
        part.set_state(start)
        fed(part, 0.0, 0.1, heat=heat)
    part.observe()
    assert pictures.time.tolist() == [0.0, 0.1]
    assert pictures.temperature.max() < -7.9


WARM_FRICTION = case(temperature_dependence__sensitivity=0.05)


@pytest.fixture(scope="module")
def warm_rise(fmu):
    """Of the interface at the end, K, by the scheme that nobody has to ask for."""
    return last(run_scenario(WARM_FRICTION, fmu=fmu), "thermal.interface_temperature") + 8.0


@pytest.mark.parametrize("method", [
    {"scheme": "jacobi", "extrapolation": "linear"},
    {"scheme": "gauss_seidel", "extrapolation": "quadratic"},
    {"scheme": "iterated", "sweep": "jacobi"},
    {"scheme": "iterated", "acceleration": "aitken"},
    {"step_control": "defect", "extrapolation": "linear"},
    {"step_control": "doubling"},
], ids=lambda method: " ".join(method.values()))  # fmt: skip
def test_every_method_couples_the_case(method, warm_rise, fmu):
    """Joules are handed over when they are there: none is made or lost whatever the method."""
    changes = {f"coupling.{key}": value for key, value in method.items()}
    result = run_scenario(WARM_FRICTION.changed(changes), fmu=fmu).result
    assert result.status == "complete", result.reason
    (flow,) = result.ledger.flows
    # Jacobi hands over a step late; an iteration is as exact as its tolerance of a microjoule
    late = np.max(np.diff(flow.handed)) if "jacobi" == method.get("scheme") else 0.0
    assert np.abs(flow.in_transit).max() <= late + 1e-6
    assert result["thermal.interface_temperature"][-1] + 8.0 == pytest.approx(warm_rise, rel=0.1)


def test_the_belt_runs_over_its_railing_also_where_the_block_sticks():
    """By what the surface has travelled since the last step, wherever the run began."""
    steps = []
    model = SimpleNamespace(state=list, restore=list, step=lambda *given: steps.append(given))
    heat = ThermalParticipant(model)
    heat.enter_initialisation(0.0, 1.0)
    heat.write({"surface_travel": 5.0, "x": 0.0})
    heat.exit_initialisation()
    for time, travel in ((0.0, 5.3), (0.1, 5.4)):
        heat.write({"surface_travel": travel, "x": travel - 5.0})
        heat.step(time, 0.1)
    assert [slid for _, _, slid, _ in steps] == [0.0, 0.0]
    np.testing.assert_allclose([railed for *_, railed in steps], [0.3, 0.1], rtol=1e-12)
