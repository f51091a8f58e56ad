"""Coulomb friction of a disc under uniform pressure that slides and spins, in closed form.

A disc of radius a slides with speed U and spins with s = a |omega| (rim speed). Per unit of
mu N the friction force is f and its moment a m; the mean local sliding speed is U f + s m.
With the modulus k = min(U, s) / max(U, s), D(psi) = sqrt(1 - k^2 sin^2 psi) and all
integrals from 0 to pi/2:

- U >= s (centre of rotation outside):  f = 4/pi   int cos^2 D,  m = 4k/(3 pi) int cos^4 / D
- U <  s (centre of rotation inside):   f = 4k/pi  int cos^2 D,  m = 4/(3 pi)  int D^3

These are complete elliptic integrals: f and m trace the limit surface of the disc (Goyal,
Ruina & Papadopoulos, Wear 143, 1991; Farkas et al., Phys. Rev. Lett. 90, 2003). No quadrature
over the contact is needed where mu is uniform, and none of its noise reaches the integrator.
"""

from math import pi, sqrt

from ..layout import *
from .coefficient import sliding_coefficient


def elliptic_pair(kc2: float, w: Floats) -> None:
    """B = int cos^2/D and kc^2 times int sin^2/D, with kc^2 = 1 - k^2, into ``w[W_PAIR:]``.

    Arithmetic-geometric mean (Abramowitz & Stegun 17.6); the c_n are carried by
    c_(n+1) = c_n^2 / (4 a_(n+1)), so that nothing cancels for small k.
    """
    if kc2 <= 1e-32:
        w[W_PAIR] = 1.0
        w[W_PAIR + 1] = 0.0
    else:
        kc = sqrt(kc2)
        a = 0.5 * (1.0 + kc)
        g = sqrt(kc)
        c = (1.0 - kc) / (4.0 * a) * (1.0 + kc)  # c_1 = k^2 / (4 a_1)
        k2 = (1.0 - kc) * (1.0 + kc)
        ratio = c / (4.0 * a)  # c_n^2 / k^2, here for n = 1
        weight = 1.0
        total = ratio
        while c > 1e-17 * a:
            mean = 0.5 * (a + g)
            g = sqrt(a * g)
            a = mean
            c = c * c / (4.0 * a)
            weight = 2.0 * weight
            if k2 > 0.0:
                ratio = c * c / k2
            total += weight * ratio
        whole = pi / (2.0 * a)
        w[W_PAIR] = whole * (0.5 - total)
        w[W_PAIR + 1] = kc2 * whole * (0.5 + total)


def sine_cosine_integral(k2: float, b: float, d: float) -> float:
    """Integral of sin^2 cos^2 / D from 0 to pi/2, with b and d from `elliptic_pair`.

    (b - d) / (3 k^2) in closed form; a power series where that would cancel. The series is cut
    where the terms left out are below rounding.
    """
    if k2 > 0.05:
        return (b - d) / (3.0 * k2)
    # int sin^(2n+2) cos^2 = pi/2 (2n+1)!!/(2n+4)!!, times the binomial (2n-1)!!/(2n)!!
    term = pi / 16.0
    total = term
    n = 1.0
    while term > 1e-16 * total:
        term = term * k2 * (2.0 * n + 1.0) * (2.0 * n - 1.0) / ((2.0 * n + 4.0) * 2.0 * n)
        total += term
        n += 1.0
    return total


def disc_friction(sliding: float, spinning: float, w: Floats) -> None:
    """Force f and moment m (both per mu N, the moment also per radius) into ``w[W_PAIR:]``.

    ``sliding`` is U >= 0 and ``spinning`` is a |omega| >= 0, in m/s, not both zero.
    f lies in 0 ... 1, m in 0 ... 2/3.
    """
    if spinning == 0.0:
        w[W_PAIR] = 1.0
        w[W_PAIR + 1] = 0.0
    elif sliding >= spinning:
        k = spinning / sliding
        elliptic_pair((1.0 - k) * (1.0 + k), w)
        b = w[W_PAIR]
        d = w[W_PAIR + 1]
        w[W_PAIR] = 4.0 / pi * (2.0 * b + d) / 3.0
        w[W_PAIR + 1] = 4.0 * k / (3.0 * pi) * (b - sine_cosine_integral(k * k, b, d))
    else:
        k = sliding / spinning
        elliptic_pair((1.0 - k) * (1.0 + k), w)
        b = w[W_PAIR]
        d = w[W_PAIR + 1]
        w[W_PAIR] = 4.0 * k / pi * (2.0 * b + d) / 3.0
        w[W_PAIR + 1] = 4.0 / (9.0 * pi) * ((3.0 - k * k) * b + (3.0 - 2.0 * k * k) * d)


