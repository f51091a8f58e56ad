"""The claims C1 to C18 of the source study, one function each that fills and judges it."""

from ..claim import Judge
from . import belt_length, friction_laws, friction_level, rotation, scheme, trends

JUDGES: dict[str, Judge] = {
    "C1": scheme.judge_matrices,
    "C2": scheme.judge_no_stiffness,
    "C3": scheme.judge_stiff,
    "C4": scheme.judge_no_friction,
    "C5": rotation.judge_treatments,
    "C6": friction_level.judge,
    "C7": rotation.judge_datasets,
    "C8": trends.judge_mean,
    "C9": trends.judge_slip_time,
    "C10": trends.judge_kinetic_coefficient,
    "C11": friction_laws.judge_ratio,
    "C12": scheme.judge_run_times,
    "C13": belt_length.judge_length,
    "C14": scheme.judge_jumps,
    "C15": belt_length.judge_table,
    "C16": friction_laws.judge_dry_friction,
    "C17": friction_laws.judge_falling_friction,
    "C18": friction_laws.judge_strengthening,
}
