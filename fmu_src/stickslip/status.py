"""Why `advance` gave up, in sentences with the remedy."""

from .kernel.layout import NOT_FINITE, SPRING_COLLAPSED, STEP_VANISHED, TOO_STIFF

WHY_NOT = {
    STEP_VANISHED: "the integrator's step fell below the resolution of time; check mass, "
    "stiffness and initial state, or raise solver.tolerance",
    NOT_FINITE: "the motion grew beyond all numbers",
    SPRING_COLLAPSED: "the block was carried into the anchor of a spring; use stiffer or longer "
    "springs, or less friction",
    TOO_STIFF: "the contact creeps, with friction that answers faster than the motion can be "
    "followed; raise mu_s above mu_k, take lateral_friction.ratio 0 or 1, or a larger "
    "rate_and_state.creep_speed",
}
