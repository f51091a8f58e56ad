"""BeltIceThermal for FMI 3.0: the library of FMI 2.0, told where its matrices are by a path."""

import fmpy
import numpy as np
import pytest
from heat_instance import OUTPUTS

from cosim.coupling.fmu.errors import FmuCallError
from cosim.coupling.fmu.participant import FmuParticipant


def test_it_is_for_co_simulation(native3):
    description = fmpy.read_model_description(native3)
    assert not description.coSimulation.hasEventMode
    outputs = [each.name for each in description.modelVariables if each.causality == "output"]
    assert tuple(outputs) == OUTPUTS


def test_it_computes_what_the_one_for_fmi_2_does_to_the_last_bit(native, native3):
    times = np.arange(0.0, 2.0, 0.01)
    drive = np.array(
        [(t, 0.2 + 0.1 * np.sin(5 * t), 0.15) for t in times],
        dtype=[("time", float), ("heat_flow", float), ("surface_speed", float)],
    )
    given = {"input": drive, "stop_time": 2.0, "output_interval": 0.01, "output": [*OUTPUTS]}
    old, new = (fmpy.simulate_fmu(str(fmu), **given) for fmu in (native, native3))
    assert old.tobytes() == new.tobytes() and np.ptp(new["heat_stored"]) > 0.1


def test_a_state_goes_on_and_a_question_without_an_answer_is_one(native3):
    with FmuParticipant(native3, inputs={"surface_speed": 0.15, "heat_flow": 0.3}) as unit:
        unit.enter_initialisation(0.0, 1.0)
        unit.exit_initialisation()
        unit.step(0.0, 0.1)
        saved = unit.save_state()
        unit.step(0.1, 0.1)
        ahead = unit.read()
        unit.load_state(saved)
        unit.step(0.1, 0.1)
        assert unit.read() == ahead
        with pytest.raises(FmuCallError, match="surface_speed is a real number, not an integer"):
            unit._call(unit._instance()._fmu.getInt32, [1])
        unit.step(0.2, 0.1)
