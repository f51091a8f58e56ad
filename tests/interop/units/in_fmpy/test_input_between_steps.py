"""Inputs that a host gives step by step: the motion converges to that under the same drive inside.

The surface's speed is a sine of the size of a ripple. Inside, it is the effect `speed_ripple`; from
outside it comes in steps of h: held, going on as between the last two values, or with its rate.
What decides when a stick ends is the surface's acceleration: it is right to the order h where the
speed is held or goes on, and so is the motion; with rates it is right to the order h^2.

Events that end a step early (FMI 3) leave that as it is, wherever in the step they fall.
"""

import ctypes
import math
import random
from functools import cache

import fmpy
import numpy as np
import pytest
from c_unit import Unit
from fmpy_instance import instance

AMPLITUDE, FREQUENCY, SPEED, STOP, SHOWN = 0.3, 1.0, 0.15, 8.0, 0.04
STEPS = (0.02, 0.01, 0.005, 0.0025, 0.00125)


INSIDE = {"speed_ripple.amplitude": AMPLITUDE, "speed_ripple.frequency": FREQUENCY}


@pytest.fixture(scope="module")
def block(fmu, tmp_path_factory):
    with instance(fmu, tmp_path_factory.mktemp("drive")) as one:
        yield one


def driven(block, size, hold=0, with_rate=False, inside=False):
    """x every SHOWN seconds, the number of slips and the energy residual on a belt whose speed is
    given from outside, or ripples by itself."""
    block.slave.reset()
    block.initialise(**{"input.hold": hold}, **(INSIDE if inside else {}))
    speed = [block.variables["surface_speed"].valueReference]
    x, each = [], round(SHOWN / size)
    for n in range(round(STOP / size)):
        turn = 2.0 * math.pi * FREQUENCY * n * size
        if not inside:
            block.slave.setReal(speed, [SPEED * (1 + AMPLITUDE * math.sin(turn))])
        if with_rate:
            rate = SPEED * AMPLITUDE * 2.0 * math.pi * FREQUENCY * math.cos(turn)
            block.slave.setRealInputDerivatives(speed, [1], [rate])
        block.slave.doStep(n * size, size)
        if (n + 1) % each == 0:
            x.append(block.get("x"))
    return np.array(x), block.get("slip_count"), block.get("energy_residual")


@pytest.fixture(scope="module")
def exact(block):
    return driven(block, SHOWN, inside=True)


@pytest.mark.parametrize(("given", "finest", "orders"), [
    ({"hold": 0}, 6e-5, (0.8, 1.8)),
    ({"hold": 1}, 1e-5, (0.8, 1.8)),
    ({"with_rate": True}, 3e-7, (1.7, 3.0)),
])  # fmt: skip
def test_the_motion_converges_to_that_of_the_ripple_inside(block, exact, given, finest, orders):
    errors = []
    for size in STEPS:
        x, slips, residual = driven(block, size, **given)
        errors.append(np.abs(x - exact[0]).max())
        assert abs(residual) < 1e-11
        if size <= 0.01:
            assert slips == exact[1]
    order = np.polyfit(np.log(STEPS), np.log(errors), 1)[0]
    # The error of an event is that of where it falls between two steps: the order scatters.
    assert orders[0] < order < orders[1]
    assert errors[-1] < finest


def test_outputs_have_first_derivatives(fmu, tmp_path):
    """For who interpolates them between the steps: exact of what the model integrates."""
    with instance(fmu, tmp_path) as block:
        block.initialise(surface_speed=SPEED, **{"lateral_friction.ratio": 1.0, "initial.y": 0.01})
        block.march(0, 300, 0.01)
        at = {name: each.valueReference for name, each in block.variables.items()}

        def rate(name, order=1):
            value = ctypes.c_double()
            block.slave.fmi2GetRealOutputDerivatives(
                block.slave.component, ctypes.byref(ctypes.c_uint(at[name])), 1,
                ctypes.byref(ctypes.c_int(order)), ctypes.byref(value),
            )  # fmt: skip
            return value.value

        for place, velocity in (("x", "vx"), ("y", "vy"), ("phi", "omega")):
            assert rate(place) == block.get(velocity)
        assert rate("surface_travel") == pytest.approx(SPEED)
        power = block.get("friction_force_x") * (SPEED - block.get("vx"))
        power -= block.get("friction_force_y") * block.get("vy")
        power -= block.get("friction_moment") * block.get("omega")
        assert rate("heat") == pytest.approx(power, rel=1e-9)
        with pytest.raises(fmpy.fmi1.FMICallException):
            rate("x", order=2)


# --- events that end a step ---

CASES = {
    "line": {},
    "transition": {"friction.transition_speed": 5e-3},
    "bristles": {"friction.transition_speed": 5e-3, "friction.presliding_distance": 1e-4},
    "plane": {"lateral_friction.ratio": 1.0, "initial.phi": 0.05, "initial.y": 0.005},
}
#: Hosts, by where they set inputs: at the ends of their steps, at events too, or in event mode.
HOSTS = ("steps", "events", "event mode")


