"""Friction coefficients: how mu_s and mu_k depend on place, time, heat, distance, speed, water."""

from math import cos, exp, log, log10, sqrt

from .layout import (
    AGE,
    DISTANCE,
    HOLD_SINCE,
    MODE,
    P_ASPERITY,
    P_COUETTE,
    P_CREEP_SPEED,
    P_DIRECT,
    P_EVOLUTION,
    P_FILM_ROOT,
    P_FLOODED,
    P_HOLD_TIME,
    P_HYPERBOLIC,
    P_INVERSE_ROOT,
    P_LINEAR,
    P_MELT_FILM,
    P_MU_K,
    P_MU_S,
    P_NORMAL_FORCE,
    P_PATTERN,
    P_PATTERN_PHASE,
    P_PATTERN_SECOND,
    P_PATTERN_SECOND_PHASE,
    P_PATTERN_WAVENUMBER,
    P_REFERENCE,
    P_ROUGHNESS,
    P_RUN_IN,
    P_RUN_IN_DISTANCE,
    P_SATURATING,
    P_SATURATION_TIME,
    P_SCATTER,
    P_SCATTER_WAVES,
    P_SENSITIVITY,
    P_STATE_DISTANCE,
    P_STATE_SPEED,
    P_STATIC_SENSITIVITY,
    P_STRENGTHENING,
    P_STRIBECK,
    P_STRIBECK_SPEED,
    P_WEAKENING,
    P_WEAKENING_CURVATURE,
    STICK,
    TIME,
    TRAVEL,
    U_FILM,
    U_TEMPERATURE,
    W_STATE,
    WARMTH,
    WAVES,
    X,
)

MELTING_POINT = 0.0  # of ice, degC
FINEST_COLD = 1e-12  # K; a temperature this near to melting is there, but for rounding


def surface_factor(p: "float[:]", w: "float[:]") -> float:
    """Friction of the place on the surface under the block, relative to the surface's mean.

    The place is x less the way of the surface. A periodic pattern, with its second harmonic or
    without (surface_pattern), and a random field of standard deviation sigma (surface_scatter), a
    sum of waves with random wavenumber and phase: it belongs to the place, so a place met again
    has the same friction.
    """
    factor = 1.0
    place = w[W_STATE + X] - w[W_STATE + TRAVEL]
    if p[P_PATTERN] != 0.0:
        angle = p[P_PATTERN_WAVENUMBER] * place + p[P_PATTERN_PHASE]
        wave = cos(angle)
        if p[P_PATTERN_SECOND] != 0.0:
            wave += p[P_PATTERN_SECOND] * cos(2.0 * angle + p[P_PATTERN_SECOND_PHASE])
        factor += p[P_PATTERN] * wave
    if p[P_SCATTER] != 0.0:
        total = 0.0
        for i in range(WAVES):
            total += cos(p[P_SCATTER_WAVES + 2 * i] * place + p[P_SCATTER_WAVES + 2 * i + 1])
        factor += p[P_SCATTER] * sqrt(2.0 / WAVES) * total
    return max(0.0, factor)


def ice_temperature(u: "float[:]") -> float:
    """Interface temperature, degC, at most that of melting ice."""
    return min(u[U_TEMPERATURE], MELTING_POINT)


def feels_temperature(p: "float[:]") -> bool:
    """Does the interface temperature matter to friction?"""
    linear = p[P_SENSITIVITY] != 0.0 or p[P_STATIC_SENSITIVITY] != 0.0
    return linear or p[P_ASPERITY] != 0.0


def is_felt(p: "float[:]", i: int) -> bool:
    """Does input i of ``u`` matter to the motion?"""
    if i == U_TEMPERATURE:
        return feels_temperature(p)
    if i == U_FILM:
        return p[P_FLOODED] != 0.0
    return True


def flooded_share(p: "float[:]", u: "float[:]") -> float:
    """Part of the contact that water fills, and with it of the load that it bears.

    Water of the mean thickness h first fills the valleys of a surface of roughness s, and all
    that it can fill (f) once it is much thicker: f h / (h + s), mixed_lubrication.
    """
    if p[P_FLOODED] == 0.0 or u[U_FILM] <= 0.0:
        return 0.0
    return p[P_FLOODED] * u[U_FILM] / (u[U_FILM] + p[P_ROUGHNESS])


