"""What a coupled system refuses, and in which words."""

import pytest

from cosim import coupling
from cosim.coupling import Connection, CoupledSystem, CouplingError, inputs, outputs


class Stub:
    def __init__(self, name, *ports):
        self.name = name
        self.ports = coupling.port_table(ports)


def stubs():
    mechanics = Stub("mechanics", *outputs(heat="J", x="m"), *inputs(temperature="degC"))
    thermal = Stub(
        "thermal", *inputs(heat="J", x="m"), *outputs(temperature="K", heat_received="J", y="m")
    )
    return [mechanics, thermal]


HEAT = Connection("mechanics.heat", "thermal.heat", taken="heat_received")


@pytest.mark.parametrize("connection, message", [
    (("mechanics.z", "thermal.x"), r"no port of mechanics is named 'z'"),
    (("mechanics.heatt", "thermal.x"), r"nearest: 'heat'"),
    (("mechanic.heat", "thermal.x"), r"no participant is named 'mechanic'; nearest: 'mech"),
    (("thermal.temperature", "mechanics.temperature"),
     r"thermal.temperature -> mechanics.temperature: K does not fit degC: the units must"),
    (("thermal.x", "thermal.x"), r"thermal.x is an input; a connection starts at an output"),
    (("mechanics.x", "thermal.y"), r"thermal.y is an output; a connection ends at an input"),
    (("mechanics.heat", "thermal.heat"), r"carries energy; name in taken="),
    (("mechanics.heat", "thermal.heat", "y"), r"thermal.y is an output in m; what the sink"),
    (("mechanics.heat", "thermal.heat", "received"), r"nearest: 'heat_received'"),
    (("mechanics.x", "thermal.x", "heat_received"), r"belongs to a connection in J"),
    (("thermal.y", "thermal.x"), r"not connected to itself"),
])  # fmt: skip
def test_a_connection_that_does_not_fit_is_refused(connection, message):
    with pytest.raises(CouplingError, match=message):
        CoupledSystem(stubs(), [Connection(*connection)])


def test_an_input_is_fed_once():
    mechanics, thermal = stubs()
    other = Stub("other", *outputs(x="m"))
    twice = [Connection("mechanics.x", "thermal.x"), Connection("other.x", "thermal.x")]
    with pytest.raises(CouplingError, match="thermal.x is fed twice: by mechanics.x and by other"):
        CoupledSystem([mechanics, thermal, other], twice)


@pytest.mark.parametrize("order, message", [
    (("mechanics",), "leaves out thermal"),
    (("mechanics", "thermal", "mechanics"), "names mechanics more than once"),
    (("mechanics", "termal"), "nearest: 'thermal'"),
])  # fmt: skip
def test_the_order_names_every_participant_once(order, message):
    system = CoupledSystem(stubs(), [HEAT])
    with pytest.raises(CouplingError, match=message):
        coupling.GaussSeidel(order).check(system)


def test_names_are_unique_and_without_dots():
    with pytest.raises(CouplingError, match="two participants are named 'a'"):
        CoupledSystem([Stub("a"), Stub("a")], [])
    with pytest.raises(CouplingError, match="hold no dot"):
        CoupledSystem([Stub("a.b")], [])
    with pytest.raises(ValueError, match="port 'x' is declared twice"):
        Stub("a", *outputs(x="m"), *inputs(x="m"))


def test_a_residual_is_an_output_in_joule():
    with pytest.raises(CouplingError, match="mechanics.x is an output in m; an energy residual"):
        CoupledSystem(stubs(), [HEAT], residuals=["mechanics.x"])
