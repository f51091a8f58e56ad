"""Cost of a communication step: the native unit, the Python unit, and the least that a unit can be.

    python tests/benchmarks/fmu_step.py [--json FILE]

Steps of 1 ms of the reference case in a host written in C and through fmpy, beside a bouncing ball;
then the reference case as a coupled run, with the time that the master spends in
the mechanical unit. All in one run, median of several; needs a C compiler.
"""

import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from baseline import Figure, arguments, write
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

from cosim.coupling import FmuParticipant
from cosim.coupling.case import run_scenario
from cosim.fmu.build import PYTHON, build_fmu
from cosim.fmu.native import native_folder
from cosim.scenario import read_scenario

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / "helpers")]

from c_library import compiler  # noqa: E402
from native_unit import library_of  # noqa: E402

STEP, STEPS, PYTHON_STEPS, REPEATS = 1e-3, 20_000, 2_000, 5
DURATION = 5.0  # s, of the coupled run


def median(measure):
    """Median of several measurements."""
    return statistics.median(measure() for _ in range(REPEATS))


def compiled(source, made, *options):
    headers = f"-I{native_folder() / 'headers'}"
    subprocess.run([*compiler(), "-O2", headers, *options, source, "-o", made], check=True)
    return made


def host_us(host, library, guid):
    """us of a step in the host in C; two instances, since one alone prints after every step."""
    command = [host, library, guid, STEPS, STEP, 6, 2, 1]
    done = subprocess.run(list(map(str, command)), capture_output=True, text=True, check=True)
    return float(done.stderr.split()[0])


def fmpy_us(folder, guid, identifier, steps):
    """us of a step through fmpy."""
    block = FMU2Slave(guid=guid, unzipDirectory=str(folder), modelIdentifier=identifier)
    block.instantiate()
    block.setupExperiment()
    block.enterInitializationMode()
    block.exitInitializationMode()
    began = time.perf_counter()
    for n in range(steps):
        block.doStep(n * STEP, STEP)
    each = 1e6 * (time.perf_counter() - began) / steps
    block.terminate()
    block.freeInstance()
    return each


def unit_us(fmu, folder, steps):
    """us of a step of a unit as a file, through fmpy."""
    description = read_model_description(fmu)
    unpacked = extract(fmu, unzipdir=folder / fmu.stem)
    identifier = description.coSimulation.modelIdentifier
    return median(lambda: fmpy_us(unpacked, description.guid, identifier, steps))


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


def main():
    told = arguments(__doc__).parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)
        native, python = build_fmu(folder), build_fmu(folder, PYTHON)
        ball_folder = folder / "ball" / "binaries" / "linux64"
        ball_folder.mkdir(parents=True)
        ball = compiled(HERE / "ball.c", ball_folder / "ball.so", "-fPIC", "-shared")
        source = HERE.parent / "interop" / "units" / "c_host" / "host.c"
        host = compiled(source, folder / "host", "-ldl", "-lpthread")
        guid = read_model_description(native).guid
        library = library_of(native, folder)
        us = {
            "native unit in a C host": median(lambda: host_us(host, library, guid)),
            "bouncing ball in a C host": median(lambda: host_us(host, ball, "ball")),
            "native unit in fmpy": unit_us(native, folder, STEPS),
            "bouncing ball in fmpy": median(
                lambda: fmpy_us(folder / "ball", "ball", "ball", STEPS)
            ),
            "Python unit in fmpy": unit_us(python, folder, PYTHON_STEPS),
        }
        runs = {
            name: coupled_seconds(fmu) for name, fmu in [("native", native), ("Python", python)]
        }
    figures = {f"step of 1 ms, {name}": Figure(value, "us") for name, value in us.items()}
    in_fmpy = us["native unit in fmpy"]
    figures["Python / native in fmpy"] = Figure(us["Python unit in fmpy"] / in_fmpy, better="more")
    figures["native / ball in fmpy"] = Figure(in_fmpy / us["bouncing ball in fmpy"])
    for name, (wall, mechanics) in runs.items():
        figures[f"coupled run, {name} unit"] = Figure(wall, "s")
        figures[f"coupled run, in the {name} unit"] = Figure(mechanics, "s")
    less = runs["Python"][1] / runs["native"][1]
    figures["coupled run, mechanics, Python / native"] = Figure(less, better="more")
    for name, figure in figures.items():
        print(f"{name:45s} {figure.value:10.3f} {figure.unit if figure.unit != '1' else ''}")
    write(told.json, "fmu_step", figures)


if __name__ == "__main__":
    main()
