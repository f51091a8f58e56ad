"""What a connection does to a value: units converted by their definitions, and scaled."""

import pytest

from cosim import coupling
from cosim.coupling import Causality, Connection, CoupledSystem, CouplingError, UnitDefinition
from cosim.coupling.conversion import Affine, conversion, converted
from cosim.coupling.exchange import Exchange
from cosim.coupling.waveform import Waveform

TEMPERATURE = (0, 0, 0, 0, 1, 0, 0, 0)
ENERGY = (1, 2, -2, 0, 0, 0, 0, 0)
TURNING = (0, 0, -1, 0, 0, 0, 0, 1)
FREQUENCY = (0, 0, -1, 0, 0, 0, 0, 0)
NUMBER = (0,) * 8
UNITS = {
    "K": UnitDefinition(TEMPERATURE), "degC": UnitDefinition(TEMPERATURE, 1.0, 273.15),
    "degF": UnitDefinition(TEMPERATURE, 5.0 / 9.0, 273.15 - 160.0 / 9.0),
    "J": UnitDefinition(ENERGY), "kW.h": UnitDefinition(ENERGY, 3.6e6),
    "N.m": UnitDefinition(ENERGY), "rad/s": UnitDefinition(TURNING),
    "Hz": UnitDefinition(FREQUENCY), "%": UnitDefinition(NUMBER, 0.01), "1": UnitDefinition(NUMBER),
}  # fmt: skip


def port(unit, defined=True, causality=Causality.OUTPUT, name="p"):
    return coupling.Port(name, unit, causality, definition=UNITS.get(unit) if defined else None)


@pytest.mark.parametrize("source, sink, value, expected", [
    ("degC", "K", -8.0, 265.15),
    ("K", "degC", 265.15, -8.0),
    ("degF", "degC", 212.0, 100.0),
    ("degC", "degF", -40.0, -40.0),
    ("kW.h", "J", 2.0, 7.2e6),
    ("N.m", "J", 3.0, 3.0),
    ("%", "1", 95.0, 0.95),
    ("K", "K", 300.0, 300.0),
])  # fmt: skip
def test_units_of_one_dimension_are_converted(source, sink, value, expected):
    affine, remark = conversion(port(source), port(sink))
    assert not remark
    assert affine(value) == pytest.approx(expected, rel=1e-12, abs=1e-10)


@pytest.mark.parametrize("source, sink, message", [
    ("K", "J", r"K \(K\) does not fit J \(kg m\^2 s\^-2\)"),
    ("rad/s", "Hz", r"rad/s \(s\^-1 rad\) does not fit Hz \(s\^-1\)"),
    ("1", "K", r"no unit \(a plain number\) does not fit K"),
])  # fmt: skip
def test_units_of_two_dimensions_are_refused(source, sink, message):
    with pytest.raises(CouplingError, match=message):
        conversion(port(source), port(sink))


def test_one_spelling_for_two_units_is_refused():
    other = coupling.Port("p", "kW.h", Causality.INPUT, definition=UnitDefinition(ENERGY, 3600.0))
    with pytest.raises(CouplingError, match="both are in kW.h, which they define differently"):
        conversion(port("kW.h"), other)


def test_spellings_that_nobody_defines_must_be_the_same():
    assert conversion(port("N", False), port("N", False)) == (Affine(), "")
    with pytest.raises(CouplingError, match="degC does not fit K: the units must be the same, or"):
        conversion(port("degC", False), port("K"))


def test_a_side_without_a_unit_is_said():
    remark = "units not checked: the output states none, K is taken"
    assert conversion(port("1", False), port("K")) == (Affine(), remark)


def test_rounding_of_the_definitions_is_no_conversion():
    nearly = coupling.Port(
        "p", "rad/s2", Causality.INPUT, definition=UnitDefinition(TURNING, 1.0 + 1e-15)
    )
    assert conversion(port("rad/s"), nearly)[0].is_identity


class Part:
    def __init__(self, name, *ports):
        self.name = name
        self.ports = coupling.port_table(ports)
        self.got = {}

    def read(self):
        return {"t": -8.0}

    def write(self, values):
        self.got = dict(values)


SCALED = Affine(2.0, 1.0)


@pytest.mark.parametrize("options, expected, remarks", [
    ({}, 265.15, ()),
    ({"transformation": SCALED}, 2.0 * 265.15 + 1.0, ()),
    ({"transformation": SCALED, "converts": False}, -15.0,
     ("a.t -> b.u: units are not compared, as the system says",)),
])  # fmt: skip
def test_the_exchange_converts_then_transforms(options, expected, remarks):
    """In this order by the SSP standard, common content, LinearTransformation."""
    source = Part("a", port("degC", name="t"))
    sink = Part("b", port("K", name="u", causality=Causality.INPUT))
    system = CoupledSystem([source, sink], [Connection("a.t", "b.u", **options)])
    exchange = Exchange(system)
    exchange.collect("a")
    exchange.deliver("b")
    assert sink.got["u"] == pytest.approx(expected) and system.remarks == remarks


def test_of_a_waveform_only_the_value_is_shifted():
    wave = converted(Affine(2.0, 10.0), Waveform((1.0, 3.0, 5.0), 0.5))
    assert wave.coefficients == (12.0, 6.0, 10.0)


def test_joules_without_a_receipt_are_left_out_of_the_ledger_when_asked_for():
    parts = [
        Part("a", port("J", name="t")),
        Part("b", port("J", name="u", causality=Causality.INPUT)),
    ]
    with pytest.raises(CouplingError, match="carries energy"):
        CoupledSystem(parts, [Connection("a.t", "b.u")])
    assert CoupledSystem(parts, [Connection("a.t", "b.u")], receipts=False).remarks == ()
