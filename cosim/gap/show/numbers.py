"""The answer as data: what `gap.json` holds."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

from cosim.gap.quantities import undetermined
from cosim.gap.result import NINETY, Gap, Law, Ranked
from cosim.gap.scatter import is_determined
from cosim.gap.windows import Fitted
from cosim.report.files import json_text

#: Significant digits of every number: more than any fit to noisy data knows, fewer than what the
#: order of a sum may change.
DIGITS = 6
#: What is written as it stands in an answer.
AS_IT_IS = (
    "verdict", "effects", "sentence", "classes", "where", "share", "ladder", "next_experiment",
    "exponents", "rig", "rates", "doubts", "rejected",
)  # fmt: skip


def as_json(gap: Gap, model: str) -> str:
    """JSON text without NaN; the same answer gives the same bytes. model: name of its file."""
    return json_text(as_data(gap, model))


def as_data(gap: Gap, model: str) -> dict[str, Any]:
    """A tree of plain values; a number that there is not is None."""
    campaign, estimated = gap.campaign, gap.campaign.noise_estimated
    data: dict[str, Any] = {"campaign": campaign.name}
    data |= {name: getattr(gap, name) for name in AS_IT_IS}
    data |= {
        "gap": {"before": gap.before, "after": gap.after},
        "ranking": [ranked(row) for row in gap.ranking],
        "curves": [_curve(law) for law in gap.laws],
        "scatter": gap.scatter
        and {
            **dict(zip(("value", "low", "high"), gap.scatter, strict=True)),
            "determined": is_determined(gap.scatter),
        },
        "model": model,
        "remarks": gap.campaign.remarks,
        "noise": {
            channel: {"value": value, "estimated": channel in estimated}
            for channel, value in campaign.noise.items()
        },
        "plain": _fitted(gap.plain),
        "extended": _fitted(gap.extended) | {"undetermined": sorted(undetermined(gap))},
    }
    return dict(tree(data))


def ranked(row: Ranked) -> dict[str, Any]:
    """A row of the ranking."""
    names = ("effect", "form", "probability", "parameters", "intervals", "undetermined")
    return {name: getattr(row, name) for name in names} | {
        "held_out_gap": row.gap and row.gap.held_out,
        "fit_gap": row.gap and row.gap.fit,
        "delta_bic": 2.0 * row.evidence,
    }


def _curve(law: Law) -> dict[str, Any]:
    names = ("effect", "unit", "per", "mean", "form", "law", "in_model")
    return {name: getattr(law, name) for name in names} | {
        "axis": law.quantity,
        "values": law.at,
        "low": law.mean - NINETY * law.sd,
        "high": law.mean + NINETY * law.sd,
        "points": [
            {"run": run, "at": at, "value": value, "sd": sd}
            for run, (at, value, sd) in zip(law.run, law.points, strict=True)
        ],
    }


def _fitted(fitted: Fitted) -> dict[str, Any]:
    runs = [{"name": run.name, "hold_out": run.hold_out, "gap": run.gap} for run in fitted.runs]
    known = {"parameters": fitted.values, "sd": fitted.sd, "at_bound": fitted.at_bound}
    return known | {"runs": runs}


def tree(value: Any) -> Any:
    """Numbers of so many digits, lists for sequences, tables for mappings and data classes."""
    text = json.dumps(value, default=_plain)
    return json.loads(text, parse_float=_rounded, parse_constant=lambda _: None)


def _plain(value: Any) -> Any:
    """What JSON has no word for."""
    if is_dataclass(value) and not isinstance(value, type):
        return asdict(value)
    return dict(value) if isinstance(value, Mapping) else value.tolist()


def _rounded(text: str) -> float:
    return float(f"{float(text):.{DIGITS}g}")