def rippling(time):
    turn = 2.0 * math.pi * FREQUENCY * time
    return {"surface_speed": SPEED * (1.0 + AMPLITUDE * math.sin(turn))}


@pytest.fixture(scope="module")
def unit(fmu3, tmp_path_factory):
    return Unit(fmu3, tmp_path_factory.mktemp("events"))


@pytest.fixture(scope="module")
def plain(unit):
    """Case, hold and seed -> motion without early return, each computed once."""

    @cache
    def look_up(case, hold, seed):
        return motion(unit, *drives(seed), 6.0, **CASES[case], **{"input.hold": hold})

    return look_up


def motion(unit, drive, size, stop, host=None, **values):
    """x every SHOWN seconds, the number of slips, and times of events; without a host, of a unit
    that does not return early."""
    x, events, each = [], [], round(SHOWN / size)
    with unit.instance(events=True, early=host is not None) as block:
        block.begin(**drive(0.0), **values)
        block.done("EnterStepMode")
        for n in range(round(stop / size)):
            end = (n + 1) * size
            put(block, drive)
            while block.step(end - block.time)[1]:
                events.append(block.time)
                block.done("EnterEventMode")
                if host == "event mode":
                    put(block, drive)
                block.update()
                block.done("EnterStepMode")
                if host == "events":
                    put(block, drive)
            if (n + 1) % each == 0:
                x.append(block.get("x"))
        assert abs(block.get("energy_residual")) < 1e-11
        return np.array(x), block.get("slip_count"), events


def put(block, drive):
    for name, value in drive(block.time).items():
        block.set(name, value)


def drives(seed):
    """A rippling speed and a swinging force, and a step."""
    draw = random.Random(seed)
    speed, part, frequency = draw.uniform(0.03, 0.2), draw.uniform(0.05, 0.3), draw.uniform(0.3, 2)
    force, size = draw.uniform(0.0, 0.1), draw.choice([0.005, 0.01, 0.02])

    def drive(time):
        turn = 2.0 * math.pi * frequency * time
        return {
            "surface_speed": speed * (1.0 + part * math.sin(turn)),
            "external_force_x": force * math.sin(5.0 * time),
        }

    return drive, size


def assert_same(early, plain, case):
    """Of the integration of bristles a restart at an event is to be seen, at the tolerance 1e-9 of
    a motion of some 0.1 m; of all else, rounding."""
    allowed = 1e-7 if case == "bristles" else 1e-12
    np.testing.assert_allclose(early[0], plain[0], rtol=0, atol=allowed)
    assert early[1] == plain[1]


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize(("host", "hold"), [*((host, 1) for host in HOSTS), ("steps", 0)])
def test_inputs_are_the_same_with_and_without_early_return(unit, plain, case, host, hold):
    """Held ones also not on the way to where the surface's speed gets under a block that sticks."""
    found = 0
    for seed in range(4):
        early = motion(unit, *drives(seed), 6.0, host, **CASES[case], **{"input.hold": hold})
        assert_same(early, plain(case, hold, seed), case)
        assert len(set(early[2])) == len(early[2])
        found += len(early[2])
    assert found > 20


@pytest.mark.parametrize("hold", [0, 1])
def test_a_host_that_asks_for_a_whole_step_behind_an_event_is_heard_there(unit, hold):
    """What it sets at the event is then all that is known of the step."""
    errors = []
    for size in STEPS:
        ends = []
        for drive, given in ((rippling, {"input.hold": hold}), (lambda _: {}, INSIDE)):
            with unit.instance(events=True, early=True) as block:
                block.begin(surface_speed=SPEED, **given)
                block.done("EnterStepMode")
                while block.time < (ends[0][0] if ends else STOP / 2):
                    put(block, drive)
                    last = ends[0][0] - block.time if ends else size
                    if block.step(min(size, last))[0]:
                        block.handle_event()
                ends.append((block.time, block.get("x"), block.get("slip_count")))
        errors.append(abs(ends[0][1] - ends[1][1]))
        if size <= 0.01:
            assert ends[0][2] == ends[1][2]
    assert max(errors[3:]) < 1e-4 and max(errors[3:]) < 0.5 * max(errors[:2])


def test_what_is_set_at_an_event_counts_at_once_where_inputs_are_held(unit):
    """And from the end of the step on where they go on."""
    pulls = {}
    for hold in (0, 1):
        with unit.instance(events=True, early=True) as block:
            block.begin(surface_speed=SPEED, **{"input.hold": hold})
            block.done("EnterStepMode")
            while block.step(1.0)[1] and block.get("mode") == 0:
                block.handle_event()
            assert block.get("mode") == 1  # just broken away
            block.handle_event()
            block.set("external_force_x", -0.3)  # the way it slides
            before = block.get("vx")
            block.step(1e-5)
            pulls[hold] = (block.get("vx") - before) / 1e-5 * block.get("rig.mass")
    assert pulls[0] == pytest.approx(pulls[1] - 0.3, abs=1e-3)
