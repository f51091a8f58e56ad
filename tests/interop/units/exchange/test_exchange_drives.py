"""Model exchange where the surface's speed is given by the host, and varies.

A block that sticks follows the surface, and what it loads the contact with depends on the surface's
acceleration, of which a host says nothing. Two hosts: fmpy's CVode, which gives inputs only where
it asks for event indicators, and the same with the inputs given at each time, as most hosts do.

The comparison is the unit in co-simulation: with the input's derivative in steps that end at every
kink of a table it follows that table exactly, but for a jump, which takes a block that sticks a
step to follow.
"""

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
        str(unit), fmi_type="ModelExchange", relative_tolerance=tolerance, stop_time=STOP,
        output_interval=SHOWN, start_values=given, input=drive, output=NAMES,
        record_events=False, timeout=60.0,
    )  # fmt: skip


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
    """Name of a case -> `own`, computed once for both hosts."""

    @cache
    def look_up(case):
        drive, tables = CASES[case]
        return own(fmu, tmp_path_factory.mktemp("own"), DRIVES[drive], tables)

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
