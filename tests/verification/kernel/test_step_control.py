"""The integrator's choice of its steps: what the error test has refused is not tried again."""

from kernel_steps import memory_of
from stickslip import Parameters
from stickslip.kernel import advance, layout
from stickslip.kernel.interpolant import copy_instant

# steps of a slip over a pattern are as long as the tolerance allows, not as the period does
SHORT_WAVES = Parameters.model_validate(
    {
        "surface": {"speed": 0.1},
        "friction": {"mu_s": 0.3, "mu_k": 0.2},
        "surface_pattern": {"amplitude": 0.1, "wavelength": 0.004},
    }
)


def test_a_refused_step_is_not_tried_again(monkeypatch):
    """One step in five is refused, at the crests; by a control that forgets it, more than each."""
    memory, w, e = memory_of(SHORT_WAVES), [0.0] * layout.W_SIZE, [0.0] * layout.E_FIRST
    tried, taken, take_step = 0, 0, advance.take_step

    def counted(*call):
        nonlocal tried
        tried += 1
        return take_step(*call)

    monkeypatch.setattr(advance, "take_step", counted)
    while memory.z[layout.HERE + layout.TIME] < 4.0:
        slips, before = memory.z[layout.HERE + layout.MODE] == layout.SLIP, tried
        assert advance.internal_step(memory.p, memory.u, memory.z, w, e, 0.0) == layout.DONE
        if slips and memory.z[layout.NEXT + layout.MODE] == layout.SLIP:
            taken += 1
        else:
            tried = before
        copy_instant(memory.z, layout.NEXT, layout.HERE)
    assert taken > 200
    assert tried < 1.5 * taken


# friction falls within 4 mm/s: the last tenth of a slip's speed takes a thousandth of its time
FALLING = Parameters.model_validate(
    {
        "surface": {"speed": 0.05},
        "friction": {"mu_s": 0.3, "mu_k": 0.2, "transition_speed": 0.004},
        "solver": {"tolerance": 1e-6},
    }
)


def test_a_slip_comes_to_rest_in_few_steps():
    """The time that is left follows from the friction on the way, and is not halved and halved."""
    memory, w, e = memory_of(FALLING), [0.0] * layout.W_SIZE, [0.0] * layout.E_FIRST
    steps = slips = 0
    while memory.z[layout.HERE + layout.TIME] < 8.0:
        slides = memory.z[layout.HERE + layout.MODE] == layout.SLIP
        assert advance.internal_step(memory.p, memory.u, memory.z, w, e, 0.0) == layout.DONE
        steps += slides
        slips += slides and memory.z[layout.NEXT + layout.MODE] == layout.STICK
        copy_instant(memory.z, layout.NEXT, layout.HERE)
    assert slips > 5
    assert steps / slips < 17


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
