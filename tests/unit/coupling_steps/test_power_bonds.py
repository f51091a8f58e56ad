"""What is taken for a power bond, by what the units of its ports are made of."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from linear_participant import Linear

from cosim import coupling
from cosim.coupling import Connection, CoupledSystem, CouplingError, UnitDefinition, run

#: Exponents of kg, m, s, A, K, mol, cd, rad; factor; offset.
UNITS = {
    "N": UnitDefinition((1, 1, -2, 0, 0, 0, 0, 0)),
    "kN": UnitDefinition((1, 1, -2, 0, 0, 0, 0, 0), 1000.0),
    "m": UnitDefinition((0, 1, 0, 0, 0, 0, 0, 0)),
    "m/s": UnitDefinition((0, 1, -1, 0, 0, 0, 0, 0)),
    "mm/s": UnitDefinition((0, 1, -1, 0, 0, 0, 0, 0), 1e-3),
    "N.m": UnitDefinition((1, 2, -2, 0, 0, 0, 0, 0)),
    "rad/s": UnitDefinition((0, 0, -1, 0, 0, 0, 0, 1)),
    "W/K": UnitDefinition((1, 2, -3, 0, -1, 0, 0, 0)),
    "K": UnitDefinition((0, 0, 0, 0, 1, 0, 0, 0)),
    "degC": UnitDefinition((0, 0, 0, 0, 1, 0, 0, 0), 1.0, 273.15),
}


def pair(effort, flow, factor=1.0):
    """A spring that gives an effort and a mass that gives a flow, in some units."""

    def defined(linear):
        ports = [replace(p, definition=UNITS.get(p.unit)) for p in linear.ports.values()]
        linear.ports = coupling.port_table(ports)
        return linear

    return CoupledSystem(
        [
            defined(Linear(
                "spring", [[0.0]], [[1.0]], [[1.0 / factor]],
                ins={"v": flow}, outs={"F": effort}, x=[1.0],
            )),
            defined(Linear(
                "mass", [[0.0]], [[-factor]], [[1.0]],
                ins={"F": effort}, outs={"v": flow}, x=[0.0],
            )),
        ],
        [Connection("spring.F", "mass.F"), Connection("mass.v", "spring.v")],
    )  # fmt: skip


BOND = coupling.PowerBond("spring.F", "mass.v")


@pytest.mark.parametrize(
    "effort, flow, watts",
    [("N", "m/s", 1.0), ("kN", "mm/s", 1.0), ("kN", "m/s", 1000.0), ("N.m", "rad/s", 1.0),
     ("W/K", "K", 1.0)],
)  # fmt: skip
def test_a_product_in_watts_is_a_bond_whatever_its_factors(effort, flow, watts):
    system = pair(effort, flow)
    assert BOND.watts(system) == (pytest.approx(watts, rel=1e-15), "")


@pytest.mark.parametrize("effort, flow, said", [
    ("N", "m", r"spring.F with mass.v: N times m \(kg m\^2 s\^-2\) is no power"),
    ("m/s", "m/s", r"m/s times m/s \(m\^2 s\^-2\) is no power, allowed are two outputs"),
    ("W/K", "degC", r"W/K times degC \(kg m\^2 s\^-3\) is no power"),
])  # fmt: skip
def test_what_is_no_power_is_refused_by_name_before_the_first_step(effort, flow, said):
    control = coupling.AdaptiveStep(coupling.EnergyResidual([BOND]), 0.01, 1e-4, 0.1)
    with pytest.raises(CouplingError, match=said):
        run(pair(effort, flow), coupling.Jacobi(("spring", "mass")), stop=1.0, control=control)


def test_a_bond_is_between_two_that_feed_each_other():
    system = pair("N", "m/s")
    lonely = CoupledSystem(list(system.participants.values()), system.connections[:1])
    with pytest.raises(CouplingError, match="mass.v does not feed spring, allowed are outputs"):
        BOND.watts(lonely)
    nothing = Connection("mass.v", "spring.v", transformation=coupling.Affine(0.0))
    cut = CoupledSystem(list(system.participants.values()), [system.connections[0], nothing])
    with pytest.raises(CouplingError, match=r"mass.v -> spring.v has the factor 0"):
        BOND.watts(cut)


def test_both_ends_of_a_bond_are_as_the_source_counts():
    """A force that is turned round and halved on its way, a velocity that is given from another."""
    links = [
        Connection("spring.F", "mass.F", transformation=coupling.Affine(-0.5)),
        Connection("mass.v", "spring.v", transformation=coupling.Affine(2.0, 3.0)),
    ]
    system = CoupledSystem(list(pair("N", "m/s").participants.values()), links)
    outputs = {"spring": {"F": 4.0}, "mass": {"v": 5.0}}
    inputs = {"mass": {"F": -0.5 * 6.0}, "spring": {"v": 2.0 * 7.0 + 3.0}}
    exchange = SimpleNamespace(system=system, outputs=outputs, inputs=inputs)
    assert BOND.values(exchange) == (4.0, 6.0, 5.0, 7.0)


def test_units_that_nobody_defines_are_told():
    control = coupling.AdaptiveStep(coupling.EnergyResidual([BOND]), 0.01, 1e-4, 0.1)
    order = coupling.Jacobi(("spring", "mass"))
    result = run(pair("lbf", "ft/s"), order, stop=0.1, control=control)
    (remark,) = result.remarks
    assert "whether lbf times ft/s is a power is not checked: not defined" in remark


def test_what_is_allowed_is_in_joules_whatever_the_units():
    """A force in N, and the same in kN: the same rig, the same steps."""
    steps = []
    for effort, factor in (("N", 1.0), ("kN", 1000.0)):
        estimate = coupling.EnergyResidual([BOND], relative=1e-12, absolute=1e-3)
        control = coupling.AdaptiveStep(estimate, 0.01, 1e-6, 1.0)
        system = pair(effort, "m/s", factor)
        order = coupling.Jacobi(("spring", "mass"))
        steps.append(run(system, order, stop=1.0, control=control).time)
    np.testing.assert_allclose(steps[0], steps[1], rtol=1e-6)  # rounding of the factors
