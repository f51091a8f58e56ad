"""Each unit reproduces the run that it brings along, as the FMI cross-check asks: its inputs, its
times and tolerance, and its outputs, computed by the models in Python."""

import zipfile

import fmpy
import numpy as np
import pytest
from fmpy.util import read_csv, read_ref_opt_file, validate_result

from cosim.fmu.build import THERMAL, THERMAL_PYTHON, build_fmu
from cosim.fmu.platforms import this_platform


@pytest.fixture(scope="module")
def units(fmu, fmu3, python_fmu, tmp_path_factory):
    """Name -> file and what is beside its page, of every unit."""
    folder = tmp_path_factory.mktemp("units")
    heat = [build_fmu(folder, name, [this_platform()]) for name in (THERMAL, THERMAL_PYTHON)]
    found = {}
    for unit in (fmu, fmu3, python_fmu, *heat):
        with zipfile.ZipFile(unit) as archive:
            archive.extractall(folder / unit.stem)
        found[unit.name] = (unit, folder / unit.stem / "documentation")
    return found


def run(units, name, kind="CoSimulation"):
    """Outputs of the run and those to compare with."""
    unit, folder = units[name]
    model = fmpy.read_model_description(unit).modelName
    options = read_ref_opt_file(folder / f"{model}_ref.opt")
    found = fmpy.simulate_fmu(
        str(unit),
        fmi_type=kind,
        input=read_csv(folder / f"{model}_in.csv"),
        start_time=options["StartTime"],
        stop_time=options["StopTime"],
        output_interval=options["StepSize"],
        relative_tolerance=options["RelTol"],
    )
    expected = read_csv(folder / f"{model}_ref.csv")
    causes = {v.name: v.causality for v in fmpy.read_model_description(unit).modelVariables}
    assert 7 <= len(expected.dtype.names) - 1 <= 10  # as the rules recommend
    assert {causes[each] for each in expected.dtype.names[1:]} == {"output"}
    assert found["time"][-1] == options["StopTime"]
    return found, expected


@pytest.mark.parametrize(
    "name", ["StickSlip3DOF.fmu", "StickSlip3DOF-fmi3.fmu", "StickSlip3DOF-python.fmu"]
)
def test_the_block_moves_as_in_the_reference(units, name):
    """The same arithmetic; fmpy's times differ by rounding, which each of the slips passes on."""
    found, expected = run(units, name)
    np.testing.assert_allclose(found["time"], expected["time"], rtol=0, atol=1e-12)
    for each in expected.dtype.names[1:]:
        size = np.abs(expected[each]).max()
        np.testing.assert_allclose(found[each], expected[each], rtol=0, atol=1e-8 * size)
    assert expected["slip_count"][-1] > 6 and np.ptp(expected["x"]) > 0.01


@pytest.mark.parametrize("name", ["StickSlip3DOF.fmu", "StickSlip3DOF-fmi3.fmu"])
def test_a_host_s_own_integrator_moves_it_so_too(units, name):
    """fmpy's CVODE at the tolerance of the run, by which events differ by some 1e-6 s; the band is
    that of the cross-check, a tenth of the range and twenty of a thousand samples wide."""
    found, expected = run(units, name, "ModelExchange")
    assert validate_result(found, expected.copy(), stop_time=5.0) < 0.02  # at jumps
    last = {each: (found[each][-1], expected[each][-1]) for each in expected.dtype.names}
    assert last["slip_count"][0] == last["slip_count"][1]
    for each in ("x", "heat", "sliding_distance"):
        assert last[each][0] == pytest.approx(last[each][1], abs=2e-6)


#: What the reduced unit leaves out, K, 1 and J: of the size that its documentation says.
REDUCED = {"temperature": 2e-6, "belt_share": 2e-5, "melt": 1e-12, "heat": 2e-6}


@pytest.mark.parametrize("name", [THERMAL, THERMAL_PYTHON])
def test_belt_and_ice_warm_as_in_the_reference(units, name):
    found, expected = run(units, name)
    for each in expected.dtype.names[1:]:
        kind = next(key for key in REDUCED if key in each)
        allowed = REDUCED[kind] if name == THERMAL else 1e-10  # the same model, told as CSV
        np.testing.assert_allclose(found[each], expected[each], rtol=0, atol=allowed)
    assert np.ptp(expected["interface_temperature"]) > 0.05
