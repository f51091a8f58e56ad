"""Friction of a sliding and spinning disc: closed form against integration over the disc.

Limit surface of a disc under uniform pressure: Goyal, Ruina & Papadopoulos, Wear 143 (1991). The
largest moment is 2/3 mu N a; on the rim (sliding = spinning) the mean local speed is the mean
distance of a rim point from the disc's points, 32/(9 pi).
"""

import numpy as np
import pytest
from disc_integral import law_over_disc
from hypothesis import given
from hypothesis import strategies as st
from stickslip.kernel.contact import limit_surface_ratio
from stickslip.kernel.friction.disc import disc_friction
from stickslip.kernel.layout import W_PAIR, W_SIZE


def friction(sliding: float, spinning: float) -> tuple[float, float]:
    w = [0.0] * W_SIZE
    disc_friction(sliding, spinning, w)
    return w[W_PAIR], w[W_PAIR + 1]


@pytest.mark.parametrize("sliding, spinning", [(1, 0.05), (1, 0.5), (1, 0.9), (0.6, 1), (0.1, 1)])
def test_agrees_with_integration_over_the_disc(sliding, spinning):
    expected = law_over_disc(lambda speed: 1.0, sliding, spinning, 1e-9)
    assert friction(sliding, spinning) == pytest.approx(expected, abs=2e-6)


def test_published_values():
    assert friction(1.0, 0.0) == (1.0, 0.0)
    assert friction(0.0, 1.0) == pytest.approx((0.0, 2.0 / 3.0), abs=1e-15)
    force, moment = friction(1.0, 1.0)
    assert force == pytest.approx(8.0 / (3.0 * np.pi), abs=1e-14)
    assert force + moment == pytest.approx(32.0 / (9.0 * np.pi), abs=1e-14)


def test_smooth_through_every_branch():
    """Series, closed form and the change of branch at sliding = spinning join to rounding."""
    for ratio in (np.sqrt(0.05), 1.0, 1.0 / np.sqrt(0.05)):
        below = friction(1.0, ratio * (1.0 - 1e-13))
        above = friction(1.0, ratio * (1.0 + 1e-13))
        assert below == pytest.approx(above, abs=5e-12)


@given(st.floats(1e-6, 1.0), st.floats(1e-6, 1.0))
def test_friction_is_the_gradient_of_the_mean_speed(sliding, spinning):
    """P = U f + s m, f = dP/dU, m = dP/ds: the limit surface is convex and has P as support."""
    f, m = friction(sliding, spinning)
    mean_speed = sliding * f + spinning * m
    for angle in np.linspace(0.0, np.pi / 2, 9):
        other = friction(np.cos(angle), np.sin(angle))
        # maximum dissipation: no other point of the surface dissipates more in this motion
        assert sliding * other[0] + spinning * other[1] <= mean_speed * (1.0 + 1e-12)


@given(st.floats(0.0, 1.0), st.floats(0.1, 3.0))
def test_ratio_of_a_load_on_the_limit_surface_is_its_scale(t, scale):
    f, m = friction(1.0 - t, t)
    ratio = limit_surface_ratio(scale * f, scale * m, [0.0] * W_SIZE)
    assert ratio == pytest.approx(scale, rel=1e-12)
