"""What the doubt about the belt's length is made of: polynomials, indices, single changes."""

from contextlib import contextmanager
from dataclasses import replace

import numpy as np
import pytest

import cosim.studies.belt_length.case as case_module
from cosim.studies.belt_length import Case, Protocol, unknowns
from cosim.studies.belt_length.drift import interface_drift, run_drift
from cosim.studies.belt_length.lengths import shortest_in_doubt
from cosim.studies.belt_length.rigs import fitted
from cosim.studies.belt_length.uncertainty import uncertainty
from cosim.studies.belt_length.unknowns import answers, as_it_is, combined
from thermal import Belt, Layer, ThermalParameters

CASE = Case(1.0, 0.15)
SAMPLES = 64


@contextmanager
def coarsely():
    """Four times the study's steps: a third of its time, and rises that differ by a hundredth."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(case_module, "COARSENESS", 8.0)
        yield


@pytest.fixture(scope="module")
def found():
    with coarsely():
        return uncertainty(CASE, SAMPLES)


def test_a_polynomial_is_found_again():
    points = np.random.default_rng(1).random((60, 3))

    def model(x):
        return 2.0 + x[:, 0] ** 2 - 3.0 * x[:, 1] * x[:, 2]

    other = np.random.default_rng(2).random((20, 3))
    assert fitted(points, model(points))(other) == pytest.approx(model(other), abs=1e-9)
    grown = fitted(points, np.exp(model(points)))(other)
    assert grown == pytest.approx(np.exp(model(other)), rel=1e-6)


@pytest.mark.parametrize("rise", [0.0, 0.3])
def test_as_it_is_gives_the_drift_as_it_is(rise):
    """Also of a sample that starts warm."""
    values = as_it_is(CASE) | {"sample_rise": rise}
    own = replace(CASE, h=CASE.film, ice_rise=rise)
    drift = combined(answers(CASE, values), values)
    assert drift[unknowns.ENTRY] == pytest.approx(run_drift(own), rel=1e-3)
    assert drift[unknowns.INTERFACE] == pytest.approx(interface_drift(own), rel=1e-3)


def test_the_parts_make_the_drift_of_a_rig_with_all_of_them():
    """Friction, railing and warm rollers superposed, against the rig that has them."""
    values = as_it_is(CASE) | {"friction": 1.1, "railing_friction": 0.15, "railing_share": 0.6}
    values |= {"roller_rise": 0.3, "roller_conductance": 200.0}
    values |= {"contact_area": 0.5, "heat_capacity": 1.2}
    drift = combined(answers(CASE, values), values)
    length = CASE.sliding().footprint.length
    of_railing = {"length": 0.08, "friction": 0.15, "share": 0.6, "load": CASE.mass * 9.81}
    of_railing["conductance"] = CASE.film
    of_rollers = {"belt.rollers": 2, "belt.roller_conductance": 200.0, "belt.roller_rise": 0.3}
    whole = replace(CASE, friction=1.1 * CASE.friction, h=CASE.film, drawn=True).changed(
        {f"belt.railing_{name}": value for name, value in of_railing.items()}
        | of_rollers
        | {"belt.heat_capacity": 1.2 * 840.0, "contact.length": 0.5 * length}
    )
    assert drift[unknowns.ENTRY] == pytest.approx(run_drift(whole), rel=1e-6)
    assert drift[unknowns.INTERFACE] == pytest.approx(interface_drift(whole), rel=1e-6)


def test_a_contact_of_a_third_is_resolved(monkeypatch):
    """Its length is a few waves of a series made for the whole contact: the belt would seem to
    enter a fifth warmer than it does, for heat is smeared into the place where it enters."""
    short = CASE.changed({"contact.length": 0.3 * CASE.sliding().footprint.length})
    found = run_drift(short)
    monkeypatch.setattr(case_module, "WAVES_PER_CONTACT", 30.0)
    # 0.5 % is what the study's resolution errs by, and a little more
    assert found == pytest.approx(run_drift(short), rel=5e-3)


def test_the_ice_melts_where_its_rise_says_so():
    """Answers are as if nothing melted; the model itself melts on either side of the air's
    temperature at which they say so."""
    values = as_it_is(CASE)
    rise = float(combined(answers(CASE, values), values)[unknowns.ICE])
    for part, melts in ((0.97, True), (1.03, False)):
        # films of the air as they are, or they would follow its temperature
        case = replace(CASE, h=CASE.film, ambient_degC=-part * rise)
        assert (case.follow(case.sliding())[1].melting > 0.0) == melts


def test_rigs_whose_ice_melts_are_counted(found):
    """Near 0 degC some of the rigs melt; a unit of warm rollers (1 K) is more than any has."""
    assert found.melts == 0.0
    with coarsely():
        near = uncertainty(replace(CASE, ambient_degC=-0.35), 32)
    assert near is not None and 0.0 < near.melts < 0.5


def test_intervals_of_the_indices_and_what_the_polynomials_miss(found):
    assert found.evaluations == SAMPLES + 2 * len(unknowns.UNKNOWNS)
    for one in found.influences:
        assert max(one["first_order_half_width"], one["total_half_width"]) < 0.05, one["key"]
    assert found.unexplained < 0.05
    # half of the sampled rigs warm more than the rig as it is
    assert found.low < run_drift(CASE) < found.median < found.high
    assert found.interface_low < found.interface_median < found.interface_high
    totals = [influence["total"] for influence in found.influences]
    firsts = [influence["first_order"] for influence in found.influences]
    assert sum(firsts) < 1.0 < sum(totals), "some of it only comes together"
    assert totals == sorted(totals, reverse=True)


def test_single_changes_are_runs_of_the_model(found):
    by_key = {change["key"]: change for change in found.single_changes}
    friction, air = by_key["friction"], by_key["h"]
    with coarsely():
        as_it_is_drift, windy = run_drift(CASE), run_drift(replace(CASE, h=25.0))
    ends = friction["drift_low"], friction["drift_high"]
    assert ends == pytest.approx((0.7 * as_it_is_drift, 1.2 * as_it_is_drift), rel=1e-3)
    assert air["drift_high"] == pytest.approx(windy, rel=0.01)
    assert by_key["roller_rise"]["with_others"] == {"roller_conductance": 100.0}
    assert len(found.table()) == len(unknowns.UNKNOWNS)


def test_no_indices_where_the_ice_melts():
    short = Case(1.0, 3.0, protocol=Protocol(ramp=0.0, run=3.0))
    with coarsely():
        assert uncertainty(replace(short, mass=40.0, ambient_degC=-1.0), 32) is None


def test_a_short_belt_has_room_for_rollers_and_railing():
    short = Case(0.1, 0.15, protocol=Protocol(ramp=0.0, run=1.0))
    values = as_it_is(short) | {"roller_conductance": 100.0}
    assert np.all(np.isfinite(answers(short, values)))


def doubt(found, median, high):
    return replace(found, median=median, high=high, interface_median=median, interface_high=high)


def test_shortest_belts_lie_between_the_lengths_or_are_not_told(found):
    """Rises that fall as a power of the length are met exactly; beyond the lengths a reason."""
    lengths = (1.0, 2.0, 4.0)
    doubts = {length: doubt(found, 0.1 * length**-1.5, 0.5 / length) for length in lengths}
    told = shortest_in_doubt(doubts, 0.07)["run"]
    assert told["median"].length == pytest.approx((0.1 / 0.07) ** (1.0 / 1.5))
    assert told["high"].length is None and told["high"].says == ">4"
    assert "on 4 m, the longest belt looked at, the 95% level is 0.12 K" in told["high"].reason
    told = shortest_in_doubt(doubts, 1.0)["interface"]
    assert told["median"].says == told["high"].says == "<1"
    untold = shortest_in_doubt(dict.fromkeys(lengths), 0.07)["run"]["high"]
    assert untold.length is None and "--samples 0" in untold.reason


def test_a_belt_lags_behind_air_that_warms():
    """Alone with the air: w tau (1 - exp(-t / tau)), tau = C / (2 h)."""
    h, rate, time = 15.0, 0.01, 30.0
    rig = ThermalParameters(belt=Belt(length=20.0))
    sliding = Case(20.0, 0.5, h=h, conductance=1e-6, rig=rig).sliding()
    sliding.force, sliding.air_warming = 0.0, rate
    tau = rig.belt.capacity_per_area / (2.0 * h)
    # 8 cm of 20 m lie under the ice and cool on one face alone; steps of second order
    expected = rate * tau * np.expm1(-time / tau)
    assert sliding.run(time).belt_mean == pytest.approx(expected, rel=4e-3)


#: A coat, steel and a felt, and rollers as warm and as firm as they may be in a doubt.
LAYERS = (
    Layer(thickness=0.2e-3, density=1200.0, heat_capacity=1800.0, conductivity=0.25),
    Layer(thickness=0.5e-3, density=7850.0, heat_capacity=470.0, conductivity=45.0),
    Layer(thickness=0.8e-3, density=500.0, heat_capacity=1400.0, conductivity=0.08),
)


STEEL = Case(2.0, 0.5, rig=ThermalParameters(belt=Belt(length=2.0, width=0.12, layers=LAYERS)))


WARM_ROLLERS = {"belt.rollers": 2, "belt.roller_conductance": 1000.0, "belt.roller_rise": 0.5}


@pytest.mark.parametrize(("length", "error"), [(2.0, 0.12), (5.0, 0.025)])
def test_rollers_that_conduct_err_by_no_more_than_the_page_says(monkeypatch, length, error):
    """On 2 m what warm rollers left enters as a front just as the run ends, which long steps smear
    by 11 % at most; on 5 m only elements count, by 2 %. Finer ones err by some parts of that."""
    warm = STEEL.with_length(length).changed(WARM_ROLLERS)
    found, coarse = run_drift(warm), run_drift(replace(warm, drawn=True))
    monkeypatch.setattr(case_module, "ELEMENTS_ON_ROLLERS", 12)
    monkeypatch.setattr(case_module, "COARSENESS", 0.25)
    fine = run_drift(warm)
    assert found == pytest.approx(fine, rel=error)
    assert abs(found / fine - 1.0) < abs(coarse / fine - 1.0) < 0.12, "the doubt's rigs err by more"
