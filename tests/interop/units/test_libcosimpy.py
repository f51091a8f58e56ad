"""The FMU in libcosim, beside fmpy: the same motion."""

import fmpy
import numpy as np
import pytest
from libcosimpy.CosimEnums import CosimExecutionState
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimManipulator import CosimManipulator
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

SPEED, STEP, COUNT = 0.15, 0.01, 500


def references(fmu):
    description = fmpy.read_model_description(fmu)
    return {v.name: v.valueReference for v in description.modelVariables}


def prepared():
    execution = CosimExecution.from_step_size(step_size=round(STEP * 1e9))
    manipulator, observer = CosimManipulator.create_override(), CosimObserver.create_last_value()
    execution.add_manipulator(manipulator=manipulator)
    execution.add_observer(observer=observer)
    return execution, manipulator, observer


def x_in_libcosim(fmu, instances=1):
    """x(t) of each instance, (instances, COUNT)."""
    where = references(fmu)
    execution, manipulator, observer = prepared()
    slaves = []
    for n in range(instances):
        slave = CosimLocalSlave(fmu_path=str(fmu), instance_name=f"block{n}")
        slaves.append(execution.add_local_slave(local_slave=slave))
        manipulator.slave_real_values(
            slave_index=slaves[-1],
            variable_references=[where["surface_speed"]],
            values=[SPEED * (n + 1)],
        )
    x = []
    for _ in range(COUNT):
        assert execution.step()
        x.append([observer.last_real_values(slave, [where["x"]])[0] for slave in slaves])
    assert execution.status().state != CosimExecutionState.ERROR.value
    return np.array(x).T


def x_in_fmpy(fmu, speed):
    result = fmpy.simulate_fmu(
        str(fmu),
        stop_time=COUNT * STEP,
        output_interval=STEP,
        start_values={"surface_speed": speed},
        output=["x"],
    )
    return result["x"][1:]


@pytest.mark.parametrize("instances", [1, 2])
def test_libcosim_and_fmpy_see_the_same_motion(fmu, instances):
    for n, x in enumerate(x_in_libcosim(fmu, instances)):
        np.testing.assert_allclose(x, x_in_fmpy(fmu, SPEED * (n + 1)), rtol=0, atol=1e-9)


def test_an_input_that_is_no_number_stops_libcosim_and_not_the_process(fmu):
    where = references(fmu)
    execution, manipulator, observer = prepared()
    block = execution.add_local_slave(
        local_slave=CosimLocalSlave(fmu_path=str(fmu), instance_name="block")
    )
    assert execution.step() and execution.step()
    manipulator.slave_real_values(
        slave_index=block, variable_references=[where["surface_speed"]], values=[float("nan")]
    )
    assert not execution.step()
    assert execution.status().state == CosimExecutionState.ERROR.value
    assert np.isfinite(observer.last_real_values(block, [where["x"]])[0])
