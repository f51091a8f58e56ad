"""BeltIceThermal, whole and reduced: states that go on, and what is refused."""

import subprocess
import sys
import zipfile

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error
from heat_instance import H, constant, instance

# --- states ---


def test_a_state_is_all_that_a_continuation_needs(heat):
    """Also as bytes, and in the middle of melting."""
    given = constant(60, 5.0, 0.4)
    heat.start(ambient__temperature_degC=-0.05)
    heat.run(*given)
    state = heat.slave.getFMUState()
    first = continued(heat)
    saved = heat.slave.serializeFMUState(state)
    heat.slave.setFMUState(state)
    assert np.array_equal(continued(heat), first)
    heat.slave.setFMUState(heat.slave.deserializeFMUState(saved))
    assert np.array_equal(continued(heat), first)
    assert first[-1, 6] > 0.0


def continued(heat):
    rows = []
    for n in range(60, 100):
        heat.slave.doStep(n * H, H)
        rows.append(heat.outputs())
    return np.array(rows)


def test_a_reset_forgets_the_run(heat):
    given = constant(30)
    first = heat.start(x=0.02).run(*given)
    heat.slave.reset()
    assert np.array_equal(heat.start(x=0.02).run(*given), first)


def test_before_the_first_step_the_block_stands_where_the_host_has_put_it(heat):
    """x of the initialisation is where it moves from, not what comes in the first step."""
    heat.start(x=0.5)
    heat.put(x=0.5 + 0.15 * H, surface_speed=0.15, heat_flow=0.0)
    heat.slave.doStep(0.0, H)
    state = heat.outputs()
    np.testing.assert_allclose(state[:4], -8.0, atol=1e-12)
    heat.put(x=0.5 + 0.15 * H, heat_flow=1.0)
    heat.slave.doStep(H, H)
    # the belt runs on by 1.5 mm: what was heated is at the exit, not an eighth behind it
    assert heat.outputs()[0] > -8.0 + 1e-3


# --- refusals ---


def refusal(heat, call, *arguments):
    with pytest.raises(FMICallException) as caught:
        call(*arguments)
    assert caught.value.status == fmi2Error
    return heat.log.take_errors()


def test_what_cannot_be_is_refused_with_a_reason(unit, tmp_path):
    cases = [
        ({"heat": -1.0}, "has fallen by 1 J"), ({"surface_speed": 2e5}, "1000 loops"),
        ({"heat_flow": 1e12}, "many times over"), ({"heat_flow": 1e308}, "many times over"),
        ({"heat": 1e12}, "many times over"),
    ]  # fmt: skip
    for k, (values, reason) in enumerate(cases):
        with instance(unit, tmp_path / str(k)) as heat:
            heat.start()
            state = heat.slave.getFMUState()
            heat.put(**values)
            assert reason in refusal(heat, heat.slave.doStep, 0.0, H)
            heat.slave.setFMUState(state)
            heat.put(heat_flow=0.1, surface_speed=0.1)
            heat.slave.doStep(0.0, H)


def test_a_heat_flow_below_zero_is_refused_but_for_rounding(heat):
    heat.start()
    heat.put(heat_flow=-1e-8)
    heat.slave.doStep(0.0, H)
    assert heat.outputs()[7] == 0.0
    with pytest.raises(FMICallException):
        heat.put(heat_flow=-1.0)
        heat.slave.doStep(H, H)  # the setter of pythonfmu's library cannot refuse
    assert "heat_flow = -1: must lie in [0, inf]" in heat.log.take_errors()


def test_parameters_that_contradict_each_other_are_refused(whole, tmp_path):
    with instance(whole, tmp_path / "unit") as heat:
        with pytest.raises(FMICallException, match="fmi2ExitInitializationMode") as caught:
            heat.start(belt__length=0.07)
        assert caught.value.status == fmi2Error
        said = heat.log.take_errors()
        assert "is shorter than the contact" in said and "\n" not in said


def test_the_whole_model_s_unit_says_in_a_line_what_its_host_lacks(whole, tmp_path):
    """A Python that has pythonfmu and not the heat model."""
    with zipfile.ZipFile(whole) as archive:
        door = next(
            archive.read(name).decode()
            for name in archive.namelist()
            if name.startswith("resources/beltice_thermal_")
        )
    program = f"import sys; sys.modules['thermal'] = None; exec({door!r}, {{}})"
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert "needs the package `stickslip` in the host's Python" in done.stderr.splitlines()[-1]
