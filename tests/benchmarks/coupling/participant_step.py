"""What a macro step of a unit costs beside its own work: in fmpy, as a participant, isolated.

Inputs written, a step, outputs of three types read; the unit is a page of C. The median of several
runs, in microseconds.

    python tests/benchmarks participant_step
"""

from __future__ import annotations

import statistics
import tempfile
import time
from pathlib import Path

import fmpy
from baseline import Figure, arguments, write
from c_units import made
from fmpy.fmi2 import FMU2Slave

from cosim.coupling import FmuParticipant, IsolatedParticipant

STEPS, STEP, RUNS = 2000, 1e-3, 9


def median(run):
    """us of a step."""
    found = []
    for _ in range(RUNS):
        began = time.perf_counter()
        for n in range(STEPS):
            run(n * STEP)
        found.append(1e6 * (time.perf_counter() - began) / STEPS)
    return statistics.median(found)


def in_fmpy(path, folder):
    description = fmpy.read_model_description(path)
    slave = FMU2Slave(
        guid=description.guid, unzipDirectory=fmpy.extract(path, folder), modelIdentifier="faulty"
    )
    slave.instantiate()
    slave.setupExperiment()
    slave.enterInitializationMode()
    slave.exitInitializationMode()

    def step(now):
        slave.setReal([0], [1.0])
        slave.doStep(now, STEP)
        slave.getReal([3])
        slave.getInteger([4])
        slave.getBoolean([5])

    found = median(step)
    slave.freeInstance()
    return found


def as_participant(unit, again=False):
    """again: every step is taken back and repeated."""

    def step(now):
        unit.write({"u": 1.0})
        unit.step(now, STEP)
        unit.read()

    def twice(now):
        state = unit.get_state()
        step(now)
        unit.set_state(state)
        step(now)
        unit.free_state(state)

    with unit:
        unit.enter_initialisation(0.0, 1e3)
        unit.exit_initialisation()
        return median(twice if again else step)


def main():
    told = arguments(__doc__).parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        path = made("faulty", Path(scratch))
        us = {
            "in fmpy": in_fmpy(path, Path(scratch) / "unit"),
            "as a participant": as_participant(FmuParticipant(path)),
            "as a participant, repeated": as_participant(FmuParticipant(path), again=True),
            "isolated": as_participant(IsolatedParticipant(FmuParticipant, path)),
            "isolated, repeated": as_participant(IsolatedParticipant(FmuParticipant, path), True),
        }
    figures = {f"macro step of a unit, {name}": Figure(value, "us") for name, value in us.items()}
    for name, figure in figures.items():
        print(f"{name:55s} {figure.value:8.1f} us")
    write(told.json, "participant_step", figures)


if __name__ == "__main__":
    main()