def add_local_law(p: Floats, u: Floats, w: Floats, sliding: float, spinning: float) -> None:
    """Add to ``w[W_PAIR:]`` what a coefficient that varies with the local speed changes.

    Integrates `local_excess` over the disc,
    in coordinates centred on the centre of rotation: the local speed is the distance from it, the
    direction of sliding the angle, and nothing is singular. Outside the disc the angles are those
    of strips along the sliding (midpoint rule in psi, y = a sin psi: Gauss-Chebyshev), inside those
    of rays; along them Gauss-Legendre. Where the spin hardly tells, a few points do.
    """
    if spinning <= p[P_FEW_POINTS] * sliding:
        add_law_at_points(p, u, w, sliding, spinning / sliding)
    elif sliding >= spinning:
        add_law_over_strips(p, u, w, sliding, spinning / sliding)
    else:
        add_law_over_rays(p, u, w, spinning, sliding / spinning)


def local_excess(p: Floats, u: Floats, w: Floats, speed: float) -> float:
    """Friction at a local sliding speed, m/s, over that of the whole contact in ``w[W_WHOLE]``."""
    mu = sliding_coefficient(p, u, w, w[W_KINETIC], speed)
    return max(0.0, mu + w[W_AGED]) - w[W_WHOLE]


def add_law_at_points(p: Floats, u: Floats, w: Floats, sliding: float, k: float) -> None:
    """The centre of rotation is far away: |u| = U |(1 - k y, k x)| is nearly uniform.

    Albrecht's twelve points of a disc, exact to the seventh degree (Stroud, Approximate Calculation
    of Multiple Integrals, 1971, S2 7-1): on the axes, and on two squares. Those at x and -x slide
    alike. Of a smooth law they leave k^8 of the force and k^7 of the moment; the corners of one
    square, exact to the third degree, which do where k is least, k^4 and k^3.
    """
    if k <= p[P_FEW_POINTS] * p[P_FEW_POINTS] * p[P_FEW_POINTS]:
        add_law_at_point(p, u, w, sliding, k, 0.5, 0.5, 0.5)
        add_law_at_point(p, u, w, sliding, k, 0.5, -0.5, 0.5)
        return
    axis = 0.5 * sqrt(3.0)
    near = sqrt((27.0 - 3.0 * sqrt(29.0)) / 104.0)
    far = sqrt((27.0 + 3.0 * sqrt(29.0)) / 104.0)
    on_axis = 2.0 / 27.0
    on_near = (551.0 + 41.0 * sqrt(29.0)) / 3132.0
    on_far = (551.0 - 41.0 * sqrt(29.0)) / 3132.0
    add_law_at_point(p, u, w, sliding, k, axis, 0.0, 2.0 * on_axis)
    add_law_at_point(p, u, w, sliding, k, 0.0, axis, on_axis)
    add_law_at_point(p, u, w, sliding, k, 0.0, -axis, on_axis)
    add_law_at_point(p, u, w, sliding, k, near, near, on_near)
    add_law_at_point(p, u, w, sliding, k, near, -near, on_near)
    add_law_at_point(p, u, w, sliding, k, far, far, on_far)
    add_law_at_point(p, u, w, sliding, k, far, -far, on_far)


def add_law_at_point(
    p: Floats, u: Floats, w: Floats, sliding: float, k: float, x: float, y: float, weight: float
) -> None:
    """What the part ``weight`` of a disc adds that slides as its point (x, y), in radii."""
    q = sqrt((1.0 - k * y) * (1.0 - k * y) + k * k * x * x)
    excess = local_excess(p, u, w, sliding * q)
    w[W_PAIR] += weight * excess * (1.0 - k * y) / q
    w[W_PAIR + 1] += weight * excess * (k * (x * x + y * y) - y) / q


def add_law_over_strips(p: Floats, u: Floats, w: Floats, sliding: float, k: float) -> None:
    """The centre of rotation lies outside: |u| = U (cos theta + k tau cos psi)."""
    force = 0.0
    moment = 0.0
    for j in range(RAYS):
        c = STRIP_COSINES[j]
        along = sqrt(max(0.0, 1.0 - k * k * STRIP_SQUARED_SINES[j]))
        for i in range(DEPTHS):
            tau = DEPTH_NODES[i]
            q = along + k * tau * c
            share = DEPTH_WEIGHTS[i] * c * c * local_excess(p, u, w, sliding * q) / RAYS
            force += share * q
            moment += share * c * tau * q / along
    w[W_PAIR] += force
    w[W_PAIR + 1] += moment


def add_law_over_rays(p: Floats, u: Floats, w: Floats, spinning: float, k: float) -> None:
    """The centre of rotation lies inside, k radii from the centre of the disc."""
    force = 0.0
    moment = 0.0
    for j in range(RAYS):
        c = RAY_COSINES[j]
        reach = k * c + sqrt(1.0 - k * k * RAY_SQUARED_SINES[j])
        for i in range(DEPTHS):
            s = 0.5 * reach * (1.0 + DEPTH_NODES[i])
            share = DEPTH_WEIGHTS[i] * reach * s * local_excess(p, u, w, spinning * s) / RAYS
            force += share * c
            moment += share * (s - k * c)
    w[W_PAIR] += force
    w[W_PAIR + 1] += moment
