"""Belt and ice together: sharing of friction heat, passes, melting, order in the macro step."""

import numpy as np
import pytest

from thermal import Belt, BeltIceModel, Contact, Ice, ThermalParameters

#: An ice that takes next to nothing: all friction heat goes to the belt.
NO_ICE = Ice(conductivity=1e-9, heat_capacity=1e-3, air_heat_transfer=0.0)


@pytest.mark.parametrize("steps", [10, 100])
@pytest.mark.parametrize("strips", [1, 8])
def test_frictional_half_spaces(steps, strips):
    """dT = 2 q sqrt(t/pi)/(e1 + e2), shares e_i/(e1 + e2): steel on rubber, 1e4 W/m2, 1 s."""
    parameters = ThermalParameters(
        belt=Belt(length=4.0, width=2.0, thickness=5e-3, density=1100, heat_capacity=1700,
                  conductivity=0.2, air_heat_transfer=0.0, cell_length=2e-3, elements=10),
        ice=Ice(density=7836, heat_capacity=443, conductivity=48.9, air_heat_transfer=0.0),
        contact=Contact(radius=1.0, conductance=1e12, strips=strips),
    )  # fmt: skip
    model = BeltIceModel(parameters)
    for _ in range(steps):
        model.step(1.0 / steps, 1e4 * model.footprint.area / steps, 0.0)
    outputs = model.outputs()
    assert outputs["interface_temperature"] + 8.0 == pytest.approx(0.82724, rel=1e-3)
    assert outputs["ice_face_temperature"] + 8.0 == pytest.approx(0.82724, rel=1e-3)
    assert 1.0 - outputs["belt_share"] == pytest.approx(0.955166, rel=1e-3)


def mean_through_thickness(model):
    """Simpson's rule on the P2 elements, K above the air: (cells,)."""
    _, depth, temperature = model.belt_field()
    rise = temperature - model.parameters.ambient.temperature_degC
    of_elements = (rise[:, :-2:2] + 4.0 * rise[:, 1::2] + rise[:, 2::2]) / 6.0
    return of_elements @ np.diff(depth[::2]) / depth[-1]


@pytest.mark.parametrize("speed", [0.15, 0.82, -0.5])
@pytest.mark.parametrize("macro_step", [0.01, 0.3])
def test_one_pass_heats_the_belt_by_force_over_capacity(speed, macro_step):
    """F/(c m') behind the contact, whatever the speed: 0.0914 K at 4.03 N."""
    force, travel = 4.03, 0.6
    model = BeltIceModel(ThermalParameters(belt=Belt(air_heat_transfer=0.0), ice=NO_ICE))
    done = 0.0
    while done < travel:
        part = min(abs(speed) * macro_step, travel - done)
        model.step(part / abs(speed), force * part, np.copysign(part, speed))
        done += part
    behind = (model.contact_position + np.sign(speed) * 0.3) % 1.0
    rise = mean_through_thickness(model)[round(behind / model.belt.cell)]
    assert rise == pytest.approx(force / (840.0 * 0.0525), rel=2e-5)
    assert model.outputs()["belt_share"] == pytest.approx(1.0, abs=1e-6)


def ice_only(flux, macro_step, steps):
    """All heat into the ice: a belt that takes next to nothing."""
    nothing = {"conductivity": 1e-9, "density": 1e-3, "air_heat_transfer": 0.0}
    belt = Belt(width=0.08, cell_length=0.02, **nothing)
    ice = Ice(air_heat_transfer=0.0, axial_elements=14, radial_elements=1)
    model = BeltIceModel(ThermalParameters(belt=belt, ice=ice))
    for _ in range(steps):
        model.step(macro_step, flux * model.footprint.area * macro_step, 0.0)
        yield model.outputs()


def test_melting_starts_when_the_face_reaches_the_melting_point():
    """2 q sqrt(t/pi)/e = 8 K: t = pi (4 e/q)^2, 83 ms at 5e4 W/m2."""
    effusivity = np.sqrt(2.2 * 917.0 * 2050.0)
    flux, macro_step = 5e4, 2e-4
    onset = np.pi * (4.0 * effusivity / flux) ** 2
    parts = list(ice_only(flux, macro_step, round(1.3 * onset / macro_step)))
    first = next(n for n, outputs in enumerate(parts) if outputs["melt_rate"] > 0.0)
    assert macro_step * (first + 0.5) == pytest.approx(onset, rel=5e-3)
    assert all(outputs["melt_rate"] == 0.0 for outputs in parts[:first])
    for outputs in parts[first:]:
        assert outputs["ice_face_temperature"] == pytest.approx(0.0, abs=1e-10)
        assert outputs["melt_rate"] > 0.0
    melted = macro_step * sum(outputs["melt_rate"] for outputs in parts)
    assert parts[-1]["melted_mass"] == pytest.approx(melted, rel=1e-10)
    assert parts[-1]["latent_heat"] == pytest.approx(334e3 * melted, rel=1e-10)
    assert abs(parts[-1]["heat_residual"]) < 1e-10 * parts[-1]["heat_received"]
