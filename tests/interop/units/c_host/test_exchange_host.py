"""Model exchange in a host written in C: an explicit Runge-Kutta method under drives that vary.

The host gives the surface's speed at every stage of its method. Compared are the same unit in
co-simulation, and the model's own kernel led along the drive. Both know the drive's kinks and
jumps, which are at ends of their steps; the host is told of jumps, as FMI has it, and has to learn
of the kinks from the unit's event indicators.
"""

import random
import re
import subprocess
import sys
from math import cos, sin

import numpy as np
import pytest
from c_library import EXCHANGE, compiler, host_in
from c_unit import library_of, references, references3
from fmpy_slave import fmpy_slave
from plain_start import values
from stickslip import Parameters
from stickslip.arrays import RunArrays, inputs
from stickslip.kernel import layout

from cosim.fmu.exchange import INDICATORS, states, variables
from cosim.fmu.native import built_guid

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="the host is written for Linux"),
    pytest.mark.skipif(not compiler(), reason="needs a C compiler"),
]

STOP, SHOWN, TOLERANCE = 6.0, 0.05, 1e-9
#: s, of the co-simulation, and of the kernel where a drive is curved.
STEP, FINE = 1e-3, 2e-4
#: A step of the co-simulation in which a stick follows a jump, which it does within a step, s.
AT_ONCE = 1e-9
#: Pretension and the finest own steps: what is compared is the host's.
RIG = {"rig": {"spring_natural_length": 0.17}, "solver": {"tolerance": 1e-12}}
SLAB = {
    "lateral_friction": {"ratio": 1.0},
    "turning_surface": {"curvature": 1.0},
    "initial": {"phi": 0.05, "y": 0.005},
}

# --- drives: pieces of time T, v, a, A and w, with v + a (t - T) + A sin(w (t - T)) from T on ---


def ramp(draw):
    speed = draw.uniform(0.0, 0.1)
    return [(0.0, speed, (draw.uniform(0.05, 0.25) - speed) / STOP, 0.0, 0.0)]


def sine(draw):
    return [(0.0, draw.uniform(0.08, 0.2), 0.0, draw.uniform(0.01, 0.06), draw.uniform(0.3, 6.0))]


def through_zero(draw):
    return [(0.0, draw.uniform(-0.03, 0.03), 0.0, draw.uniform(0.06, 0.15), draw.uniform(1.0, 4.0))]


def borders(draw, count):
    return [0.0, *sorted(round(draw.uniform(0.3, 5.7), 3) for _ in range(count))]


def kinks(draw):
    times = [*borders(draw, 4), STOP]
    speeds = [draw.uniform(-0.05, 0.2) for _ in times]
    return [
        (t, v, (after - v) / (end - t), 0.0, 0.0)
        for t, end, v, after in zip(times, times[1:], speeds, speeds[1:], strict=False)
    ]


def steps(draw):
    return [(t, draw.uniform(-0.05, 0.25), 0.0, 0.0, 0.0) for t in borders(draw, 5)]


KINDS = (ramp, sine, kinks, through_zero, steps)


def drawn(seed):
    """A drive, and the tables of a rig: of a belt, or of a slab for every third five."""
    tables = {**RIG, **SLAB} if seed // 5 % 3 == 2 else RIG
    return KINDS[seed % 5](random.Random(seed)), tables


def is_curved(drive):
    return any(piece[3] != 0.0 for piece in drive)


def course(drive, time, after=True):
    """Speed, its rate and the rate of that; after: behind a border of pieces, or before it."""
    late = 0.5 * AT_ONCE if after else -0.5 * AT_ONCE
    begin, v, a, amplitude, w = [piece for piece in drive if piece[0] <= max(time + late, 0.0)][-1]
    t = time - begin
    sine, cosine = amplitude * sin(w * t), amplitude * cos(w * t)
    return v + a * t + sine, a + w * cosine, -w * w * sine


def at_rest_on(drive, tables):
    """The tables, with a block that moves with the surface at first."""
    speed = course(drive, 0.0)[0]
    initial = {**tables.get("initial", {}), "vx": speed}
    return {**tables, "initial": initial, "surface": {"speed": speed}}


# --- who moves the block: rows of x, heat and the number of slips ---


