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

from .layout import W_PAIR


def elliptic_pair(kc2: float, w: "float[:]"):
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
    where the terms left out are below rounding: 0.05^12 < 1e-15.
    """
    if k2 > 0.05:
        return (b - d) / (3.0 * k2)
    # int sin^(2n+2) cos^2 = pi/2 (2n+1)!!/(2n+4)!!, times the binomial (2n-1)!!/(2n)!!
    term = pi / 16.0
    total = term
    for n in range(1, 13):
        term = term * k2 * (2.0 * n + 1.0) * (2.0 * n - 1.0) / ((2.0 * n + 4.0) * 2.0 * n)
        total += term
    return total


def disc_friction(sliding: float, spinning: float, w: "float[:]"):
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
