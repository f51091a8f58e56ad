"""Model exchange where the surface's speed is given by the host, and varies.

A block that sticks follows the surface, and what it loads the contact with depends on the surface's
acceleration, of which a host says nothing. Two hosts: fmpy's CVode, which gives inputs only where
it asks for event indicators, and the same with the inputs given at each time, as most hosts do.

The comparison is the unit in co-simulation: with the input's derivative in steps that end at every
kink of a table it follows that table exactly, but for a jump, which takes a block that sticks a
step to follow.
"""

import random
from functools import cache

import numpy as np
import pytest
from fmpy import simulate_fmu, sundials
from fmpy_slave import fmpy_slave
from plain_start import values

STOP, STEP, SHOWN = 6.0, 1e-3, 0.01
#: Pretension and the finest own steps: what is compared is the hosts'.
RIG = {"rig": {"spring_natural_length": 0.17}, "solver": {"tolerance": 1e-11}}
NAMES = ("x", "heat", "slip_count", "vx", "mode")


def table(times, speeds):
    return np.array(
        list(zip(times, speeds, strict=True)), dtype=[("time", float), ("surface_speed", float)]
    )


def sampled(speed, every=0.02):
    times = np.arange(0.0, STOP + every / 2.0, every)
    return table(times, speed(times))


DRIVES = {
    "ramp": table([0.0, STOP], [0.0, 0.15]),
    "sine": sampled(lambda t: 0.12 + 0.06 * np.sin(2.0 * np.pi * 0.35 * t)),
    "through zero": sampled(lambda t: 0.1 * np.sin(2.0 * np.pi * 0.3 * t)),
    "kinks": table([0.0, 1.0, 2.5, 3.0, 4.0, STOP], [0.05, 0.15, 0.02, 0.2, -0.05, 0.1]),
    "steps": table([0.0, 2.0, 2.0, 4.0, 4.0, STOP], [0.1, 0.1, 0.05, 0.05, 0.2, 0.2]),
}
SLAB = {
    "lateral_friction": {"ratio": 1.0},
    "turning_surface": {"curvature": 1.0},
    "initial": {"phi": 0.05, "y": 0.005},
}
CASES = {
    **{name: (name, {}) for name in DRIVES},
    "slab": ("sine", SLAB),
    "stick_creep": ("ramp", {"friction": {"stick_creep": 4e-3}}),
}


def give_at_every_time(solver, time, states, rates, _):
    """Right-hand side of a host that gives inputs at each time for which it asks for rates."""
    solver.set_time(time)
    solver.input.apply(time)
    solver.set_x(sundials.NV_DATA_S(states), solver.nx)
    solver.get_dx(sundials.NV_DATA_S(rates), solver.nx)
    return 0


@pytest.fixture(params=["at events only", "at every time"])
def host(request, monkeypatch):
    if request.param == "at every time":
        monkeypatch.setattr(sundials.CVodeSolver, "f", give_at_every_time)


def starts(drive, tables):
    speed = float(drive["surface_speed"][0])
    return {**values({**tables, **RIG}), "surface_speed": speed, "initial.vx": speed}


def exchanged(unit, drive, tables, tolerance):
    given = starts(drive, tables)
    if "fmi3" in unit.name:  # arrays are one variable there
        given = {name: value for name, value in given.items() if "[" not in name}
    return simulate_fmu(
        str(unit),
        fmi_type="ModelExchange",
        relative_tolerance=tolerance,
        stop_time=STOP,
        output_interval=SHOWN,
        start_values=given,
        input=drive,
        output=NAMES,
        record_events=False,
        timeout=60.0,
    )


def own(unit, folder, drive, tables):
    """The same in co-simulation, with the derivative of the table."""
    times, speeds, rows = drive["time"], drive["surface_speed"], []
    shown = ("x", "heat", "vx", "slip_count")
    with fmpy_slave(unit, folder) as block:
        block.begin(**starts(drive, tables))
        speed = [block.variables["surface_speed"].valueReference]

        def show():
            rows.append([block.get(name) for name in shown])

        show()
        for n in range(round(STOP / STEP)):
            piece = min(np.searchsorted(times, n * STEP + STEP / 2.0) - 1, len(times) - 2)
            rate = (speeds[piece + 1] - speeds[piece]) / (times[piece + 1] - times[piece])
            block.slave.setReal(speed, [speeds[piece] + rate * (n * STEP - times[piece])])
            block.slave.setRealInputDerivatives(speed, [1], [rate])
            block.march(n, 1, STEP)
            if (n + 1) % round(SHOWN / STEP) == 0:
                show()
    return dict(zip(shown, np.array(rows).T, strict=True))


