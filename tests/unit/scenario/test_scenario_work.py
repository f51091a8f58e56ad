"""What would not end is refused before it starts; what takes long says so."""

import math
import time
import warnings

import pytest
from refusals import one_line
from stickslip import Parameters, simulate, status
from stickslip.status import MOST_STEPS_PER_SECOND, longest_step, time_to_slide

from cosim.cli.runs.running import scenario_to_run
from cosim.coupling.case import run_scenario
from cosim.scenario import Scenario, ScenarioError, check_work, read_scenario
from cosim.studies.sweep import SweepError, product_grid
from thermal.ice.melting import LONGEST_RECESSION
from thermal.model import BeltIceModel
from thermal.work import ice_unknowns, internal_steps

#: Changes of the reference case that cannot end, and words of the one line that says so.
ENDLESS = {
    "an age": ({"run.duration": 1e12, "run.output_interval": 1e6, "coupling.macro_step": 1e6},
               ("run.duration: 1e+12 s", "6.9 years", "run.patience = 3600 s")),
    "springs of a hammer": ({"springs.stiffness": 1e12},
        ("springs.stiffness = 1e+12 N/m", "2.57e-06 s", "allowed are steps from 5e-06 s")),
    "a speck": ({"rig.mass": 1e-12}, ("rig.mass = 1e-12 kg", "allowed are steps from 5e-06 s")),
    "bristles of nothing": ({"friction.presliding_distance": 1e-12,
            "friction.transition_speed": 1e-3},
        ("friction.presliding_distance = 1e-12 m", "allowed are steps from 5e-06 s")),
    "a day on sandpaper": ({**{"surface_pattern.amplitude": 0.1,
                "surface_pattern.wavelength": 1e-5},
            **{"run.duration": 86400.0, "run.output_interval": 1.0, "coupling.macro_step": 1.0}},
        ("run.duration: 86400 s", "surface_pattern.wavelength = 1e-05 m", "run.patience")),
    "an hour of stiff springs": ({"springs.stiffness": 1e9, "run.duration": 3600.0},
        ("run.duration: 3600 s", "springs.stiffness = 1e+09 N/m", "run.patience = 3600 s")),
}  # fmt: skip
#: Changes of the reference case that are followed in steps of different kinds, by what.
FOLLOWED = {
    "the rig alone": {"run.duration": 60.0},
    "guides": {"run.duration": 60.0, "rig.degrees_of_freedom": ["x"]},
    "exactness": {"solver.tolerance": 1e-13},
    "a transition": {"friction.transition_speed": 2e-3},
    "bristles": {"friction.transition_speed": 2e-3, "friction.presliding_distance": 1e-6},
    "a fine pattern": {"surface_pattern.amplitude": 0.1, "surface_pattern.wavelength": 1e-3},
    "rate and state": {"rate_and_state.direct": 0.01, "rate_and_state.evolution": 0.02},
    "rate and state, slow": {**{"rate_and_state.direct": 0.01, "rate_and_state.evolution": 0.02},
        **{"surface.speed": 1e-3, "surface.run_up_time": 1.0, "run.duration": 40.0}},
}  # fmt: skip
ENDLESS_HEAT = {
    "ice of nothing": ({"ice.density": 1e-6},
        ("run.duration: 30 s", "ice.density = 1e-06 kg/m3", "run.patience = 3600 s")),
    "a belt of a thousand loops": ({"surface.speed": 1e3, "coupling.macro_step": 2.0,
            "run.output_interval": 2.0}, ("coupling.macro_step: 2 s", "2e+03 loops", "up to 1000")),
    "a mesh without patience": ({"ice.radial_elements": 40, "ice.axial_elements": 40,
            "run.patience": 60.0},
        ("ice.radial_elements: 40", "6561 unknowns", "35 min", "run.patience = 60 s")),
}  # fmt: skip


@pytest.mark.parametrize("case", ENDLESS | ENDLESS_HEAT)
def test_what_would_not_end_is_refused(case):
    changes, words = (ENDLESS | ENDLESS_HEAT)[case]
    scenario = read_scenario("reference").changed(changes)
    line = one_line(ScenarioError, check_work, scenario, coupled=True)
    assert all(word in line for word in words), line
    with pytest.raises(ScenarioError):
        run_scenario(scenario)


@pytest.mark.parametrize("case", ENDLESS_HEAT)
def test_heat_is_no_matter_of_the_mechanics_alone(case):
    scenario = read_scenario("reference").changed(ENDLESS_HEAT[case][0])
    assert check_work(scenario, coupled=False) < 60.0


def test_patience_lifts_the_limit():
    hour = read_scenario("reference").changed(ENDLESS["an hour of stiff springs"][0])
    patient = hour.changed({"run.patience": 1e5})
    assert 3600.0 < check_work(patient, coupled=True) < 1e5


def test_a_long_run_says_so_and_goes_on(tmp_path, capsys):
    file = tmp_path / "long.toml"
    file.write_text("[springs]\nstiffness = 1e9\n[run]\nduration = 300.0\n")
    assert scenario_to_run(str(file), coupled=False).run.duration == 300.0
    assert capsys.readouterr().err == "note: this run takes some 7.7 min\n"