def dry_share(p: "float[:]", u: "float[:]") -> float:
    """Part of the load that the solid contact bears."""
    return 1.0 - flooded_share(p, u)


def warm_factor(loss: float, curvature: float) -> float:
    """What is left of mu_k: (1 + c loss)^(-1/c); c = -1 is linear, 0 exponential, 1 hyperbolic."""
    if curvature == 0.0:
        return exp(-loss)
    left = 1.0 + curvature * loss
    return left ** (-1.0 / curvature) if left > 0.0 else 0.0


def kinetic_coefficient(p: "float[:]", u: "float[:]", w: "float[:]") -> float:
    """mu_k before any dependence on the sliding speed, at the moment in ``w[W_STATE:]``.

    Linear in the interface temperature up to the melting point (0 degC, temperature_dependence),
    falling with the recent heat (thermal_weakening), approaching a final value with the distance
    slid (run_in).
    """
    mu = p[P_MU_K] * surface_factor(p, w)
    mu *= 1.0 - p[P_SENSITIVITY] * (ice_temperature(u) - p[P_REFERENCE])
    if p[P_WEAKENING] != 0.0:
        mu *= warm_factor(p[P_WEAKENING] * w[W_STATE + WARMTH], p[P_WEAKENING_CURVATURE])
    if p[P_RUN_IN] != 0.0:
        mu *= 1.0 + p[P_RUN_IN] * (1.0 - exp(-w[W_STATE + DISTANCE] / p[P_RUN_IN_DISTANCE]))
    return max(0.0, mu)


def has_state_law(p: "float[:]") -> bool:
    """Is rate_and_state on?"""
    return p[P_DIRECT] != 0.0 or p[P_EVOLUTION] != 0.0


def rate_and_state(p: "float[:]", age: float, speed: float) -> float:
    """What speed and age of the contact add to mu_k: a ln(v / v*) + b ln(v* theta / D).

    Dieterich (1979) with the ageing law theta' = 1 - v theta / D. With the creep speed v_c,
    sqrt(v^2 + v_c^2) stands for v: the law has a value at rest, which is also what a contact at
    rest holds, and is smooth on the way there. (Cut off at v_c instead, it has an edge on which a
    slowly loaded slip stays, and no step across an edge passes the error test.)
    """
    creep = p[P_CREEP_SPEED]
    v = sqrt(speed * speed + creep * creep) / p[P_STATE_SPEED]
    aged = max(age, 1e-12) * p[P_STATE_SPEED] / p[P_STATE_DISTANCE]
    return p[P_DIRECT] * log(v) + p[P_EVOLUTION] * log(aged)


def ageing_rate(p: "float[:]", age: float, speed: float) -> float:
    """Rate of the contact's age: 1 at rest, 1 - v theta / D in sliding; 0 where the law is off."""
    if not has_state_law(p):
        return 0.0
    return 1.0 - speed * age / p[P_STATE_DISTANCE]


def melting_coefficient(p: "float[:]", u: "float[:]", dry: float, speed: float) -> float:
    """Friction that melts asperities and shears a film of melt; the dry value at speed 0.

    The path dry -> boundary -> mixed -> hydrodynamic as the speed v grows. Boundary: an asperity of
    length l and hardness H is warmed to melting as it passes, so it takes no more than
    mu_a = C e (T_m - T) / (H sqrt(l v)) (asperity_melting). Hydrodynamic: the whole load on a
    film that the shear itself melts, mu_f = sqrt(2 eta v rho L / l) / p (melt_film). The regimes
    blend as in Churchill & Usagi, AIChE J. 18 (1972), exponent 2, which is smooth down to v = 0:
    1 / mu_b^2 = 1 / mu_dry^2 + 1 / mu_a^2, mu^2 = mu_b^2 + mu_f^2.
    """
    mu = dry
    if p[P_ASPERITY] != 0.0:
        cold = MELTING_POINT - ice_temperature(u)
        mu = 0.0  # melting ice has no dry friction, not even at rest
        if cold > FINEST_COLD:
            mu = dry * cold / sqrt(cold * cold + p[P_ASPERITY] * dry * dry * speed)
    if p[P_MELT_FILM] != 0.0:
        mu = sqrt(mu * mu + p[P_MELT_FILM] * speed)
    return mu


