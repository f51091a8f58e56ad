"""What a macro step costs beside the units' own work: this master and others, on one pair of units.

    python tests/benchmarks master_overhead [--json FILE] [--steps 100000] [--cofmupy PYTHON]

Two small native units, coupled both ways (`oscillator.c` of the helpers), 1e5 steps of 0.1 ms. What
the master adds is measured against a loop written by hand of the very calls of fmpy that the scheme
makes. All are seconds of the processor, which other work on the machine does not lengthen; median
of several rounds in which all take turns. Beside it the largest error of x over 1 s in steps of
10 ms, which the masters come to by their own schemes. `--cofmupy` names an interpreter that has
CoFMPy; masters that are not there are left out.
"""

import json
import statistics
import subprocess
import sys
import tempfile
import time
from ctypes import c_double, c_int, c_uint
from functools import partial
from pathlib import Path

from baseline import Figure, arguments, write
from foreign_tools import ecos_environment

HERE = Path(__file__).resolve().parent

from masters.host import COARSE, SHORT  # noqa: E402
from masters.pair import NAMES, build, coupled, largest_error  # noqa: E402

from cosim.coupling import GaussSeidel, Iterated, Jacobi, Tolerance, run  # noqa: E402

STEP, ROUNDS = 1e-4, 3
#: Name -> scheme; of the explicit ones it is measured what the master adds.
OURS = {
    "Gauss-Seidel, held": GaussSeidel(NAMES), "Gauss-Seidel, linear": GaussSeidel(NAMES, "linear"),
    "Jacobi, held": Jacobi(NAMES), "iterated, linear": Iterated(NAMES, tolerance=Tolerance(1e-9)),
}  # fmt: skip
TOOLS = ("fmpy", "libcosimpy", "ecospy")
COFMUPY = ("cofmupy", "cofmupy_jacobi", "cofmupy_iterated")


def ours_us(units, scheme, steps):
    """us of a macro step."""
    with coupled(units) as system:
        began = time.process_time()
        result = run(system, scheme, stop=steps * STEP, macro_step=STEP)
        seconds = time.process_time() - began
    assert result.status == "complete" and result.steps == steps, result.reason
    return 1e6 * seconds / steps


def error_of(units, scheme):
    with coupled(units) as system:
        result = run(system, scheme, stop=SHORT * COARSE, macro_step=COARSE)
    return largest_error(result.time, result["first.x"], result["second.x"])


class ByHand:
    """Instances of fmpy of a pair that is initialised, with memory for its calls."""

    def __init__(self, system):
        self.units = tuple(system.participants.values())
        for unit in self.units:
            unit.enter_initialisation(0.0, 1.0)
        for unit, other in zip(self.units, reversed(self.units), strict=True):
            unit.write({"other": other.read()["x"]})
        for unit in self.units:
            unit.exit_initialisation()
        self.fmus = tuple(unit._calls._fmu for unit in self.units)
        self.u, self.x, self.first = (c_uint * 1)(0), (c_uint * 1)(1), (c_int * 1)(1)
        self.value, self.slope = (c_double * 1)(), (c_double * 1)()

    def in_turn(self, steps, slopes=False):
        """The calls of Gauss-Seidel: set, step, get of each; with slopes of the inputs, or not."""
        u, x, value, first, slope = self.u, self.x, self.value, self.first, self.slope
        (a, b), (c, d) = self.fmus, (fmu.component for fmu in self.fmus)
        b.fmi2GetReal(d, x, 1, value)
        for n in range(steps):
            for fmu, component in ((a, c), (b, d)):
                fmu.fmi2SetReal(component, u, 1, value)
                if slopes:
                    fmu.fmi2SetRealInputDerivatives(component, u, 1, first, slope)
                fmu.fmi2DoStep(component, n * STEP, STEP, 1)
                fmu.fmi2GetReal(component, x, 1, value)

    def jacobi(self, steps):
        """Outputs are read again when the inputs of the step's end are known."""
        u, x, value = self.u, self.x, self.value
        (a, b), (c, d) = self.fmus, (fmu.component for fmu in self.fmus)
        b.fmi2GetReal(d, x, 1, value)
        for n in range(steps):
            a.fmi2SetReal(c, u, 1, value)
            a.fmi2DoStep(c, n * STEP, STEP, 1)
            b.fmi2SetReal(d, u, 1, value)
            b.fmi2DoStep(d, n * STEP, STEP, 1)
            for fmu, component in ((a, c), (b, d)):
                fmu.fmi2GetReal(component, x, 1, value)
            for fmu, component in ((a, c), (b, d)):
                fmu.fmi2SetReal(component, u, 1, value)
                fmu.fmi2GetReal(component, x, 1, value)


