"""The answer as data: what `gap.json` holds."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import asdict, is_dataclass
from typing import Any

import numpy as np

from cosim.gap.doubts.doubt import unbelieved
from cosim.gap.result import FittedModel, Gap, Law
from cosim.report.files import json_text
from cosim.studies.reproduction.summary import SummaryGap

#: Significant digits of every number: more than any fit to noisy data knows, fewer than what the
#: order of a sum may change.
DIGITS = 6


def as_json(gap: Gap | SummaryGap, model: str) -> str:
    """JSON text without NaN; the same answer gives the same bytes. model: name of its file."""
    return json_text(as_data(gap, model))


def as_data(gap: Gap | SummaryGap, model: str) -> dict[str, Any]:
    """A tree of plain values; a number that there is not is None."""
    data = {
        "campaign": gap.campaign.name,
        "verdict": gap.verdict,
        "effects": gap.effects,
        "classes": gap.classes,
        "where": gap.where,
        "ranking": gap.ranking,
        "gap": {"before": _pair(gap.gap_before), "after": _pair(gap.gap_after)},
        "next_experiment": gap.next_experiment,
        "model": model,
        "determined": {key: _interval(*value) for key, value in gap.determined.items()},
        "empirical": gap.empirical,
        "remarks": (*gap.campaign.remarks, *gap.remarks),
        "doubts": _doubts(gap),
    }
    if isinstance(gap, SummaryGap):
        return _plain(data | _of_figures(gap))
    data = _plain(data | _of_runs(gap))
    if not gap.has_held_out:
        _forget_held_out(data)
    return data


def _forget_held_out(data: dict[str, Any]) -> None:
    """Nothing was held out, and gaps of the fit are none of that."""
    for pair in data["gap"].values():
        pair["held_out"] = None
    for row in (*data["ranking"], *data["ladder"]):
        row["held_out_gap"] = None


def _doubts(gap: Gap | SummaryGap) -> list[dict[str, Any]]:
    """Of runs with a time series; ``decisive``: nothing is believed beside it."""
    if isinstance(gap, SummaryGap):
        return []
    refused = unbelieved(gap.doubts, gap.explaining)
    return [
        {**asdict(doubt), "runs": doubt.run.split(", ") if doubt.run else []}
        | {"decisive": doubt in refused}
        for doubt in gap.doubts
    ]


def _of_runs(gap: Gap) -> dict[str, Any]:
    """What only runs with a time series have."""
    campaign = gap.campaign
    noise = {
        channel: {"value": value, "estimated": channel in campaign.noise_estimated}
        for channel, value in campaign.noise.items()
    }
    return {
        "noise": noise,
        "plain": _fitted(gap.plain),
        "extended": None if gap.extended is None else _fitted(gap.extended),
        "ladder": gap.ladder,
        "share": gap.share if gap.effects else None,
        "reasons": gap.reasons,
        "lacks": gap.lacks,
        "believed": gap.believed,
        "searched": gap.searched,
        "spreads": gap.spreads,
        "exponents": gap.powers,
        "curves": [_curve(law) for law in gap.laws],
        "remains": gap.remains,
        "quantisation": gap.quantisation,
    }


def _curve(law: Law) -> dict[str, Any]:
    curve = law.curve
    names = ("axis", "unit", "on", "per", "memory", "level", "gain", "error")
    values = {name: getattr(curve, name) for name in (*names, "values", "mean", "low", "high")}
    of = "force, N" if curve.on == "force" else "logarithm of friction, less its mean"
    return {"effect": law.effect or None, "in_model": law.in_model, "of": of, **values}


def _fitted(fitted: FittedModel) -> dict[str, Any]:
    return {
        "parameters": fitted.values,
        "settings": fitted.settings,
        "intervals": fitted.intervals,
        "at_bound": fitted.at_bound,
        "undetermined": fitted.undetermined,
        "runs": [
            {"name": run.name, "hold_out": run.track.run.hold_out, "gap": run.gap, "own": run.own}
            for run in fitted.runs
        ],
    }


def _of_figures(gap: SummaryGap) -> dict[str, Any]:
    """What only runs have of which figures alone are known."""
    return {
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


def _pair(pair: tuple[float, float]) -> dict[str, float]:
    return {"fit": pair[0], "held_out": pair[1]}


def _interval(value: float, low: float, high: float) -> dict[str, float]:
    return {"value": value, "low": low, "high": high}


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
