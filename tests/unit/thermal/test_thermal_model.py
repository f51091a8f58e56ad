import math

import numpy as np
import pytest

from thermal import Belt, BeltIceModel, Contact, ThermalParameters, rig_view

COARSE = ThermalParameters(belt=Belt(cell_length=4e-3))


def test_starts_at_the_temperature_of_the_air():
    outputs = BeltIceModel().outputs()
    assert len(outputs) == 19
    for name, value in outputs.items():
        assert type(value) is float
        assert value == (-8.0 if name.endswith("temperature") else 0.0)


@pytest.mark.parametrize("duration", [1e-5, 1e-2, 1.0, 1e3])
@pytest.mark.parametrize("conductance", [1e-3, 1e4, 1e12])
def test_stable_for_any_step_and_conductance(duration, conductance):
    """After heating stops, no temperature may rise above what it was, nor fall below the air."""
    model = BeltIceModel(
        ThermalParameters(belt=Belt(cell_length=4e-3), contact=Contact(conductance=conductance))
    )
    model.step(duration, 0.01 * duration, 0.3)
    hottest = max(model.belt_profile()[1].max(), rig_view(model).ice.max())
    for _ in range(60):
        model.step(duration, 0.0, 0.0)
    for temperature in (model.belt_profile()[1], rig_view(model).ice):
        assert temperature.max() <= hottest
        assert temperature.min() >= -8.0 - 0.05 * (hottest + 8.0)


def test_state_of_another_mesh_is_refused():
    with pytest.raises(ValueError, match="another mesh"):
        BeltIceModel(COARSE).restore(BeltIceModel().state())


@pytest.mark.parametrize(("step", "says"), [
    ((0.0, 0.1, 0.1), r"duration = 0 s must be positive"),
    ((-1.0, 0.1, 0.1), "duration = -1 s"),
    ((0.1, -0.1, 0.1), r"heat = -0\.1 J"),
    ((math.nan, 0.1, 0.1), "duration = nan"),
    ((0.1, math.inf, 0.1), "heat = inf"),
    ((0.1, 0.1, math.nan), "displacement = nan"),
    ((0.1, 0.1, -1e6), "more than 1000 loops"),
])  # fmt: skip
def test_bad_steps_are_refused_and_leave_the_state(step, says):
    model = BeltIceModel(COARSE)
    before = model.state()
    with pytest.raises(ValueError, match=says):
        model.step(*step)
    assert np.array_equal(model.state(), before)


def test_fields_have_the_shapes_they_state():
    model = BeltIceModel(COARSE)
    model.step(0.1, 0.5, 0.01)
    position, depth, belt = model.belt_field()
    assert belt.shape == (position.size, depth.size) == (250, 13)
    assert belt[:, 0] == pytest.approx(model.belt_profile()[1], abs=1e-12)
    assert depth[0] == 0.0 and depth[-1] == pytest.approx(1e-3)
    view = rig_view(model)
    assert view.ice.shape == (view.x.size, view.height.size)
    assert view.ice[:, 0].max() == view.ice.max()
    assert view.ice[view.x.size // 2, -1] == pytest.approx(-8.0, abs=1e-6)
