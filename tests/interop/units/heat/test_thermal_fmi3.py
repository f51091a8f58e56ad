"""BeltIceThermal for FMI 3.0: the library of FMI 2.0, told where its matrices are by a path."""

import pytest

from cosim.coupling.fmu.errors import FmuCallError
from cosim.coupling.fmu.participant import FmuParticipant


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
