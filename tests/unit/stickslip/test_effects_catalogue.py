"""The catalogue says of every effect what it is, where it enters, and what its parameters are."""

import numpy as np
import pytest
from stickslip import EFFECTS, Parameters, effects, simulate, units
from stickslip.effects.effect import AXES, Scales
from stickslip.parameters import EffectTables

from cosim.fmu import variables

EACH = pytest.mark.parametrize("effect", EFFECTS, ids=lambda effect: effect.id)


def test_one_entry_for_each_table():
    assert sorted(effect.id for effect in EFFECTS) == sorted(EffectTables.model_fields)


@EACH
def test_an_entry_is_complete(effect):
    assert effect.sentence.endswith(".") and len(effect.sentence) < 120
    assert effect.enters in {"friction", "surface", "springs", "contact"}
    assert effect.source
    assert effect.axis == "" or effect.axis in AXES
    assert effect.switch and set(effect.switch) <= set(effect.table.model_fields)


@EACH
def test_a_parameter_has_unit_words_default_and_range(effect):
    for name, field in effect.table.model_fields.items():
        extra = field.json_schema_extra
        assert extra["unit"] and field.description and field.default is not None
        if name in effect.switch:
            low, high = extra["typical"]
            assert low < high
            effect.table(**{name: low}), effect.table(**{name: high})  # typical is allowed


def test_a_unit_that_the_fmu_cannot_state_is_named(monkeypatch):
    known = {name: base for name, base in units.UNITS.items() if name != "N/m3"}
    monkeypatch.setattr(variables, "UNITS", known)
    said = "spring_hardening: cubic is in 'N/m3', a unit that stickslip/units.toml lacks"
    with pytest.raises(ValueError, match=said):
        variables.variables()


@EACH
def test_a_candidate_frees_parameters_of_its_effect_from_within_their_bounds(effect):
    candidates = list(effect.candidates(Scales(0.15, 1.0, 1.0, 10.0, 20.0, 0.02, 0.67, 6.57)))
    for free in (each for candidate in candidates for each in candidate.free_parameters):
        assert free.low < free.start < free.high and free.key.startswith(f"{effect.id}.")
    # unasked, `gap` does not try it: no campaign's answer changes by its being there
    assert effect.offered == (effect.id != "viscoelastic_peak")
    assert effect.offered or len(candidates) == 2


@EACH
def test_off_is_the_plain_model(effect):
    """Whatever the parameters that only say how an effect acts, its switches at their defaults.

    To a part of the tolerance: a memory that nothing reads is still in the test of a step's error.
    """
    others = {
        name: 2.0 * field.default if isinstance(field.default, float) else field.default + 1
        for name, field in effect.table.model_fields.items()
        if name not in effect.switch
    }
    if effect.id == "thermal_weakening":
        others["curvature"] = 0.5
    if effect.id == "rate_and_state":
        others["initial_age"] = 3.0
    planar = {"lateral_friction": {"ratio": 1.0}, "initial": {"vx": 0.15, "y": 0.005}}
    start = {} if effect.id == "lateral_friction" else planar
    plain = simulate(Parameters(**start), 2.0)
    off = simulate(Parameters(**(start | {effect.id: others})), 2.0)
    for name in ("x", "y", "phi", "heat"):
        np.testing.assert_allclose(off[name], plain[name], rtol=0, atol=1e-12)


def test_a_file_without_an_effect_and_an_effect_twice():
    with pytest.raises(ValueError, match=r"^effects/periodic.py declares no Effect named EFFECT$"):
        effects.declared(["periodic"])
    with pytest.raises(ValueError, match=r"^effect run_in: declared twice"):
        effects.declared(["friction.run_in", "friction.run_in"])