def local_coefficient(p: "float[:]", u: "float[:]", mu: float, speed: float) -> float:
    """mu_k at a local sliding speed (m/s), where ``mu`` is the value without that dependence.

    velocity_weakening: linear, hyperbolic 1/(1 + delta v), inverse root 1/sqrt(1 + c v), Stribeck
    peak; then asperity_melting and melt_film (`melting_coefficient`); film_drag: a film whose shear
    grows with the root of the speed. Where water floods a share w of the contact
    (mixed_lubrication) all that holds for the rest; the water, h / w thick there, is sheared in
    Couette flow, eta v w / h on the share w.
    """
    factor = max(0.0, 1.0 - p[P_LINEAR] * speed) / (1.0 + p[P_HYPERBOLIC] * speed)
    if p[P_INVERSE_ROOT] != 0.0:
        factor /= sqrt(1.0 + p[P_INVERSE_ROOT] * speed)
    if p[P_STRIBECK] != 0.0:
        factor += p[P_STRIBECK] * exp(-speed / p[P_STRIBECK_SPEED])
    mu = melting_coefficient(p, u, mu * factor, speed)
    if p[P_FILM_ROOT] != 0.0:
        mu += p[P_FILM_ROOT] * sqrt(speed) / p[P_NORMAL_FORCE]
    flooded = flooded_share(p, u)
    if flooded != 0.0:
        mu = (1.0 - flooded) * mu + flooded * flooded / u[U_FILM] * p[P_COUETTE] * speed
    return mu


def slow_coefficient(p: "float[:]", u: "float[:]", w: "float[:]", speed: float) -> float:
    """mu_k of a slip whose speed (m/s) is small to every law but rate_and_state."""
    mu = local_coefficient(p, u, kinetic_coefficient(p, u, w), 0.0)
    if has_state_law(p):
        mu = max(0.0, mu + dry_share(p, u) * rate_and_state(p, w[W_STATE + AGE], speed))
    return mu


def onset_coefficient(p: "float[:]", u: "float[:]", w: "float[:]") -> float:
    """mu_k at the first instant of a slip."""
    return slow_coefficient(p, u, w, 0.0)


def strengthening(p: "float[:]", hold: float) -> float:
    """What ``hold`` seconds at rest add to mu_s: so much a decade, or so much in the end."""
    growth = 0.0
    if p[P_STRENGTHENING] != 0.0:
        growth += p[P_STRENGTHENING] * log10(1.0 + hold / p[P_HOLD_TIME])
    if p[P_SATURATING] != 0.0:
        growth += p[P_SATURATING] * (1.0 - exp(-hold / p[P_SATURATION_TIME]))
    return growth


def holding_coefficient(p: "float[:]", u: "float[:]", w: "float[:]") -> float:
    """Coefficient that a contact at rest can hold: mu_s, or mu_k where that is larger.

    mu_s grows with the time at rest (static_strengthening). With
    mu_k > mu_s a block that breaks away at mu_s is stopped at once; at rest it therefore holds up
    to mu_k. With rate_and_state the age of the contact says what it holds, and mu_s is not used.
    Water holds nothing at rest.
    """
    onset = onset_coefficient(p, u, w)
    if has_state_law(p):
        return onset
    mu = p[P_MU_S] * surface_factor(p, w)
    mu *= max(0.0, 1.0 - p[P_STATIC_SENSITIVITY] * (ice_temperature(u) - p[P_REFERENCE]))
    if w[W_STATE + MODE] == STICK:
        mu += strengthening(p, max(0.0, w[W_STATE + TIME] - w[W_STATE + HOLD_SINCE]))
    return max(dry_share(p, u) * mu, onset)
