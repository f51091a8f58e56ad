"""Error of the coupled case against what it costs, for every scheme and step control.

    python tests/benchmarks coupling_cost [--json FILE]

A block of 40 kg slides at 3 m/s on the belt at -20 degC, friction falls by 4.8 % a kelvin (ice on
rock: McCarthy et al., 2017), and the interface warms by 11 K in two seconds: heat acts back on the
motion strongly. A guide keeps the block on its line and a damper keeps it from sticking. That is
chosen: where a block sticks, the instants of break-away hang on the last digits of the temperature,
and an error is the distance of two events, which has no order in the macro step. The error is the
largest one at multiples of 0.192 s from 0.576 s on: the heat that sets in at 0 warms as the root
of the time, which no step follows. In fixed steps the belt travels whole cells; what adaptive steps
find of the temperature, by cubics between their rows, carries the ripple of cells that have passed
in part, some 10 mK: of theirs x tells more. Nothing melts here; melted mass is in the case with
pauses (tests/verification/coupled/test_belt_with_pauses.py).

The reference is the iterated scheme with straight inputs in steps of 4/3 ms. Quadratic inputs are
no better than straight ones: the unit takes first derivatives. Jacobi with straight inputs goes
astray at every step size here: heat that sets in at once is extrapolated to more than follows, and
cannot be taken back. Cost: steps made by the heat model, repeated ones included, and seconds of the
processor.
"""

import math
import time
from typing import NamedTuple

import numpy as np
from baseline import Figure, arguments, write
from heated_block import ON_A_LINE, ORDER, ROCK, coupled

from cosim import coupling, read_scenario
from cosim.coupling import GaussSeidel, Iterated, Jacobi, Tolerance

STOP, COMMON, FIRST = 1.92, 0.192, 0.576  # s
#: s; the belt travels whole cells of 4 mm in each, in the reference one.
STEPS = (0.064, 0.032, 0.016, 0.008, 0.004)
REFERENCE = 0.004 / 3.0
TOLERANCES = (1e-1, 1e-2, 1e-3)
#: Port -> unit of what is compared.
COMPARED = {"thermal.interface_temperature": "K", "mechanics.x": "m"}
TIGHT = Tolerance(1e-7)
FIXED = {
    "Jacobi, held": Jacobi(ORDER), "Jacobi, linear": Jacobi(ORDER, "linear"),
    "Gauss-Seidel, held": GaussSeidel(ORDER), "Gauss-Seidel, linear": GaussSeidel(ORDER, "linear"),
    "iterated, held, quasi-Newton": Iterated(ORDER, "held", tolerance=TIGHT),
    "iterated, linear, quasi-Newton": Iterated(ORDER, "linear", tolerance=TIGHT),
    "iterated, linear, Aitken": Iterated(ORDER, "linear", acceleration=coupling.Aitken(),
        tolerance=TIGHT),
    "iterated, quadratic, quasi-Newton": Iterated(ORDER, "quadratic", tolerance=TIGHT),
}  # fmt: skip
ADAPTIVE = {
    "Gauss-Seidel, linear, by defect": (GaussSeidel(ORDER, "linear"), coupling.Defect),
    "Gauss-Seidel, linear, by doubling": (GaussSeidel(ORDER, "linear"), coupling.Doubling),
    "iterated, linear, by doubling": (Iterated(ORDER, "linear", tolerance=TIGHT),
        coupling.Doubling),
}  # fmt: skip


class Run(NamedTuple):
    """Macro steps accepted, heat-model steps made, seconds, and port -> values at common times."""

    steps: int
    made: int
    seconds: float
    values: dict[str, np.ndarray]


def scenario():
    """Friction that feels the interface strongly, and a motion without events."""
    held = {
        "surface.run_up_time": 0.0, "structural_damping.coefficient": 200.0,
        "initial.x": 0.52 * 40.0 * 9.81 / 6000.0, "belt.length": 1.0,
    }  # fmt: skip
    return read_scenario("meltwater").changed(ROCK | ON_A_LINE | held)


def made(case, scheme, **how):
    """The case by a scheme; the reason, where it goes astray."""
    times = COMMON * np.arange(1, round(STOP / COMMON) + 1)
    began = time.process_time()
    result = coupled(case, scheme, stop=STOP, **how)
    seconds = time.process_time() - began
    if result.status != "complete":
        return result.reason
    late = times[times > FIRST - 1e-9]
    values = {port: course(result.time, result[port], late) for port in COMPARED}
    steps = result.statistics.participants["thermal"].steps
    return Run(result.steps, steps, seconds, values)


def course(times, values, wanted):
    """Values at wanted times (n,), by cubics through the four nearest rows where there is none."""
    found = []
    for at in wanted:
        low = min(max(int(np.searchsorted(times, at)) - 2, 0), len(times) - 4)
        t, v = times[low : low + 4] - at, values[low : low + 4]
        exact = np.abs(t) < 1e-9
        found.append(float(v[exact][0]) if exact.any() else float(np.polyfit(t, v, 3)[-1]))
    return np.array(found)


def errors(found, reference):
    """Port -> largest error."""
    return {
        port: float(np.abs(found.values[port] - reference.values[port]).max()) for port in COMPARED
    }


def table_of(case, reference):
    """Name -> (step or tolerance, run, errors) of each run."""
    table = {}
    for name, scheme in FIXED.items():
        for step in STEPS:
            found = made(case, scheme, macro_step=step)
            if isinstance(found, str):
                print(f"{name}, {step:g} s goes astray: {found}")
                continue
            table.setdefault(name, []).append((step, found, errors(found, reference)))
    for name, (scheme, estimate) in ADAPTIVE.items():
        for tolerance in TOLERANCES:
            control = coupling.AdaptiveStep(estimate(Tolerance(tolerance)), 0.01, 1e-4, COMMON)
            found = made(case, scheme, control=control)
            assert not isinstance(found, str), found
            table.setdefault(name, []).append((tolerance, found, errors(found, reference)))
    return table


def order_of(rows, port):
    """Slope of log error over log step, of the three finest steps."""
    steps, found = zip(*((step, off[port]) for step, _, off in rows[-3:]), strict=True)
    return float(np.polyfit(np.log(steps), np.log(found), 1)[0])


def main():
    told = arguments(__doc__).parse_args()
    case = scenario()
    reference = made(case, FIXED["iterated, linear, quasi-Newton"], macro_step=REFERENCE)
    assert not isinstance(reference, str), reference
    table = table_of(case, reference)
    figures = {}
    print("| scheme | step or tolerance | steps | made | seconds | T / K | x / m |")
    print("|---|---|---|---|---|---|---|")
    for name, rows in table.items():
        for chosen, found, off in rows:
            kelvin, metre = off.values()
            print(
                f"| {name} | {chosen:g} | {found.steps} | {found.made} | {found.seconds:.2f}"
                f" | {kelvin:.2e} | {metre:.2e} |"
            )
            figures[f"{name}, {chosen:g}: steps made"] = Figure(found.made)
            for (port, unit), value in zip(COMPARED.items(), off.values(), strict=True):
                figures[f"{name}, {chosen:g}: {port}"] = Figure(value, unit)
    for name in [name for name in FIXED if len(table.get(name, ())) >= 3]:
        orders = [order_of(table[name], port) for port in COMPARED]
        print(f"{name}: order {orders[0]:.2f} of the temperature, {orders[1]:.2f} of x")
        assert all(map(math.isfinite, orders))
    write(told.json, "coupling_cost", figures)


if __name__ == "__main__":
    main()
