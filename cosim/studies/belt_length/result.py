"""What the study found: rows so far, as tables and as JSON."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, field, fields

import pandas as pd

from .case import Case
from .changes import Change, FrictionEffect
from .drift import Drift, Wait
from .lengths import Length, shortest_in_doubt
from .required_length import Answer
from .uncertainty import Uncertainty

#: Field of a case -> column of the table.
COLUMNS = {
    "length": "length [m]",
    "speed": "speed [m/s]",
    "mass": "mass [kg]",
    "conductivity": "conductivity [W/mK]",
    "friction": "friction",
    "ambient_degC": "ambient [degC]",
    "conductance": "conductance [W/m2K]",
    "thickness": "thickness [m]",
}


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
    changes: tuple[Change, ...]
    uncertainty: Uncertainty | None

    @property
    def used(self) -> dict[str, float | None]:
        """The numbers of the case, those of the rig where the case has none of its own."""
        thermal, layered = self.case.thermal(), bool(self.case.rig.belt.layers)
        own = {
            "conductivity": None if layered else thermal.belt.conductivity,
            "thickness": None if layered else thermal.belt.thickness,
            "conductance": thermal.contact.conductance,
        }
        return {name: own.get(name, getattr(self.case, name)) for name in COLUMNS}

    def flat(self) -> dict[str, object]:
        """One row of the table: columns named by what they hold, with units."""
        d, e, u = self.drift, self.effect, self.uncertainty
        return {
            **{column: self.used[name] for name, column in COLUMNS.items()},
            "h [W/m2K]": self.case.film,
            "study [K]": d.study,
            "single pass mended [K]": d.single_pass,
            "drift [K]": d.run,
            "drift low [K]": u and u.low,
            "drift high [K]": u and u.high,
            "drift steady [K]": d.steady,
            "interface drift [K]": d.interface_drift,
            "interface drift low [K]": u and u.interface_low,
            "interface drift high [K]": u and u.interface_high,
            "interface [K]": d.interface_run,
            "interface drift, endless belt [K]": d.interface_drift_endless,
            "ice [K]": d.ice_run,
            "ice steady [K]": d.ice_steady,
            "flash [K]": d.flash_run,
            "belt share": d.belt_share,
            "belt share steady": d.belt_share_steady,
            "seen by camera": d.seen_by_camera,
            "steady melts": d.steady_melts,
            "mu change": e.mu_change,
            "drift, weaker friction [K]": e.drift,
            "frequency [Hz]": e.frequency,
            "frequency change": e.frequency_change,
            "shortest belt [m]": self.shortest_run,
            "shortest belt steady [m]": self.shortest_steady,
            "shortest belt interface [m]": self.shortest_interface,
            "wait [s]": self.wait.begin,
            "wait drift [s]": self.wait.drift,
        }

    def questions(self, limit: float) -> dict[str, dict[str, object]]:
        """The two questions about a belt, with their answers."""
        d, u = self.drift, self.uncertainty
        return {
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

    def as_dict(self, limit: float) -> dict[str, object]:
        """Everything, for JSON."""
        case = {
            one.name: getattr(self.case, one.name)
            for one in fields(Case)
            if one.name not in ("rig", "protocol", "ranges", "drawn")
        }
        h = {
            "h": self.case.film,
            "h_of_still_air": self.case.h is None,
            "frost": self.case.frost and self.case.frost._asdict(),
        }
        rest = {
            name: value and asdict(value)
            for name, value in (
                ("drift", self.drift),
                ("effect", self.effect),
                ("wait", self.wait),
                ("uncertainty", self.uncertainty),
            )
        }
        return {
            "case": case | self.used | h,
            "questions": self.questions(limit),
            **rest,
            "shortest_run": self.shortest_run,
            "shortest_steady": self.shortest_steady,
            "shortest_interface": self.shortest_interface,
            "changes": [asdict(one) for one in self.changes],
            "seen_by_camera": self.drift.seen_by_camera,
        }


@dataclass(frozen=True)
class Options:
    """limit K; sensitivity of friction 1/K (None: linear to melting); samples: runs of the model
    for the uncertainty, 0 for none."""

    limit: float
    sensitivity: float | None = None
    samples: int = 128


@dataclass
class Study:
    """Rows so far; `complete` when none is missing. answers: of an own rig, one for each drive."""

    options: Options
    rows: list[Row] = field(default_factory=list)
    complete: bool = False
    answers: list[Answer] = field(default_factory=list)

    def table(self) -> pd.DataFrame:
        """One row a case."""
        doubted = self.shortest_in_doubt()
        return pd.DataFrame(
            [
                row.flat()
                | {
                    f"{name}, {level} [m]": found[rise][key].length
                    for rise, name in (
                        ("run", "shortest belt"),
                        ("interface", "shortest belt interface"),
                    )
                    for key, level in (("median", "median"), ("high", "95 %"))
                }
                for row in self.rows
                for found in (doubted[row.case.with_length(1.0)],)
            ]
        )

    def shortest_in_doubt(self) -> dict[Case, dict[str, dict[str, Length]]]:
        """By rise and level, for each choice of everything but the length, which is 1 m there."""
        if self.answers:
            return {one.case.with_length(1.0): _of_answer(one) for one in self.answers}
        by_belt: dict[Case, dict[float, Row]] = {}
        for row in self.rows:
            by_belt.setdefault(row.case.with_length(1.0), {})[row.case.length] = row
        return {
            case: shortest_in_doubt(
                sorted(rows),
                [rows[length].uncertainty for length in sorted(rows)],
                self.options.limit,
            )
            for case, rows in by_belt.items()
        }

    def changes(self) -> pd.DataFrame:
        """One row a case and change: what would help."""
        return self._each(lambda row: [asdict(one) for one in row.changes])

    def doubt(self) -> pd.DataFrame:
        """One row a case and unknown: single changes beside Sobol indices."""
        return self._each(lambda row: [] if row.uncertainty is None else row.uncertainty.table())

    def _each(self, of: Callable[[Row], list[dict]]) -> pd.DataFrame:
        return pd.DataFrame(
            [
                {
                    "length [m]": row.case.length,
                    "speed [m/s]": row.case.speed,
                    "ambient [degC]": row.case.ambient_degC,
                }
                | one
                for row in self.rows
                for one in of(row)
            ]
        )

    @property
    def material(self) -> str:
        """What the block is of."""
        cases = [*(row.case for row in self.rows), *(answer.case for answer in self.answers)]
        return cases[0].rig.ice.material if cases else "ice"

    @property
    def worst(self) -> Row:
        """The case that drifts most."""
        return max(self.rows, key=lambda row: row.drift.run)

    def as_dict(self) -> dict[str, object]:
        """Everything, for JSON."""
        first = (
            {}
            if not self.rows
            else {
                "protocol": asdict(self.rows[0].case.protocol),
                "rig": _shared([row.case.thermal().model_dump() for row in self.rows]),
            }
        )
        doubted = self.shortest_in_doubt()
        return {
            "complete": self.complete,
            "limit": self.options.limit,
            **first,
            "answers": [one.as_dict() for one in self.answers],
            "cases": [
                row.as_dict(self.options.limit)
                | {
                    "shortest_in_doubt": {
                        rise: {level: asdict(one) for level, one in levels.items()}
                        for rise, levels in doubted[row.case.with_length(1.0)].items()
                    }
                }
                for row in self.rows
            ],
        }


def _of_answer(answer: Answer) -> dict[str, dict[str, Length]]:
    unknown = Length(None, "", answer.reason)
    return {
        rise: {level: getattr(question, level) or unknown for level in ("low", "median", "high")}
        for rise, question in (("run", answer.run), ("interface", answer.interface))
    }


def _shared(rigs: list[dict]) -> dict[str, object]:
    """What was used in all cases; None where that differs, and each case has its own."""
    return {
        key: _shared([rig[key] for rig in rigs])
        if isinstance(value, dict)
        else value
        if all(rig[key] == value for rig in rigs)
        else None
        for key, value in rigs[0].items()
    }
