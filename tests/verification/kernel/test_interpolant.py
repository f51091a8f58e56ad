"""Samples inside the integrator's steps: as exact as the tolerance asks, and without influence."""

import random

import numpy as np
import pytest
from effect_cases import IDS, draw_parameters
from kernel_steps import memory_of
from stickslip import Parameters
from stickslip.catalogue import CATALOGUE
from stickslip.kernel import advance, layout, outputs
from stickslip.kernel.interpolant import copy_instant
from stickslip.kernel.runge_kutta import state_scale

PLANAR = {
    "lateral_friction": {"ratio": 1.0},
    "rig": {"spring_natural_length": 0.17},
    "initial": {"y": 0.01, "phi": 0.2},
}


def fresh() -> tuple[list[float], list[float]]:
    return [0.0] * layout.W_SIZE, [0.0] * layout.E_FIRST


def in_slip(parameters: Parameters, time: float):
    """Memory of a run whose block HERE is in slip, soon after ``time``."""
    memory = memory_of(parameters)
    w, e = fresh()
    while (
        memory.z[layout.HERE + layout.TIME] < time
        or memory.z[layout.HERE + layout.MODE] != layout.SLIP
    ):
        assert advance.internal_step(memory.p, memory.u, memory.z, w, e, 0.0) == layout.DONE
        copy_instant(memory.z, layout.NEXT, layout.HERE)
    return memory


def as_arrays(memory) -> list[np.ndarray]:
    return [np.array(part) for part in (memory.p, memory.u, memory.z, *fresh())]


def in_short_steps(p, u, z, w, span: float, steps: int) -> np.ndarray:
    """The instant a ``span`` after HERE, by so many steps of the integrator."""
    kernel, z, w = CATALOGUE.compiled, z.copy(), w.copy()
    kernel.copy_instant(z, layout.HERE, layout.SHOWN)
    for _ in range(steps):
        kernel.begin_step(p, u, z, w, layout.SHOWN)
        kernel.take_step(p, u, z, w, layout.SHOWN, layout.BETWEEN, span / steps)
        kernel.copy_instant(z, layout.BETWEEN, layout.SHOWN)
    return z[layout.SHOWN :][: layout.INSTANT]


def error_inside(memory, h: float) -> float:
    """Largest error of x in a step of size h from HERE, against sixteen steps to the moment."""
    (p, u, z, w, _), kernel = as_arrays(memory), CATALOGUE.compiled
    kernel.begin_step(p, u, z, w, layout.HERE)
    kernel.take_step(p, u, z, w, layout.HERE, layout.NEXT, h)
    kernel.set_interpolant(p, u, z, w)
    largest = 0.0
    for part in (0.2, 0.4, 0.6, 0.8):
        kernel.interpolate(p, u, z, w, layout.SHOWN, z[layout.HERE + layout.TIME] + part * h)
        exact = in_short_steps(p, u, z, w, part * h, 16)
        largest = max(largest, abs(z[layout.SHOWN + layout.X] - exact[layout.X]))
    return largest


def test_order_of_the_interpolant():
    """Of degree 7: the error inside a step falls with the eighth power of its size."""
    memory = in_slip(Parameters(**PLANAR), 0.3)
    steps = np.array([1.0, 0.7, 0.5, 0.35]) / memory.p[layout.P_RATE]
    errors = [error_inside(memory, h) for h in steps]
    slope = np.polyfit(np.log(steps), np.log(errors), 1)[0]
    assert slope == pytest.approx(8.0, abs=0.5)


@pytest.mark.parametrize("effect", [None, *IDS])
def test_samples_are_as_exact_as_the_tolerance_asks(effect):
    """In units of the error test, the error of a moment in a step against eight short steps.

    A step that passes may err by 1; the interpolant errs by 3 in most, and is taken up to some 10
    by its own estimate, which here and there is a factor 2 too good. Elsewhere the sample comes by
    several steps that pass the test one by one: that is where a slip begins so abruptly that the
    test itself errs.
    """
    draw, kernel = random.Random(f"inside {effect}"), CATALOGUE.compiled
    for _ in range(3):
        p, u, z, w, e = as_arrays(memory_of(draw_parameters((effect,) if effect else (), draw)))
        for _ in range(200):
            if kernel.internal_step(p, u, z, w, e, 0.0) != layout.DONE:
                break
            if z[layout.NEXT + layout.TIME] > z[layout.HERE + layout.TIME]:
                kernel.set_interpolant(p, u, z, w)
                span = 0.37 * w[layout.W_SPAN]
                exact = in_short_steps(p, u, z, w, span, 8)
                kernel.look_inside(p, u, z, w, z[layout.HERE + layout.TIME] + span)
                for i in range(1, 1 + layout.STATES):
                    off = abs(z[layout.SHOWN + i] - exact[i]) / state_scale(p, u, i, exact[i])
                    assert off < (25.0 if z[layout.Z_SMOOTH] else 250.0)
            kernel.copy_instant(z, layout.NEXT, layout.HERE)


def test_a_state_taken_inside_a_step_continues_bit_for_bit():
    memory = memory_of(Parameters(**PLANAR))
    p, u, z = memory.p, memory.u, memory.z
    (w, e), shown = fresh(), [[0.0] * layout.O_SIZE, [0.0] * layout.O_SIZE]
    times = [0.3 + 0.004 * i for i in range(60)]
    advance.advance(p, u, z, w, e, times[0])
    kept = list(z)
    for row, start in zip(shown, (z, kept), strict=True):
        other, scratch = list(start), [7.0] * layout.W_SIZE  # no memory in the scratch space
        for time in times[1:]:
            assert advance.advance(p, u, other, scratch, e, time) == layout.DONE
        outputs.show(p, u, other, scratch, row, 0)
        kept = list(kept)
    assert shown[0] == shown[1]
