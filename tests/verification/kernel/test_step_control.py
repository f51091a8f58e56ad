"""The integrator's long steps in stick miss no break-away, and find it as exactly as is asked."""

from kernel_steps import memory_of
from stickslip import Parameters
from stickslip.kernel import advance, layout
from stickslip.kernel.interpolant import copy_instant

# a stick of half a minute, which the load ends
SLOW = Parameters.model_validate(
    {
        "rig": {"degrees_of_freedom": ["x"]},
        "surface": {"speed": 1e-3},
        "friction": {"mu_s": 0.3, "mu_k": 0.2},
    }
)


def first_break_away(longer: float, tolerance: float) -> tuple[float, int]:
    """Its time, s, and the steps up to it, with sticks' longest step so many times as long."""
    memory, w, e = memory_of(SLOW), [0.0] * layout.W_SIZE, [0.0] * layout.E_FIRST
    memory.p[layout.P_LONGEST_STICK] *= longer
    memory.p[layout.P_TOLERANCE] = tolerance
    steps = 0
    while True:
        held = memory.z[layout.HERE + layout.MODE] == layout.STICK
        assert advance.internal_step(memory.p, memory.u, memory.z, w, e, 0.0) == layout.DONE
        steps += held
        if held and memory.z[layout.NEXT + layout.MODE] == layout.SLIP:
            return memory.z[layout.NEXT + layout.TIME], steps
        copy_instant(memory.z, layout.NEXT, layout.HERE)


def test_long_steps_in_stick_miss_no_break_away():
    """A load that only grows reaches its limit at the same time, in fewer steps."""
    exact, many = first_break_away(1.0, 1e-11)
    late, few = first_break_away(20.0, 1e-11)
    assert few < many / 4
    assert abs(late - exact) < 1e-10


def test_a_break_away_is_as_exact_as_the_tolerance_asks():
    """The search ends where the load is within tolerance^1.5 of its limit, a part of that.

    The load grows from below nothing to its limit in ``exact`` s, nearly evenly.
    """
    exact, _ = first_break_away(20.0, 1e-11)
    for tolerance in (1e-8, 1e-6, 1e-4):
        found, _ = first_break_away(20.0, tolerance)
        assert abs(found - exact) < tolerance**1.5 * exact + 1e-12
