"""Cost of a communication step: the native unit, the Python unit, and a unit of others.

    python tests/benchmarks fmu_step [--peer FILE.fmu] [--json FILE]

Steps of 1 ms of the reference case in a host written in C and through fmpy, beside a bouncing ball;
then the reference case as a coupled run, with the time that the master spends in the mechanical
unit. All in one run, median of several; steps in time of the processor. Needs a C compiler.

The ball is one of our own, the least that a unit can be, as there is none to be had by pip. With
`--peer` it is any unit for FMI 2.0 co-simulation that gives and takes states, such as BouncingBall
of https://github.com/modelica/Reference-FMUs, which steps by 1 ms inside, too:

    cmake -B out -D FMI_VERSION=2 -D CMAKE_BUILD_TYPE=Release Reference-FMUs
    cmake --build out --target BouncingBall
    python tests/benchmarks fmu_step --peer out/fmus/BouncingBall.fmu
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import NamedTuple

from baseline import Figure, arguments, write
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave
from stickslip.generation.platforms import this_platform

from cosim.coupling import FmuParticipant
from cosim.coupling.case import run_scenario
from cosim.fmu.build import PYTHON, build_fmu
from cosim.fmu.native import native_folder
from cosim.scenario import read_scenario

HERE = Path(__file__).resolve().parent

from c_library import compiler  # noqa: E402

STEP, STEPS, PYTHON_STEPS, REPEATS = 1e-3, 20_000, 2_000, 5
HOST_STEPS = 200_000  # a step of the ball takes 30 ns there
DURATION = 5.0  # s, of the coupled run


def median(measure):
    """Median of several measurements."""
    return statistics.median(measure() for _ in range(REPEATS))


def compiled(source, made, *options):
    headers = f"-I{native_folder() / 'headers'}"
    subprocess.run([*compiler(), "-O2", headers, *options, source, "-o", made], check=True)
    return made


class Unit(NamedTuple):
    """A unit as it is unpacked."""

    folder: Path
    guid: str
    identifier: str
    shown: int  # value reference of an output, which the host reads at the end

    @classmethod
    def unpacked(cls, fmu, folder):
        """From a file."""
        try:
            description = read_model_description(fmu)
        except Exception as error:  # of many kinds: a file, its zip, its XML, its model
            sys.exit(f"{fmu}: is not a unit: {error}")
        if description.fmiVersion != "2.0" or description.coSimulation is None:
            sys.exit(f"{fmu}: is not a unit for FMI 2.0 co-simulation")
        real = (each.variable for each in description.outputs if each.variable.type == "Real")
        return cls(
            Path(extract(fmu, unzipdir=folder / fmu.stem)),
            description.guid,
            description.coSimulation.modelIdentifier,
            next(real).valueReference,
        )

    @property
    def library(self):
        platform = this_platform()
        return self.folder / "binaries" / platform.fmi2 / f"{self.identifier}{platform.suffix}"


def our_ball(folder):
    """The least that a unit can be."""
    unit = Unit(folder / "ball", "ball", "ball", 0)
    unit.library.parent.mkdir(parents=True)
    compiled(HERE / "ball.c", unit.library, "-fPIC", "-shared")
    return unit


def host_us(host, unit):
    """us of a step in the host in C; two instances, since one alone prints after every step."""
    command = [host, unit.library, unit.guid, HOST_STEPS, STEP, unit.shown, 2, 1]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)
    return float(done.stderr.split()[0])


def fmpy_us(unit, steps):
    """us of a step through fmpy."""
    block = FMU2Slave(
        guid=unit.guid, unzipDirectory=str(unit.folder), modelIdentifier=unit.identifier
    )
    block.instantiate()
    block.setupExperiment()
    block.enterInitializationMode()
    block.exitInitializationMode()
    began = time.process_time()
    for n in range(steps):
        block.doStep(n * STEP, STEP)
    each = 1e6 * (time.process_time() - began) / steps
    block.terminate()
    block.freeInstance()
    return each


class Clock:
    """Seconds in the calls of every participant that is an FMU, while it is a context."""

    CALLS = ("write", "read", "step")

    def __enter__(self):
        self.seconds = 0.0
        self.before = {name: getattr(FmuParticipant, name) for name in self.CALLS}
        for name, method in self.before.items():
            setattr(FmuParticipant, name, self.timed(method))
        return self

    def __exit__(self, *_):
        for name, method in self.before.items():
            setattr(FmuParticipant, name, method)

    def timed(self, method):
        def call(*given):
            began = time.perf_counter()
            try:
                return method(*given)
            finally:
                self.seconds += time.perf_counter() - began

        return call


def coupled_seconds(fmu):
    """Seconds of the reference case's start: of the whole loop, and in the mechanics."""
    scenario = read_scenario("reference").changed({"run.duration": DURATION})
    with Clock() as clock:
        result = run_scenario(scenario, fmu=fmu).result
    return result.wall_time, clock.seconds


def peer_of(told, folder):
    """Name and unit of the peer."""
    if told.peer is None:
        return "our ball", our_ball(folder)
    return told.peer.stem, Unit.unpacked(told.peer, folder)


def main():
    parser = arguments(__doc__)
    parser.add_argument("--peer", type=Path, metavar="FILE.fmu", help="in place of our ball")
    told = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        native, python = build_fmu(folder), build_fmu(folder, PYTHON)
        ours, slow = (Unit.unpacked(fmu, folder) for fmu in (native, python))
        name, peer = peer_of(told, folder)
        source = HERE.parents[1] / "interop" / "units" / "c_host" / "host.c"
        host = compiled(source, folder / "host", "-ldl", "-lpthread")
        us = {
            "native unit in a C host": median(lambda: host_us(host, ours)),
            f"{name} in a C host": median(lambda: host_us(host, peer)),
            "native unit in fmpy": median(lambda: fmpy_us(ours, STEPS)),
            f"{name} in fmpy": median(lambda: fmpy_us(peer, STEPS)),
            "Python unit in fmpy": median(lambda: fmpy_us(slow, PYTHON_STEPS)),
        }
        runs = {
            kind: coupled_seconds(fmu) for kind, fmu in [("native", native), ("Python", python)]
        }
    figures = {f"step of 1 ms, {name}": Figure(value, "us") for name, value in us.items()}
    in_fmpy = us["native unit in fmpy"]
    figures["Python / native in fmpy"] = Figure(us["Python unit in fmpy"] / in_fmpy, better="more")
    for host in ("a C host", "fmpy"):
        ratio = us[f"native unit in {host}"] / us[f"{name} in {host}"]
        figures[f"native / {name} in {host}"] = Figure(ratio)
    for kind, (wall, mechanics) in runs.items():
        figures[f"coupled run, {kind} unit"] = Figure(wall, "s")
        figures[f"coupled run, in the {kind} unit"] = Figure(mechanics, "s")
    less = runs["Python"][1] / runs["native"][1]
    figures["coupled run, mechanics, Python / native"] = Figure(less, better="more")
    for label, figure in figures.items():
        print(f"{label:45s} {figure.value:10.3f} {figure.unit if figure.unit != '1' else ''}")
    write(told.json, "fmu_step", figures)


if __name__ == "__main__":
    main()
