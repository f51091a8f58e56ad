"""All cases of the study, worked off in processes; what is stopped keeps what it had."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import asdict, dataclass, field, fields, replace
from functools import lru_cache
from itertools import product

import pandas as pd
from joblib import Parallel, delayed

from thermal.air import moving_belt

from .case import Case
from .drift import Drift, drift, run_drift, steady_drift
from .friction_effect import FrictionEffect, friction_effect
from .shortest import shortest_belt
from .uncertainty import Uncertainty, uncertainty

Progress = Callable[[int], None]


@dataclass(frozen=True)
class Row:
    """A case and what it comes to.

    shortest_run, shortest_steady: belt on which the drift stays below the limit after 20 s and
    for ever, m; None where no belt does.
    """

    case: Case
    drift: Drift
    effect: FrictionEffect
    shortest_run: float | None
    shortest_steady: float | None
    uncertainty: Uncertainty | None

    def flat(self) -> dict[str, object]:
        """One row of the table: columns named by what they hold, with units."""
        d, e, u = self.drift, self.effect, self.uncertainty
        return {
            **{COLUMNS[one.name]: getattr(self.case, one.name) for one in fields(Case)},
            "study [K]": d.study, "single pass mended [K]": d.single_pass,
            "drift 20 s [K]": d.run, "drift 30 s [K]": d.long_run, "drift steady [K]": d.steady,
            "drift 20 s low [K]": u and u.low, "drift 20 s high [K]": u and u.high,
            "ice 20 s [K]": d.ice_run, "ice 30 s [K]": d.ice_long_run,
            "ice steady [K]": d.ice_steady,
            "interface 20 s [K]": d.interface_run, "flash 20 s [K]": d.flash_run,
            "belt share 20 s": d.belt_share, "belt share steady": d.belt_share_steady,
            "seen by camera": d.seen_by_camera, "steady melts": d.steady_melts,
            "mu change 20 s": e.mu_change, "drift 20 s, weaker friction [K]": e.drift,
            "frequency [Hz]": e.frequency,
            "frequency change 20 s": e.frequency_change,
            "shortest belt 20 s [m]": self.shortest_run,
            "shortest belt steady [m]": self.shortest_steady,
        }


#: Field of a case -> column of the table.
COLUMNS = {
    "length": "length [m]", "speed": "speed [m/s]", "mass": "mass [kg]", "h": "h [W/m2K]",
    "conductivity": "conductivity [W/mK]", "friction": "friction", "ambient_degC": "ambient [degC]",
    "conductance": "conductance [W/m2K]", "thickness": "thickness [m]",
}


@dataclass(frozen=True)
class Options:
    """limit K; sensitivity of friction 1/K (None: linear to melting); samples: of the Sobol
    sequence, a power of two, 0 for none."""

    limit: float
    sensitivity: float | None = None
    samples: int = 32


@dataclass
class Study:
    """Rows so far; `complete` when none is missing."""

    options: Options
    rows: list[Row] = field(default_factory=list)
    complete: bool = False

    def table(self) -> pd.DataFrame:
        """One row a case."""
        return pd.DataFrame([row.flat() for row in self.rows])

    def as_dict(self) -> dict[str, object]:
        """Everything, for JSON."""
        return {
            "complete": self.complete, "limit": self.options.limit,
            "cases": [asdict(row) | {"seen_by_camera": row.drift.seen_by_camera}
                      for row in self.rows],
        }


#: In place of a number for h: that of a belt moving through still air.
AIR = "air"


def cases(**choices: Iterable[float | str]) -> list[Case]:
    """Every combination; the lengths of one belt drive lie side by side.

    h may be AIR: each case then has that of its speed and of half its loop, and keeps it where
    other lengths are tried.
    """
    names = [name for name in choices if name != "length"] + ["length"]
    return [_case(dict(zip(names, values, strict=True)))
            for values in product(*(choices[name] for name in names))]


def _case(choice: dict[str, float | str]) -> Case:
    if choice.get("h") != AIR:
        return Case(**choice)
    case = Case(**(choice | {"h": 1.0}))
    case.thermal()
    return replace(case, h=moving_belt(case.speed, 0.5 * case.length, case.ambient_degC))


def _row(case: Case, options: Options) -> Row:
    return Row(
        case, drift(case), friction_effect(case, options.sensitivity),
        *_shortest(case.with_length(1.0), options.limit),
        uncertainty(case, options.samples) if options.samples else None)


@lru_cache(maxsize=64)
def _shortest(case: Case, limit: float) -> tuple[float | None, float | None]:
    """For a run and for ever; the same for cases that differ in their length alone."""
    return shortest_belt(case, limit, run_drift), shortest_belt(case, limit, steady_drift)


def work_off(study: Study, wanted: list[Case], jobs: int, progress: Progress) -> None:
    """Fill the study's rows, in order; whatever interrupts it, the rows until then stay."""
    for row in _in_processes(wanted, study.options, jobs):
        study.rows.append(row)
        progress(1)
    study.complete = True


def _in_processes(wanted: list[Case], options: Options, jobs: int) -> Iterator[Row]:
    if jobs == 1:
        yield from (_row(case, options) for case in wanted)
        return
    yield from Parallel(n_jobs=jobs, return_as="generator")(
        delayed(_row)(case, options) for case in wanted)
