"""Why `advance` gave up, in sentences with the remedy."""

from .layout import NOT_FINITE, SPRING_COLLAPSED, STEP_VANISHED

WHY_NOT = {
    STEP_VANISHED: "the integrator's step fell below the resolution of time; check mass, "
    "stiffness and initial state, or raise solver.tolerance",
    NOT_FINITE: "the motion grew beyond all numbers",
    SPRING_COLLAPSED: "the block was carried into the anchor of a spring; use stiffer or longer "
    "springs, or less friction",
}