def by_kernel(drive, tables):
    parameters = Parameters(**at_rest_on(drive, tables))
    step, rows = FINE if is_curved(drive) else STEP, []
    u = inputs(parameters.surface.speed, parameters.temperature_dependence.reference_degC)
    run = RunArrays.begin(parameters.pack(), u)

    def lead(time):
        speed, rate, _ = course(drive, time)
        run.u[layout.U_SPEED], run.u[layout.U_RATE + layout.U_SPEED] = speed, rate
        run.u[layout.U_SPEED_CURVE] = course(drive, time + 0.5 * step)[2]
        run.u[layout.U_SINCE] = time

    for n in range(round(STOP / step) + 1):
        if n % round(SHOWN / step) == 0:
            rows.append([run.z[layout.SHOWN + i] for i in (layout.X, layout.HEAT, layout.SLIPS)])
        lead(n * step)
        run.kernel.advance(*run.all, (n + 1) * step)
    return np.array(rows)


def in_co_simulation(unit, folder, drive, tables):
    rows = []
    with fmpy_slave(unit, folder) as block:
        block.begin(**values(at_rest_on(drive, tables)))
        reference = [block.variables["surface_speed"].valueReference]

        def go(start, end):
            speed, rate, _ = course(drive, start)
            block.slave.setReal(reference, [speed])
            block.slave.setRealInputDerivatives(reference, [1], [rate])
            block.slave.doStep(start, end - start)

        for n in range(round(STOP / STEP) + 1):
            start = n * STEP
            if n % round(SHOWN / STEP) == 0:
                rows.append([block.get(name) for name in ("x", "heat", "slip_count")])
            if abs(course(drive, start)[0] - course(drive, start, after=False)[0]) > 1e-9:
                go(start, start + AT_ONCE)
                start += AT_ONCE
            go(start, (n + 1) * STEP)
    return np.array(rows)


@pytest.fixture(scope="module")
def in_c(fmu, fmu3, tmp_path_factory):
    """Version, drive and tables -> rows, and how many events the host has had."""
    folder = tmp_path_factory.mktemp("host")
    program = host_in(folder, "-Wall", "-Wextra", host=EXCHANGE)
    units = {2: (fmu, references(variables())), 3: (fmu3, references3())}
    reals = {variable.name for variable in variables() if variable.type == "Real"}
    libraries = {
        version: library_of(units[version][0], folder, version=version) for version in units
    }

    def look_up(version, drive, tables):
        unit, places = units[version]
        given = values(at_rest_on(drive, tables)).items()
        named = [places[name] for name in ("surface_speed", "x", "heat", "slip_count")]
        command = [program, libraries[version], built_guid(unit), version, len(states())]
        command += [INDICATORS, TOLERANCE, STOP, SHOWN, *named]
        command += [f"{places[k]}={v!r}" for k, v in given if k in reals and k in places]
        text = "\n".join(" ".join(map(repr, piece)) for piece in drive)
        command = list(map(str, command))
        done = subprocess.run(command, input=text, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, done.stderr
        rows = [line.split() for line in done.stdout.splitlines()]
        return np.array(rows, dtype=float), int(re.search(r"(\d+) events", done.stderr)[1])

    return look_up


#: Of each kind and both rigs, with those that are furthest off.
SHOWN_ALWAYS = (1, 2, 4, 8, 9, 10, 12, 13, 20, 36, 42, 44)
SEEDS = [
    pytest.param(seed, marks=[] if seed in SHOWN_ALWAYS else pytest.mark.slow) for seed in range(50)
]


@pytest.mark.parametrize("seed", SEEDS)
def test_drawn_drives(fmu, in_c, tmp_path, seed):
    """All slips, and what they have come to.

    Over the tolerance, at most in all 50: x 0.9 m and heat 1.3 of what there is at the end, with
    kinks 75. In a slip the unit says nothing of those, and the host's estimate of its error misses
    them; where its steps end at them they leave 0.3. At 1e-10 the same, with the kernel's own
    steps along a sine, which are right to 1e-9. Co-simulation is told of a curved drive each
    millisecond, with its rate: right to 6e-8.
    """
    drive, tables = drawn(seed)
    exact, other = by_kernel(drive, tables), in_co_simulation(fmu, tmp_path, drive, tables)
    rows, events = in_c(2, drive, tables)
    assert (in_c(3, drive, tables)[0] == rows).all()
    assert (rows[:, 2] == exact[:, 2]).all() and (rows[:, 2] == other[:, 2]).all()
    off, off_other = (np.abs(rows - each).max(axis=0) for each in (exact, other))
    heat = exact[-1, 1]
    assert off[0] < 2.0 * TOLERANCE
    assert off[1] < (100.0 if KINDS[seed % 5] is kinks else 2.0) * TOLERANCE * heat
    assert off_other[0] < 1e-7 and off_other[1] < 1e-7 * heat
    # Where the input is smooth a stick needs no event for it. There were up to 76 000.
    assert events < 200
