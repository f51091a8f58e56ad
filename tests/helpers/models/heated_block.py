"""The block's unit and the heat model of a scenario, coupled by any scheme; friction of rock."""

from cosim.coupling import CoupledSystem, FmuParticipant, run
from cosim.coupling.case import CONNECTIONS, MECHANICS, RESIDUALS, THERMAL, ThermalParticipant
from cosim.fmu.build import own_fmu
from thermal import BeltIceModel

ORDER = (MECHANICS, THERMAL)
#: Part of friction that a kelvin takes: ice on rock, 0.52 at -20 degC, 0.02 at melting (McCarthy et
#: al., 2017).
LOSS = (1.0 - 0.02 / 0.52) / 20.0
#: Changes of the case `meltwater`: that friction, on one line, on a coarse mesh of the ice.
ROCK = {
    "mixed_lubrication.share": 0.0, "friction.mu_s": 0.52, "friction.mu_k": 0.52,
    "temperature_dependence.sensitivity": LOSS, "temperature_dependence.static_sensitivity": LOSS,
    "temperature_dependence.reference_degC": -20.0, "ambient.temperature_degC": -20.0,
}  # fmt: skip
ON_A_LINE = {
    "rig.degrees_of_freedom": ("x",), "initial.y": 0.0, "initial.phi": 0.0,
    "belt.cell_length": 4e-3, "ice.radial_elements": 3, "ice.axial_elements": 6,
}  # fmt: skip


def coupled(case, scheme, *others, links=(), **how):
    """A run of both; others: participants beside them, which by their links give the speed."""
    inputs = {} if links else {"surface_speed": case.surface.speed}
    block = FmuParticipant(own_fmu(), MECHANICS, parameters=case.mechanics.flat(), inputs=inputs)
    heat = ThermalParticipant(BeltIceModel(case.thermal), THERMAL)
    with CoupledSystem([*others, block, heat], [*CONNECTIONS, *links], RESIDUALS) as system:
        return run(system, scheme, **how)
