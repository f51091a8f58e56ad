"""The packaged case that melts, against the same rig written down once more (`melting_by_hand`).

The two share no code and no discretisation: the model conducts in modes of finite elements and
hands heat and film over every 10 ms, finite volumes and 0.5 ms there. Friction, film and melted
mass agree to 0.7 % from 0.8 s after the onset. The onset itself is 7 ms late: the ice beside the
belt, which a single column does not have, takes some of the heat. With a belt as wide as the block
the onsets differ by 1 ms in 690.
"""

import numpy as np
import pytest
from melting_by_hand import MeltingBlock

from cosim import read_scenario, run_scenario
from cosim.report import run_columns, summary

END = 4.5
MACRO_STEP = 0.01


@pytest.fixture(scope="module")
def coupled():
    run = run_scenario(read_scenario("meltwater").changed({"run.duration": END}))
    assert run.result.status == "complete"
    return run.result


@pytest.fixture(scope="module")
def numbers(coupled):
    case = read_scenario("meltwater").changed({"run.duration": END})
    return summary(run_columns(coupled, case, case.to_toml()).to_xarray())


@pytest.fixture(scope="module")
def by_hand():
    return MeltingBlock().run(END)


def at(coupled, name, time):
    return float(np.interp(time, coupled.time, coupled[name]))


def test_it_melts_when_it_does_by_hand(numbers, by_hand):
    assert numbers["melting"]["onset"] == pytest.approx(by_hand.onset, abs=1.5 * MACRO_STEP)


@pytest.mark.parametrize("time", [1.5, 2.5, 3.5, END])
def test_friction_film_and_melted_mass_by_hand(coupled, by_hand, time):
    friction = at(coupled, "mechanics.friction_force_x", time)
    assert friction == pytest.approx(by_hand.at("friction", time), rel=5e-3)
    film = at(coupled, "thermal.film_thickness", time)
    assert film == pytest.approx(by_hand.at("film", time), rel=1e-2)
    melted = at(coupled, "thermal.melted_mass", time)
    assert melted == pytest.approx(by_hand.at("melted", time), rel=1e-2)


def test_the_onset_where_the_whole_face_touches():
    steps = dict.fromkeys(("coupling.macro_step", "run.output_interval"), 1e-3)
    case = read_scenario("meltwater").changed({"run.duration": 0.9, "belt.width": 0.08} | steps)
    run = run_scenario(case).result
    one_column = MeltingBlock(area=np.pi * 0.04**2, width=0.08, dt=2.5e-4).run(0.9)
    onset = run.time[np.argmax(run["thermal.melted_mass"] > 0.0)]
    assert onset == pytest.approx(one_column.onset, abs=2.5e-3)
    # it grows as the square of the time since the onset: 1 ms of 0.2 s are 1 %
    assert run["thermal.melted_mass"][-1] == pytest.approx(one_column.at("melted", 0.9), rel=0.02)


def test_every_ledger_closes(numbers):
    ledger = numbers["ledger"]
    assert ledger["mechanics"]["relative_residual"] < 1e-9
    assert ledger["heat"]["relative_residual"] < 1e-11
    assert ledger["coupling"]["relative_difference"] < 1e-12


def test_the_balance_closes_on_itself(numbers):
    """Friction heat melts, what melts is the film, the film's shear and the dry rest are friction.

    Worked out from four numbers of the summary; the mean of a second against its ends: 0.5 %.
    """
    melting = numbers["melting"]
    film, roughness, pressure = melting["film_thickness"], 2e-6, 40.0 * 9.81 / (np.pi * 0.04**2)
    assert film == pytest.approx(melting["film_fed_by_melting"], rel=5e-3)
    w = film / (film + roughness)
    assert melting["flooded_share"] == pytest.approx(w, rel=5e-3)
    water = w**2 * 1.79e-3 * 3.0 / film
    assert melting["water_shear"] == pytest.approx(water, rel=5e-3)
    assert melting["friction_stress"] == pytest.approx(
        (1.0 - w) * 0.2086 * pressure + water, rel=5e-3
    )
    assert melting["flooded_share"] < melting["largest_flooded_share"]
    assert melting["friction_end"] < 0.65 * melting["friction_before"]
    assert melting["friction_before"] == pytest.approx(0.2086, rel=1e-3)
