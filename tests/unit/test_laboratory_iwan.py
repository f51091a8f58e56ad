"""The Iwan contact of the foreign laboratory against closed forms."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest

sys.path.insert(0, str(Path(__file__).parents[1]))
from blind.laboratory.apparatus import ELEMENTS, GRAVITY, apparatus  # noqa: E402
from blind.laboratory.elements import SPREADS, spread_elements  # noqa: E402
from blind.laboratory.iwan import slide  # noqa: E402
from blind.laboratory.rows import FRICTION  # noqa: E402
from blind.laboratory.simulation import STEP, at_rest_on_belt, simulate  # noqa: E402

pytestmark = pytest.mark.slow  # numba compiles the simulator, and no answer hangs on it
GIVE, MASS, SPRING = 5e-5, 0.67, 20.17


def block(speed, mu_s=0.26, mu_k=0.2, spread="even", give=GIVE, **more):
    p = apparatus(MASS, SPRING, speed, mu_s, mu_k, contact="iwan", natural_length=0.2, **more)
    p["presliding"] = give
    for name, value in spread_elements(give, spread).items():
        p[name] = value
    return p


def pulled(p, path: np.ndarray) -> np.ndarray:
    """Force, N, on a surface that is pulled slowly along a path, m, below the block."""
    elements, total, forces = np.zeros(2 * ELEMENTS), np.zeros(3), [0.0]
    for step in np.diff(path):
        slide(
            p.reshape(1)[0], np.zeros(6), elements, 0.0, MASS * GRAVITY, 0.2, 0.0, step, 1.0, total
        )
        forces.append(total[0])
    return np.array(forces)


@pytest.mark.parametrize("spread", SPREADS)
def test_loop_is_masings(spread):
    """Both branches are the first loading at twice its scale: area 8 int F dx - 4 A F(A)."""
    p = block(0.0, 0.2, 0.2, spread)
    n, reach = 2000, 1.3 * GIVE
    up = np.linspace(0, reach, n + 1)
    first = pulled(p, up)
    path = np.concatenate([up, up[-2::-1], -up[1:], -up[-2::-1], up[1:]])
    force = pulled(p, path)
    loop = slice(n, 5 * n + 1)
    area = np.trapezoid(force[loop], path[loop])
    assert area == pytest.approx(8 * np.trapezoid(first, up) - 4 * reach * first[-1], rel=2e-3)
    back = force[n] - 2 * np.interp((reach - path[n : 3 * n]) / 2, up, first)
    assert force[n : 3 * n] == pytest.approx(back, abs=2e-3 * first[-1])
    assert first[1] / up[1] == pytest.approx(0.2 * MASS * GRAVITY / GIVE)
    assert (
        first[-1]
        < pulled(p, np.linspace(0, 20 * GIVE, n))[-1]
        == pytest.approx(0.2 * MASS * GRAVITY)
    )


@pytest.mark.parametrize("speed, planar", [(5e-3, False), (0.3, False), (0.3, True)])
def test_steady_sliding(speed, planar):
    """mu_k N at speed; below, what rest rebuilds while sliding: 1/(1 + u) of the excess."""
    p = block(speed, guided=not planar, planar=planar)
    p["stiffness"] = 1e4
    p["damping"], p["damping_power"], p["damping_speed"] = 300.0, 1.0, 1.0
    u = speed / p["fall_speed"]
    mu = 0.2 + 0.06 / (1 + u) / (1 + u ** p["fall_power"])
    end = simulate(p, at_rest_on_belt(p, 0.0), 1.0)[-1]
    assert end[FRICTION] == pytest.approx(mu * MASS * GRAVITY, rel=1e-3)
    if speed > 0.1:
        assert end[FRICTION] == pytest.approx(0.2 * MASS * GRAVITY, rel=1e-3)


def test_energy_balance_and_convergence():
    """Work of friction is the change of kinetic and spring energy; the path goes with the step."""
    p = block(0.1)
    start = at_rest_on_belt(p, 0.005)
    rows = simulate(p, start, 3.0, sample=STEP)
    v = rows[:, 3]
    work = np.cumsum(rows[1:, FRICTION] * 0.5 * (v[1:] + v[:-1])) * STEP
    energy = 0.5 * MASS * v**2 + 2 * SPRING * rows[:, 0] ** 2
    assert energy[1:] - energy[0] == pytest.approx(work, abs=1e-3 * energy.max())
    fine = simulate(p, start, 2.0, step=STEP / 16)[:, 0]
    errors = [np.std(simulate(p, start, 2.0, step=h)[:, 0] - fine) for h in (2 * STEP, STEP / 2)]
    assert errors[0] < 1e-4 and errors[1] < 0.5 * errors[0]
