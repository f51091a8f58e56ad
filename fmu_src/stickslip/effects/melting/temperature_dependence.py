"""Friction falls linearly as the interface warms, up to the melting point.

McCarthy et al. (2017) on ice against rock; mu_k and mu_s each by their own slope a: times
1 - a (T - T_0).
"""

from ...quantity import Table, quantity
from ..effect import Case, Effect


class TemperatureDependence(Table):
    """Friction falls linearly as the interface warms, up to the melting point (0 degC).

    Ice on rock, 0.52 at -20 degC to 0.02 at melting: mu_k = 0.52, reference_degC = -20,
    sensitivity = (1 - 0.02 / 0.52) / 20.

    sensitivity : part of mu_k lost per kelvin above reference_degC
    static_sensitivity : part of mu_s lost per kelvin above reference_degC
    reference_degC : interface temperature at which mu_k and mu_s hold
    """

    sensitivity: float = quantity(0.0, "1/K", ge=0, typical=(0.01, 0.12))
    static_sensitivity: float = quantity(0.0, "1/K", ge=0, typical=(0.01, 0.12))
    reference_degC: float = quantity(-8.0, "degC", ge=-273.15, le=0, tried=(-20.0, -1.0))


def kinetic_temperature_factor(
    temperature: float, sensitivity: float, reference_degC: float
) -> float:
    """mu_k over its value at the reference temperature."""
    return 1.0 - sensitivity * (temperature - reference_degC)


def static_temperature_factor(
    temperature: float, static_sensitivity: float, reference_degC: float
) -> float:
    """mu_s over its value at the reference temperature."""
    return max(0.0, 1.0 - static_sensitivity * (temperature - reference_degC))


EFFECT = Effect(
    id="temperature_dependence",
    table=TemperatureDependence,
    switch=("sensitivity", "static_sensitivity"),
    enters="friction",
    source="ice on rock, linear to the melting point: McCarthy et al. (2017)",
    terms=(kinetic_temperature_factor, static_temperature_factor),
    feels_melting=("sensitivity",),
    case=Case({"sensitivity": 0.125, "reference_degC": -8.0}, warmer=3.0),
)
