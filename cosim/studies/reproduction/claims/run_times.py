"""C12: what updating the spring angles costs, as a ratio measured here."""

from __future__ import annotations

import statistics
import time
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from stickslip import simulate
from stickslip.reference.interpreted_scheme import interpreted_run
from stickslip.reference.scheme_errors import PRINTED

from cosim.studies.reproduction.cases import STUDY as PRINTED_TIMES

from ..cases import DATASET_1, exact_parameters, scheme
from ..claim import Check, Claim, Row

# one stick and one slip, then the next ones begin: what a script needs grows with the slips
DURATION = 0.7
WHOLE = 20.0
STUDY = (5 * 60 / 30, 8 * 60 / 20)  # the least and the most that its minutes allow
CYCLES = 40  # the runs that the study compares


def seconds(call: Callable[[], object], repeats: int) -> float:
    """Median time of a call."""
    taken = []
    for _ in range(repeats):
        start = time.perf_counter()
        call()
        taken.append(time.perf_counter() - start)
    return statistics.median(taken)


@dataclass(frozen=True)
class Times:
    """Seconds of a run with updated angles and with angle zero; the exact model has one.

    python, numpy: script with strips in either, over `DURATION`; compiled, exact: over `WHOLE`.
    """

    python: tuple[float, float]
    numpy: tuple[float, float]
    compiled: tuple[float, float]
    exact: float

    @property
    def per_run(self) -> float:
        """Of the script with strips in Python over `WHOLE`, updated, s."""
        return self.python[0] / DURATION * WHOLE


def _measured() -> Times:
    script = partial(interpreted_run, DURATION)

    def both(repeats: int, together: bool) -> tuple[float, float]:
        updated, zero = (
            seconds(partial(script, treatment=kind, together=together), repeats)
            for kind in ("updated", "zero")
        )
        return updated, zero

    python, numpy = both(1, False), both(3, True)
    updated, zero = (scheme(DATASET_1, PRINTED, treatment=kind) for kind in ("updated", "zero"))
    compiled = [seconds(partial(one.run, duration=WHOLE), 5) for one in (updated, zero)]
    parameters = exact_parameters(DATASET_1)
    exact = seconds(partial(simulate, parameters, WHOLE), 5)
    return Times(python, numpy, (compiled[0], compiled[1]), exact)


def judge() -> Claim:
    """Script with strips in Python, script with strips in numpy, compiled scheme, exact model."""
    times = _measured()
    ratio = times.python[0] / times.python[1]
    others = {
        "strips in numpy": times.numpy[0] / times.numpy[1],
        "compiled": times.compiled[0] / times.compiled[1],
    }
    return Claim(
        "C12",
        "updating the spring angles takes 5 to 8 min, other treatments 20 to 30 s",
        _rows(times),
        (
            Check(
                "`updated` takes 10 to 24 times as long as the others",
                None,
                None,
                None,
            ),
        ),
        remarks=(
            "Machine, library and number of samples are not printed, and a time of today's machine "
            f"is no figure of theirs: the ratio is {ratio:.1f} with strips in Python, "
            + ", ".join(f"{value:.1f} with {name}" for name, value in others.items())
            + " on this one, and differs from run to run.",
            "The cost is not the stiffness matrix: `updated` samples friction a hundred times in "
            "every 10 ms, a fixed matrix a hundred times in a second. Compiled, the exact model "
            f"takes {1e3 * times.exact:.0f} ms for {WHOLE:.0f} s here.",
        ),
        place="§4.3.2, §4.3.3",
        rests="how the study's script samples friction; machine and library are not printed",
        leading=2,
        assumed=("a fixed matrix is solved once a slip, over 2 s at 100 samples a second",),
    )


def _rows(times: Times) -> tuple[Row, ...]:
    """The times, and their ratios."""
    return (
        Row(
            f"run time of {CYCLES} cycles, updated, strips in Python",
            "min",
            PRINTED_TIMES["minutes_updated"],
            CYCLES * times.python[0] / 60.0,
            digits=3,
        ),
        Row(
            f"run time of {CYCLES} cycles, zero, strips in Python",
            "s",
            PRINTED_TIMES["seconds_others"],
            CYCLES * times.python[1],
            digits=3,
        ),
        Row(
            "run time, updated / zero, strips in Python",
            "1",
            None,
            times.python[0] / times.python[1],
            derived=f"{STUDY[0]:.0f} to {STUDY[1]:.0f}",
            how="5 min/30 s to 8 min/20 s",
        ),
        Row(
            "run time, updated / zero, strips in numpy", "1", None, times.numpy[0] / times.numpy[1]
        ),
        Row(
            "run time, updated / zero, compiled",
            "1",
            None,
            None,
            times.compiled[0] / times.compiled[1],
        ),
        Row(
            "script (strips in Python) / compiled scheme, 20 s, updated",
            "1",
            None,
            None,
            times.per_run / times.compiled[0],
        ),
        Row(
            "script (strips in Python) / exact model, 20 s",
            "1",
            None,
            None,
            None,
            times.per_run / times.exact,
        ),
    )
