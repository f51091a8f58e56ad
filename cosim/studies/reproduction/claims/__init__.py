"""The claims C1 to C18 of the source study, one function each that returns the judged claim."""

from __future__ import annotations

from collections.abc import Callable

from ..claim import Claim
from . import (
    belt_length,
    dry_friction,
    friction_approaches,
    friction_level,
    friction_ratio,
    jumps_to_stick,
    kinetic_coefficient,
    rotation,
    run_times,
    spring_angles,
    static_strengthening,
    trends,
    verification,
)

CLAIMS: dict[str, Callable[[], Claim]] = {
    "C1": verification.judge_matrices,
    "C2": verification.judge_no_stiffness,
    "C3": verification.judge_stiff,
    "C4": verification.judge_no_friction,
    "C5": spring_angles.judge,
    "C6": friction_level.judge,
    "C7": rotation.judge,
    "C8": trends.judge_mean,
    "C9": trends.judge_slip_time,
    "C10": kinetic_coefficient.judge,
    "C11": friction_ratio.judge,
    "C12": run_times.judge,
    "C13": belt_length.judge_length,
    "C14": jumps_to_stick.judge,
    "C15": belt_length.judge_table,
    "C16": dry_friction.judge,
    "C17": friction_approaches.judge,
    "C18": static_strengthening.judge,
}