@pytest.fixture(scope="module")
def exact(fmu, tmp_path_factory):
    """Name of a case, or number of a drawn drive -> `own`, computed once for both hosts."""

    @cache
    def look_up(case):
        named, tables = CASES.get(case, (None, {}))
        drive = drawn(case) if named is None else DRIVES[named]
        return own(fmu, tmp_path_factory.mktemp("own"), drive, tables)

    return look_up


def off(result, exact, name):
    return np.abs(result[name] - exact[name]).max()


@pytest.mark.parametrize("case", CASES)
def test_a_drive_of_the_host_moves_the_block_as_in_co_simulation(fmu, exact, host, case):
    drive, tables, exact = DRIVES[CASES[case][0]], CASES[case][1], exact(case)
    coarse, fine = (exchanged(fmu, drive, tables, tolerance) for tolerance in (1e-8, 1e-10))
    assert (fine["slip_count"] == exact["slip_count"]).all()
    # A step of the comparison in which a stick follows a jump leaves it that much behind.
    limit = 2e-4 if case == "steps" else 5e-9
    assert off(fine, exact, "x") < limit and off(fine, exact, "heat") < 10.0 * limit
    if case != "steps":
        assert off(fine, exact, "x") < 0.2 * off(coarse, exact, "x") + 0.2 * limit
    # In a stick the state is the surface's speed, or that of the creep; what the first moment, at
    # which no rate is known, has left it behind has gone at the motion's own rate.
    inside = (fine["mode"][1:] == 0) & (fine["mode"][:-1] == 0) & (fine["time"][1:] > 1.0)
    assert inside.sum() > 10 and np.abs(fine["vx"] - exact["vx"])[1:][inside].max() < 1e-5


@pytest.mark.parametrize("case", ["sine", "kinks"])
def test_fmi_3_takes_a_drive_as_fmi_2_does(fmu, fmu3, host, case):
    old, new = (exchanged(unit, DRIVES[case], {}, 1e-9) for unit in (fmu, fmu3))
    assert off(new, old, "x") < 5e-7 and (new["slip_count"] == old["slip_count"]).all()


def drawn(seed):
    """A drive of two sines, or a table with a few kinks."""
    draw = random.Random(seed)
    if seed % 2:
        times = [0.0, *sorted(round(draw.uniform(0.3, 5.7), 3) for _ in range(4)), STOP]
        return table(times, [draw.uniform(-0.05, 0.2) for _ in times])
    mean, parts = draw.uniform(0.05, 0.2), [draw.uniform(0.0, 0.04) for _ in range(2)]
    rates = [draw.uniform(0.2, 3.0) for _ in range(2)]
    return sampled(
        lambda t: mean + sum(a * np.sin(w * t) for a, w in zip(parts, rates, strict=True))
    )


#: The first 50 are those on which `SHRINKS` of the kernel was chosen, the others were kept from it.
DRAWN = range(75)
#: Kinks where a stick is near its limit: there a rate across the kink is a break-away that is none,
#: or is the same event without end, or is late where the kink is not found.
KINKED = (8, 13, 33, 37, 39, 47, 59)
SEEDS = [
    pytest.param(seed, marks=[] if seed < 2 or seed in KINKED else pytest.mark.slow)
    for seed in DRAWN
]
TOLERANCE = 1e-9


@pytest.mark.parametrize("seed", SEEDS)
def test_drawn_drives(fmu, exact, host, seed):
    """All slips at their times. Errors over the tolerance, in the median and at most:

    given at every time: x 7 and 106 m, heat 33 and 175 of what there is at the end;
    given at events only: x 7.6 and 116 m, heat 27 and 198.

    A tolerance is that of one step, of which there are some hundred to a slip. The same CVode of
    the same equations without a unit, with input and rate exact, is no nearer.
    """
    exact, result = exact(seed), exchanged(fmu, drawn(seed), {}, TOLERANCE)
    assert len(result) == len(exact["x"])
    assert (result["slip_count"] == exact["slip_count"]).all()
    assert off(result, exact, "x") < 150.0 * TOLERANCE
    assert off(result, exact, "heat") < 300.0 * TOLERANCE * exact["heat"][-1]
