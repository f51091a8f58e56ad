"""The claims C1 to C18 of the source study, one function each that returns the judged claim."""

from __future__ import annotations

from collections.abc import Callable

from ..claim import Claim
from . import (
    belt_length,
    friction_laws,
    friction_level,
    friction_ratio,
    jumps_to_stick,
    rotation,
    run_times,
    trends,
    verification,
)

CLAIMS: dict[str, Callable[[], Claim]] = {
    "C1": verification.judge_matrices,
    "C2": verification.judge_no_stiffness,
    "C3": verification.judge_stiff,
    "C4": verification.judge_no_friction,
    "C5": rotation.judge_treatments,
    "C6": friction_level.judge,
    "C7": rotation.judge_datasets,
    "C8": trends.judge_mean,
    "C9": trends.judge_slip_time,
    "C10": trends.judge_kinetic_coefficient,
    "C11": friction_ratio.judge,
    "C12": run_times.judge,
    "C13": belt_length.judge_length,
    "C14": jumps_to_stick.judge,
    "C15": belt_length.judge_table,
    "C16": friction_laws.judge_dry_friction,
    "C17": friction_laws.judge_falling_friction,
    "C18": friction_laws.judge_strengthening,
}
