"""The numbers of melting against a run made up by hand, and the figure where something melted."""

import json

import numpy as np
import pytest
import xarray as xr
from test_report_dataset import coupled_dataset

from cosim.report import summary
from cosim.report.contents import tables_of
from cosim.report.figures import PLATES, plates_of
from cosim.report.heat_numbers import film_of, melting, melts
from cosim.scenario import Scenario

MASS, RADIUS, SPEED, ONSET, END = 40.0, 0.04, 3.0, 2.0, 6.0
DRY, WET, ETA, ROUGHNESS, SHARE = 0.2, 0.1, 1.79e-3, 2e-6, 0.8
LOAD, AREA = MASS * 9.81, np.pi * RADIUS**2
THICKNESS, RATE = 1.5e-6, 4e-4


def melted(thickness=THICKNESS, **changes) -> xr.Dataset:
    """Sliding at one speed; after the onset half the friction, a film, a constant melt rate."""
    water = {"mixed_lubrication.share": SHARE, "mixed_lubrication.roughness": ROUGHNESS}
    case = Scenario().changed({"rig.mass": MASS} | water | changes)
    time = np.linspace(0.0, END, 601)
    wet, grown = time > ONSET, np.maximum(0.0, time - ONSET)
    columns = {
        "mode": np.ones(time.size), "sliding_speed": np.full(time.size, SPEED),
        "friction_force_x": np.zeros(time.size), "heat": 100.0 * time,
        "friction_force_y": -LOAD * np.where(wet, WET, DRY), "melted_mass": RATE * grown,
        "refrozen_mass": 0.25 * RATE * grown, "melt_rate": RATE * wet,
        "wiped_ice_mass": 0.1 * RATE * grown, "film_thickness": thickness * wet,
        "meltwater_heat": 60.0 * grown,
    }  # fmt: skip
    series = {name: ("time", values) for name, values in columns.items()}
    return xr.Dataset(series, {"time": time}, {"parameters": json.dumps(tables_of(case))})


def test_what_melted_and_when():
    found = melting(melted())
    assert found["onset"] == pytest.approx(ONSET, abs=0.011)
    assert found["melted_mass"] == pytest.approx(RATE * (END - ONSET))
    assert found["refrozen_mass"] == pytest.approx(0.25 * RATE * (END - ONSET))
    assert found["wiped_ice_mass"] == pytest.approx(0.1 * RATE * (END - ONSET))
    assert found["melting_share_end"] == pytest.approx(0.6)
    assert found["mean_melt_rate"] == pytest.approx(RATE, rel=3e-3)
    assert found["max_melt_rate"] == RATE
    assert found["melting_share"] == pytest.approx(0.6, rel=3e-3)
    assert found["friction_before"] == pytest.approx(DRY)
    assert found["friction_end"] == pytest.approx(WET)


def test_the_balance_of_the_film():
    found = melting(melted())
    couette = ETA * SPEED / THICKNESS
    flooded = SHARE * THICKNESS / (THICKNESS + ROUGHNESS)
    assert found["film_thickness"] == pytest.approx(THICKNESS)
    # melt rate by mass flow of a film as wide as the belt: rho h w v
    assert found["film_fed_by_melting"] == pytest.approx(RATE / (999.8 * 0.075 * SPEED))
    assert found["friction_stress"] == pytest.approx(WET * LOAD / AREA)
    assert found["whole_film_shear"] == pytest.approx(couette)
    assert found["flooded_share"] == pytest.approx(flooded)
    assert found["water_shear"] == pytest.approx(flooded * ETA * SPEED / (THICKNESS / flooded))
    assert found["largest_flooded_share"] == 1.0


def test_a_film_too_thin_for_its_friction_covers_a_part_of_the_contact():
    """0.65 um under dry friction of 0.21 and the reference block at 0.5 m/s: five times mu p."""
    thin = melted(6.5e-7, **{"rig.mass": 0.67})
    thin["friction_force_y"][:] = 0.21 * 0.67 * 9.81
    thin["sliding_speed"][:] = 0.5
    found = melting(thin)
    excess = found["whole_film_shear"] / found["friction_stress"]
    assert excess == pytest.approx(5.0, abs=0.1)
    assert found["largest_flooded_share"] == pytest.approx(excess**-0.5)
    part = found["largest_flooded_share"]
    # on that part, thicker by as much, it is sheared with all of the friction
    assert part * ETA * 0.5 / (6.5e-7 / part) == pytest.approx(found["friction_stress"])


@pytest.mark.filterwarnings("error")
def test_water_that_is_not_sheared_covers_all():
    still = melted()
    still["sliding_speed"][300:] = 0.0
    assert film_of(still).largest_flooded_share[-1] == 1.0


def test_no_film_in_stick_and_none_without_water():
    dataset = melted()
    dataset["mode"][300:] = 0
    film = film_of(dataset)
    assert not np.any(np.isfinite(film.film_thickness[:200])) and np.all(
        film.friction_stress[:200] > 0.0
    )
    assert not np.any(np.isfinite(film.friction_stress[300:]))
    assert melting(dataset)["friction_end"] is None


def test_the_breadth_of_a_mesh_is_not_known():
    dataset = melted()
    blocks = json.loads(dataset.attrs["parameters"])
    blocks["ice"]["mesh"]["value"] = "sample.msh"
    dataset.attrs["parameters"] = json.dumps(blocks)
    assert melting(dataset)["film_fed_by_melting"] is None


def test_numbers_and_figure_only_where_something_melted():
    dry = coupled_dataset()
    assert not melts(dry) and "melting" not in summary(dry)
    assert {each.name for each in set(PLATES) - set(plates_of(dry))} == {"melting"}
    wet = dry.assign(melted_mass=1e-3 * dry["time"], film_thickness=1e-7 * dry["time"])
    assert summary(wet)["units"]["melting.film_thickness"] == "m"
    assert plates_of(wet) == list(PLATES)