BY_HAND = {
    "Gauss-Seidel, held": ByHand.in_turn,
    "Gauss-Seidel, linear": partial(ByHand.in_turn, slopes=True),
    "Jacobi, held": ByHand.jacobi,
}


def by_hand_us(units, loop, steps):
    with coupled(units) as system:
        pair = ByHand(system)
        began = time.process_time()
        loop(pair, steps)
        return 1e6 * (time.process_time() - began) / steps


def other(tool, folder, steps, python=sys.executable):
    """What host.py prints of a tool; None where it is not there."""
    command = [python, HERE / "masters" / "host.py", tool, folder, STEP, steps]
    own = {} if python == sys.executable else {"PYTHONPATH": ""}
    with tempfile.TemporaryDirectory() as scratch:
        done = subprocess.run(
            list(map(str, command)), cwd=scratch, capture_output=True, text=True,
            env=ecos_environment() | own,
        )  # fmt: skip
    lines = [line for line in done.stdout.splitlines() if line.startswith("found ")]
    if not lines:
        print(f"{tool}: {(done.stderr.strip().splitlines() or ['no answer'])[-1]}")
        return None
    return json.loads(lines[-1].removeprefix("found "))


def end_error(found):
    """Of values after each step."""
    time_of = [COARSE * (n + 1) for n in range(SHORT)]
    return largest_error(time_of, found["first"], found["second"])


def measured(units, folder, steps, cofmupy):
    """Name -> us of a step in every round; name -> error."""
    us, errors = {}, {}
    tools = [(tool, sys.executable) for tool in TOOLS]
    tools += [(tool, cofmupy) for tool in COFMUPY if cofmupy]
    gone = set()
    for _ in range(ROUNDS):
        for name, loop in BY_HAND.items():
            us.setdefault(f"by hand, {name}", []).append(by_hand_us(units, loop, steps))
        for name, scheme in OURS.items():
            # an iterated step is several
            count = steps // 5 if scheme.needs_restore else steps
            us.setdefault(f"this master, {name}", []).append(ours_us(units, scheme, count))
        for tool, python in tools:
            found = None if tool in gone else other(tool, folder, steps, python)
            if found is None:
                gone.add(tool)
                continue
            us.setdefault(tool, []).append(found["us"])
            errors[tool] = end_error(found)
    errors |= {f"this master, {name}": error_of(units, scheme) for name, scheme in OURS.items()}
    return {name: statistics.median(values) for name, values in us.items()}, errors


def main():
    parser = arguments(__doc__)
    parser.add_argument("--steps", type=int, default=100_000)
    parser.add_argument("--cofmupy", metavar="PYTHON")
    told = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        us, errors = measured(build(folder), folder, told.steps, told.cofmupy)
    figures = {f"step, {name}": Figure(value, "us") for name, value in us.items()}
    for name in BY_HAND:
        added = us[f"this master, {name}"] - us[f"by hand, {name}"]
        figures[f"beyond fmpy's calls, {name}"] = Figure(added, "us")
    figures |= {f"error, {name}": Figure(value, "m") for name, value in errors.items()}
    print("| master | µs a step | largest error of x, 10 ms |")
    print("|---|---|---|")
    for name, value in us.items():
        error = f"{errors[name]:.4g} m" if name in errors else ""
        print(f"| {name} | {value:.1f} | {error} |")
    for name in BY_HAND:
        print(f"{name}: {figures[f'beyond fmpy{chr(39)}s calls, {name}'].value:.1f} µs added")
    write(told.json, "master_overhead", figures)


if __name__ == "__main__":
    main()
