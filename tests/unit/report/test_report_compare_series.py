"""Two results of which one names, samples or measures its series otherwise than the other."""

import numpy as np
import pytest
import xarray as xr

from cosim.report.compare import OneResult, compare
from cosim.report.compare.compare import apart, matched
from cosim.report.compare.figures import has_phases, moving
from cosim.report.compare.page import page

METRE, KELVIN = "m", "K"


def series(time, **columns):
    """A dataset over time; a column is (values, unit) or (values, unit, further attributes)."""
    made = {
        name.replace("__", "."): ("time", values, {"units": unit, **(more[0] if more else {})})
        for name, (values, unit, *more) in columns.items()
    }
    return xr.Dataset(made, coords={"time": time})


def defined(base, factor, offset=0.0):
    """What a unit's FMU says its unit is made of."""
    return {
        "causality": "output", "base_units": base, "si_factor": factor, "si_offset": offset,
    }  # fmt: skip


def result(label, dataset, case="system", scenario="", **numbers):
    told = {"case": case, "time_reached": float(dataset["time"][-1]), **numbers}
    return OneResult(label, label, dataset, told, scenario)


TIME = np.linspace(0.0, 2.0, 201)
PLACE = 0.01 * np.sin(3.0 * TIME)
RUN = series(
    TIME, x=(PLACE, "m"), interface_temperature=(-8.0 + 0.01 * TIME, "degC"), heat=(TIME, "J"),
)  # fmt: skip
SYSTEM = series(
    TIME[::2],
    block__x=(1e3 * PLACE[::2], "mm", defined(METRE, 1e-3)),
    heat__interface_temperature=(265.15 + 0.01 * TIME[::2], "K", defined(KELVIN, 1.0)),
    block__heat=(TIME[::2], "s", defined("s", 1.0)),
)


def test_a_system_in_other_units_is_the_run_that_it_is():
    found, refused = matched(RUN, SYSTEM)
    assert [(one.name, one.other, one.unit) for one in found] == [
        ("x", "block.x", "m"),
        ("interface_temperature", "heat.interface_temperature", "degC"),
    ]
    assert refused == ["heat is in J, block.heat in s: not compared"]
    both = compare(result("run", RUN, "coupled", "name = 'a'"), result("system", SYSTEM))
    assert both.keys == {} and not both.curves
    # half of the rows: the lowest and highest of x are of other rows, ends are of the same
    assert {one.name for one in both.different} <= {"outputs.x.lowest", "outputs.x.highest"}
    assert [drawn.channel.name for drawn in moving(both)] == ["x", "heat", "interface_temperature"]
    said = " ".join(both.remarks)
    assert "one is of a coupled run, the other of any system" in said
    assert "0.01 s apart, the other's 0.02 s" in said and "not compared" in said
    text = page(both)[0]
    assert "the other is a system of units" in text and "What only" not in text


@pytest.mark.parametrize("turn", [1, -1])
def test_what_is_apart_is_measured_where_both_are(turn):
    """A shift of 1 mm up to 1 s, whichever has it, and nothing of what comes later."""
    shifted = series(TIME[:101:2], x=(PLACE[:101:2] + 1e-3, "m"))
    a, b = (RUN, shifted)[::turn]
    (one,), _ = matched(a, b)
    found = apart(one, a, b)
    assert (found.largest, found.rms) == pytest.approx((turn * 1e-3, 1e-3), rel=1e-9)
    assert 0.0 <= found.at <= 1.0
    # over 1 s the sine goes from 0 to its top and down to sin 3
    assert found.span == pytest.approx(0.01, rel=1e-3) if turn == 1 else found.span > 0.0


def test_two_systems_are_compared_by_what_they_are_made_of():
    participants = {"block": {"file": "a.fmu", "substeps": 1, "set": {"mass": 1.0}}}
    other = {"block": {"file": "a.fmu", "substeps": 2, "set": {"mass": 2.0}}}
    dataset = series(TIME, block__x=(PLACE, "mm", defined(METRE, 1e-3)))
    noisy = series(TIME, block__x=(PLACE + 1e-15, "mm", defined(METRE, 1e-3)))
    both = compare(
        result("one", dataset, participants=participants, coupling={"scheme": "jacobi"}),
        result("two", noisy, participants=other, coupling={"scheme": "iterated"}),
    )
    assert both.keys == {
        "coupling.scheme": ("jacobi", "iterated"),
        "units.block.substeps": (1, 2),
        "units.block.mass": (1.0, 2.0),
    }
    assert not both.different and not both.curves and not both.remarks
    assert "What differs in the systems" in page(both)[0]


def test_ports_that_two_units_have_are_not_guessed():
    twice = series(TIME, left__x=(PLACE, "m"), right__x=(PLACE, "m"))
    found, _ = matched(RUN, twice)
    assert not found
    both = compare(result("run", RUN, "coupled", "name = 'a'"), result("two", twice))
    assert not has_phases(both) and both.numbers


def test_a_temperature_in_celsius_is_no_part_of_another():
    warm = series(TIME, interface_temperature=(-8.0 + 0.02 * TIME, "degC"))
    both = compare(result("a", RUN), result("b", warm))
    (end,) = [one for one in both.different if one.name.endswith("temperature.end")]
    assert end.relative is None and end.difference == pytest.approx(0.02)
    assert "20 mK" in page(both)[0]
