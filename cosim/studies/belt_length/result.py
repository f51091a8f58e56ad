"""What the study found: rows so far, as tables and as JSON."""

from dataclasses import asdict, dataclass, field
from importlib import import_module
from typing import Any

import pandas as pd
from stickslip.packaged import packaged_tables

from cosim.report.files import plain_data
from cosim.report.page import PageResult

from .case import Case
from .drift import CAMERA, Drift, FrictionEffect, Rises, Wait
from .lengths import DriftMap, Levels, shortest_in_doubt
from .required_length import Answer
from .uncertainty import Uncertainty

#: Column of the table -> place in a case's JSON.
_TABLE = packaged_tables(__package__, "columns.toml")
_COLUMNS, PRINTED = _TABLE["columns"], _TABLE["printed"]
#: Of a case, what JSON has elsewhere, or not at all.
_NOT_TOLD = ("rig", "protocol", "ranges", "drawn")


@dataclass(frozen=True)
class Row:
    """A case and what it comes to.

    shortest_run, shortest_steady: belt on which the drift stays below the limit at the end of the
    runs and for ever, m; shortest_interface: belt on which the interface's rise at constant speed
    does; None where no belt does. uncertainty: None where it was not asked for, or the ice melts.
    """

    case: Case
    drift: Drift
    effect: FrictionEffect
    shortest_run: float | None
    shortest_steady: float | None
    shortest_interface: float | None
    wait: Wait
    changes: tuple[Rises, ...]
    uncertainty: Uncertainty | None

    def as_dict(self, limit: float) -> dict[str, object]:
        """Everything, for JSON, with the two questions about a belt and their answers."""
        d, u, thermal = self.drift, self.uncertainty, self.case.thermal()
        case = {name: value for name, value in vars(self.case).items() if name not in _NOT_TOLD}
        layered = bool(thermal.belt.layers)
        used = {
            "conductivity": None if layered else thermal.belt.conductivity,
            "thickness": None if layered else thermal.belt.thickness,
            "conductance": thermal.contact.conductance,
            "h": self.case.film,
            "h_of_still_air": self.case.h is None,
            "frost": self.case.frost and self.case.frost._asdict(),
        }
        questions = {
            "comes_round_cold": {
                "answer": d.run <= limit,
                "rise": d.run,
                "rise_in_doubt": u and [u.low, u.median, u.high],
                "shortest_belt": self.shortest_run,
            },
            "interface_steady": {
                "answer": d.interface_drift <= limit,
                "rise_at_constant_speed": d.interface_drift,
                "rise_in_doubt": u and [u.interface_low, u.interface_median, u.interface_high],
                "rise": d.interface_run,
                "endless_belt": d.interface_drift_endless,
                "shortest_belt": self.shortest_interface,
            },
        }
        told = {"case": case | used, "questions": questions, "seen_by_camera": d.run > CAMERA}
        return vars(self) | told


@dataclass(frozen=True)
class Options:
    """limit K; sensitivity of friction 1/K (None: linear to melting); samples: runs of the model
    for the uncertainty, 0 for none."""

    limit: float
    sensitivity: float | None = None
    samples: int = 128


@dataclass
class Study(PageResult):
    """Rows so far; `complete` when none is missing.

    answers: of an own rig, one for each drive; scenario: its TOML, "" of the source study's rig;
    grid: the map over length and speed, None where it was not asked for.

    >>> from cosim.studies.belt_length import Case, Options, Study, work_off
    >>> study = Study(Options(0.1, samples=0))
    >>> work_off(study, [Case(1.0, 0.82)], 1, lambda count: None)
    >>> study.summary()["cases"][0]["questions"]["comes_round_cold"]["answer"]
    False
    >>> study.save("results/belt").name
    'belt'
    """

    SHOWN_BY = f"{__package__}.show"

    options: Options
    rows: list[Row] = field(default_factory=list)
    complete: bool = False
    answers: list[Answer] = field(default_factory=list)
    scenario: str = field(default="", repr=False)
    grid: DriftMap | None = field(default=None, repr=False)

    def summary(self) -> dict[str, Any]:
        """What `belt_length.json` holds."""
        shared: dict[str, object] = {}
        if self.rows:
            shared["protocol"] = asdict(self.rows[0].case.protocol)
            shared["rig"] = _shared([row.case.thermal().model_dump() for row in self.rows])
        numbers = {
            "complete": self.complete,
            "limit": self.options.limit,
            **shared,
            "answers": [one.as_dict() for one in self.answers],
            "cases": self._cases(),
            "verdict": import_module(self.SHOWN_BY).verdict(self),
        }
        # where a stopped map did not come is null
        return dict(plain_data(numbers | ({"map": self.grid} if self.grid is not None else {})))

    def table(self) -> pd.DataFrame:
        """One row a case; NaN where nothing is known."""
        table = pd.json_normalize(self._cases())
        return table.reindex(columns=list(_COLUMNS.values())).set_axis(list(_COLUMNS), axis=1)

    def _cases(self) -> list[dict[str, object]]:
        limit, doubted = self.options.limit, self.shortest_in_doubt()
        each = ((row.as_dict(limit), doubted[row.case.drive]) for row in self.rows)
        return [plain_data(told | {"shortest_in_doubt": levels}) for told, levels in each]

    def shortest_in_doubt(self) -> dict[Case, Levels]:
        """By rise and level, for each choice of everything but the length, which is 1 m there."""
        if self.answers:
            return {one.case.drive: one.shortest_in_doubt() for one in self.answers}
        drives: dict[Case, dict[float, Uncertainty | None]] = {}
        for row in self.rows:
            drives.setdefault(row.case.drive, {})[row.case.length] = row.uncertainty
        limit = self.options.limit
        return {case: shortest_in_doubt(doubts, limit) for case, doubts in drives.items()}

    def changes(self) -> pd.DataFrame:
        """One row a case and change: what would help."""
        return pd.DataFrame(
            [_place(row.case) | vars(one) for row in self.rows for one in row.changes]
        )

    def doubt(self) -> pd.DataFrame:
        """One row a case and unknown: single changes beside Sobol indices."""
        known = [(row.case, row.uncertainty) for row in self.rows if row.uncertainty is not None]
        return pd.DataFrame([_place(case) | one for case, found in known for one in found.table()])

    @property
    def material(self) -> str:
        """What the block is of."""
        cases = [*(row.case for row in self.rows), *(answer.case for answer in self.answers)]
        return cases[0].rig.ice.material if cases else "ice"

    @property
    def worst(self) -> Row:
        """The case that drifts most."""
        return max(self.rows, key=lambda row: row.drift.run)

    @property
    def most_doubted(self) -> Row | None:
        """The same among those with a doubt."""
        known = [row for row in self.rows if row.uncertainty is not None]
        return max(known, key=lambda row: row.drift.run, default=None)


def _place(case: Case) -> dict[str, object]:
    return {
        "length [m]": case.length,
        "speed [m/s]": case.speed,
        "ambient [degC]": case.ambient_degC,
    }


def _shared(rigs: list[dict[str, Any]]) -> dict[str, object]:
    """What was used in all cases; None where that differs, and each case has its own."""
    found: dict[str, object] = {}
    for key, value in rigs[0].items():
        values = [rig[key] for rig in rigs]
        same = value if values.count(value) == len(values) else None
        found[key] = _shared(values) if isinstance(value, dict) else same
    return found
