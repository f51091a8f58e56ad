"""The FMU under a master beside the model alone: the same motion, whatever the macro step."""

import random

import numpy as np
import pytest
from effect_cases import any_rig, creeping, falling, sheared
from stickslip import Parameters, simulate

from cosim.coupling import CoupledSystem, FmuParticipant, GaussSeidel, run

CASES = {
    "reference": {},
    "slab": {"rig": {"surface": "slab", "slab_radius": 0.4}, "lateral_friction": {"ratio": 1.0}},
    "one degree of freedom": {"rig": {"degrees_of_freedom": ["x"], "inertia": "ring"}},
    "no springs": {"springs": {"stiffness": 0.0}},
    "backwards": {"surface": {"speed": -0.15}},
    "at rest, stiff": {"springs": {"stiffness": 9999.0}, "surface": {"speed": 0.0}},
    "friction by a table": {
        "friction": {"table_speed": [0.0, 0.02, 0.1, 0.4], "table_mu": [0.26, 0.2, 0.16, 0.24]},
        "lateral_friction": {"ratio": 1.0},
        "initial": {"vx": 0.15, "y": 0.002},
    },
    "not as drawn": {
        "lateral_friction": {"ratio": 1.0},
        "rig": {"spring_natural_length": 0.17},
        "imperfections": {"seed": 5, "mass": 0.01, "spring_stiffness": 0.02}
        | {"anchor_position": 1e-3, "start_position": 1e-3, "start_angle_deg": 1.0},
    },
}
RIGS = {name: Parameters.model_validate(tables) for name, tables in CASES.items()} | {
    contact.__name__: any_rig(contact, random.Random(contact.__name__))
    for contact in (creeping, falling, sheared)
}
TIMES = ("x", "y", "phi", "heat", "sliding_distance", "surface_travel")


def in_fmu(fmu, parameters, stop, macro_step, record_every=1):
    inputs = {
        "surface_speed": parameters.surface.speed,
        "interface_temperature": parameters.temperature_dependence.reference_degC,
    }
    block = FmuParticipant(fmu, "block", parameters=parameters.flat(), inputs=inputs)
    with CoupledSystem([block], []) as system:
        result = run(
            system, GaussSeidel(("block",)), stop=stop, macro_step=macro_step,
            record_every=record_every,
        )  # fmt: skip
    assert result.status == "complete", result.reason
    return result


@pytest.mark.parametrize("rig", RIGS)
@pytest.mark.parametrize("macro_step", [0.01, 0.25])
def test_the_fmu_moves_as_the_model_alone(fmu, rig, macro_step):
    parameters = RIGS[rig]
    alone = simulate(parameters, duration=5.0, output_interval=macro_step)
    coupled = in_fmu(fmu, parameters, 5.0, macro_step)
    for name in TIMES:
        np.testing.assert_allclose(coupled[f"block.{name}"], alone[name], rtol=1e-9, atol=1e-8)
    for name in ("mode", "slip_count"):
        np.testing.assert_array_equal(coupled[f"block.{name}"], alone[name])
