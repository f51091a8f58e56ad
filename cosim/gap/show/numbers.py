"""The answer as data: what `gap.json` holds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

import numpy as np

from cosim.gap.result import Gap, Law, Ranked
from cosim.gap.windows import Fitted
from cosim.report.files import json_text
from cosim.studies.reproduction.summary import SummaryGap

from .quantities import NINETY, undetermined

#: Significant digits of every number: more than any fit to noisy data knows, fewer than what the
#: order of a sum may change.
DIGITS = 6


def as_json(gap: Gap | SummaryGap, model: str) -> str:
    """JSON text without NaN; the same answer gives the same bytes. model: name of its file."""
    return json_text(as_data(gap, model))


def as_data(gap: Gap | SummaryGap, model: str) -> dict[str, Any]:
    """A tree of plain values; a number that there is not is None."""
    common = {
        "campaign": gap.campaign.name,
        "verdict": gap.verdict,
        "effects": gap.effects,
        "classes": gap.classes,
        "where": gap.where,
        "ranking": [_ranked(row) for row in gap.ranking],
        "next_experiment": gap.next_experiment,
        "model": model,
        "remarks": tuple(dict.fromkeys((*gap.campaign.remarks, *gap.remarks))),
    }
    own = _of_figures(gap) if isinstance(gap, SummaryGap) else _of_runs(gap)
    return _plain(common | own)


def _ranked(row: Ranked) -> dict[str, Any]:
    return {
        "effect": row.effect,
        "form": row.form,
        "held_out_gap": row.gap and row.gap.held_out,
        "fit_gap": row.gap and row.gap.fit,
        "delta_bic": 2.0 * row.evidence,
        "probability": row.probability,
        "parameters": row.parameters,
        "intervals": row.intervals,
        "undetermined": row.undetermined,
    }


def _of_runs(gap: Gap) -> dict[str, Any]:
    """What only runs with a time series have."""
    campaign = gap.campaign
    return {
        "sentence": gap.sentence,
        "share": gap.share,
        "gap": {"before": gap.before, "after": gap.after},
        "ladder": gap.ladder,
        "exponents": gap.exponents,
        "curves": [_curve(law) for law in gap.laws],
        "scatter": gap.scatter and dict(zip(("value", "low", "high"), gap.scatter, strict=True)),
        "rig": gap.rig,
        "rates": gap.rates,
        "doubts": gap.doubts,
        "lacks": gap.lacks,
        "noise": {
            channel: {"value": value, "estimated": channel in campaign.noise_estimated}
            for channel, value in campaign.noise.items()
        },
        "plain": _fitted(gap.plain),
        "extended": _fitted(gap.extended) | {"undetermined": sorted(undetermined(gap))},
    }


def _curve(law: Law) -> dict[str, Any]:
    band = NINETY * law.sd
    return {
        "effect": law.effect,
        "axis": law.quantity,
        "unit": law.unit,
        "per": law.per,
        "values": law.at,
        "mean": law.mean,
        "low": law.mean - band,
        "high": law.mean + band,
        "points": [
            {"run": run, "at": at, "value": value, "sd": sd}
            for run, (at, value, sd) in zip(law.run, law.points, strict=True)
        ],
        "form": law.form,
        "law": law.law,
        "in_model": law.in_model,
    }


def _fitted(fitted: Fitted) -> dict[str, Any]:
    return {
        "parameters": fitted.values,
        "sd": fitted.sd,
        "at_bound": fitted.at_bound,
        "runs": [
            {"name": run.name, "hold_out": run.hold_out, "gap": run.gap} for run in fitted.runs
        ],
    }


def _of_figures(gap: SummaryGap) -> dict[str, Any]:
    """What only runs have of which figures alone are known."""
    names = ("fit", "held_out")
    determined = {
        key: dict(zip(("value", "low", "high"), numbers, strict=True))
        for key, numbers in gap.determined.items()
    }
    return {
        "gap": {
            "before": dict(zip(names, gap.gap_before, strict=True)),
            "after": dict(zip(names, gap.gap_after, strict=True)),
        },
        "determined": determined,
        "empirical": gap.empirical,
        "doubts": (),
        "chance": gap.chance,
        "observations": [
            {"run": one.name, "figure": one.figure, "value": one.size, "sd": one.sd}
            for one in gap.observations
        ],
        "printed": gap.printed,
        "plain": gap.plain,
        "extended": gap.extended,
        "free_friction": gap.free_friction,
        "not_felt": gap.not_felt,
        "open_figures": gap.open_figures,
        "fits_share": gap.fits_share,
    }


def _plain(value: Any) -> Any:
    """Numbers of so many digits, lists for sequences, tables for mappings and data classes."""
    if is_dataclass(value) and not isinstance(value, type):
        return _plain(asdict(value))
    if isinstance(value, Mapping):
        return {str(key): _plain(entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple, np.ndarray)):
        return [_plain(entry) for entry in value]
    if isinstance(value, (bool, np.bool_)):
        return bool(value)
    if isinstance(value, (int, np.integer)):
        return int(value)
    if isinstance(value, (float, np.floating)):
        return float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None
    return value