def seconds_of(changes):
    """Computing time of the mechanics alone, and what was estimated, s."""
    scenario = read_scenario("reference").changed({"run.duration": 12.0, **changes})
    estimated = check_work(scenario, coupled=False)
    begun = time.process_time()
    assert simulate(scenario.mechanics, scenario.run.duration, 0.1).complete
    return time.process_time() - begun, estimated


def test_no_estimate_is_off_by_a_hundred():
    """Beside that of stiff springs, whose steps are all of one length, on the same machine.

    The estimate knows neither how much of the time is slip nor how many steps an event takes:
    measured were 0.4 to 30.
    """
    seconds_of({"run.duration": 0.1})  # loads the compiled model
    took, estimated = seconds_of({"springs.stiffness": 1e5})
    for name, changes in FOLLOWED.items():
        own, foretold = seconds_of(changes)
        ratio = (own / foretold) / (took / estimated)
        assert 1 / 100 < ratio < 100, (name, ratio)


def test_a_sweep_refuses_the_combination_that_would_not_end():
    grid = product_grid(read_scenario("reference"), {"springs.stiffness": [20.0, 1e12]})
    with pytest.raises(SweepError, match=r"springs\.stiffness.*1e\+12.*allowed are steps from"):
        grid.keys()


@pytest.mark.parametrize("fast, complete", [(0.25, True), (1.5, False)])
def test_steps_shorter_than_allowed_are_those_that_the_kernel_gives_up_on(fast, complete):
    """A second in one row, in which the kernel takes 20000 steps more than those of a second."""
    rate = 0.5 * fast * MOST_STEPS_PER_SECOND
    parameters = Parameters.model_validate(
        {"rig": {"mass": 1.0, "degrees_of_freedom": ["x"]}, "springs": {"stiffness": rate**2 / 4}}
    )
    assert longest_step(parameters).per_second == pytest.approx(fast * MOST_STEPS_PER_SECOND)
    assert simulate(parameters, 1.0, 1.0).complete == complete


def test_the_heat_takes_the_steps_that_are_foretold(monkeypatch):
    scenario = Scenario.from_tables({"surface": {"speed": 2.0}, "ice": {"density": 1e-3}})
    model, made = BeltIceModel(scenario.thermal), []
    monkeypatch.setattr(model, "_advance", lambda *step: made.append(step))
    for heating, speed in ((0.0, 0.0), (0.0, 2.0), (0.5, 2.0)):
        made.clear()
        model.step(0.01, 0.01 * heating, 0.01 * speed)
        foretold = internal_steps(scenario.thermal, 0.01, 0.01, speed, heating)
        # whole steps, of a contact as long as the disc is wide: it is shorter by a fifth
        assert foretold <= len(made) < 1.3 * foretold + 1.0
    assert len(made) > 100 and LONGEST_RECESSION > 0.0
    assert ice_unknowns(scenario.thermal) == model.ice.rates.size - _touching(model)


def _touching(model):
    """Rows of nodes that the kink of the contact adds."""
    heights = model.ice.z.size
    return (model.ice.r.size - 2 * 6 - 1) * heights


def test_no_packaged_case_has_to_be_patient():
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for name in ("reference", "study", "slab", "warm_friction", "melting_friction"):
            assert check_work(read_scenario(name), coupled=True) < 60.0


def test_a_block_that_is_carried_takes_the_steps_of_one_that_does_not_slide():
    """Rate and state, on a surface that in the whole run does not come as far as the springs bear.

    Counted as if it slid, it was some hundred times too much.
    """
    slow = {
        "rate_and_state.direct": 0.005, "rate_and_state.evolution": 0.02,
        "surface.speed": 1e-4, "surface.run_up_time": 0.0, "initial.vx": 1e-4,
        "run.duration": 20.0,
    }  # fmt: skip
    carried = read_scenario("reference").changed(slow)
    run = simulate(carried.mechanics, 20.0, 1.0)
    assert run.slip_starts.size == 0 and run.slip_share == 0.0
    sliding = carried.changed({"initial.vx": 0.0})
    estimates = [check_work(one, coupled=False) for one in (carried, sliding)]
    assert estimates[0] < 0.01 * estimates[1]
    # one that breaks away is counted as before, from when it can
    later = time_to_slide(carried.mechanics)
    longer = carried.changed({"run.duration": 2.0 * later})
    step = status.likely_step(carried.mechanics).per_second * status.SECONDS_PER_STEP
    assert check_work(longer, coupled=False) == pytest.approx(later * step, rel=0.01)


@pytest.mark.parametrize("ramp", [0.0, 1.0, 30.0])
def test_the_time_to_slide_is_before_the_first_break_away(ramp):
    """And not by more than the half of friction that it is for: of the plain model."""
    parameters = Parameters(
        surface={"speed": 0.02, "run_up_time": ramp}, initial={"vx": 0.02 if ramp == 0.0 else 0.0}
    )
    first = simulate(parameters, 60.0, 1.0).slip_starts[0]
    assert 0.3 * first < time_to_slide(parameters) < first
    assert time_to_slide(Parameters(surface={"speed": 0.0})) == math.inf
    assert time_to_slide(Parameters(surface={"speed": 0.02}, initial={"vx": 0.01})) == 0.0
