"""The kernel's arrays: no two slots overlap, none is left over, the sizes fit what stands there."""

from importlib import resources

import numpy as np
import pytest
from kernel_stubs import stubs
from stickslip import EFFECTS, Parameters
from stickslip.kernel import layout, tables


def test_the_tables_are_those_of_the_methods():
    """Each row of stages is whole: its sum is its node."""
    stages = layout.ALL_STAGES
    rows = np.reshape(layout.STAGE_WEIGHTS, (stages, stages))
    np.testing.assert_allclose(rows.sum(axis=1), layout.NODES, atol=1e-14)
    assert np.all(np.triu(rows) == 0.0)
    nodes, weights = np.polynomial.legendre.leggauss(layout.DEPTHS)
    given = np.array([layout.DEPTH_NODES, layout.DEPTH_WEIGHTS])
    np.testing.assert_allclose(given[:, np.argsort(given[0])], [nodes, weights], rtol=1e-14)
    for name, whole in (("STRIP", np.pi / 2.0), ("RAY", np.pi)):
        angles = (np.arange(layout.RAYS) + 0.5) * whole / layout.RAYS
        about = [getattr(layout, f"{name}_{of}") for of in ("COSINES", "SQUARED_SINES")]
        np.testing.assert_allclose(about, [np.cos(angles), np.sin(angles) ** 2], atol=1e-15)


def test_two_numbers_of_one_name_are_refused():
    twice = [EFFECTS[3], EFFECTS[3]]
    with pytest.raises(ValueError, match="two numbers of the kernel are called V_"):
        tables.constants(twice)


def test_every_parameter_of_an_effect_reaches_the_vector():
    """Changing any of them, its effect on, changes ``p``."""
    for effect in EFFECTS:
        on = {name: effect.table.model_fields[name].default for name in effect.switch}
        for name in effect.switch:
            on[name] += 0.125 if effect.id != "stick_stiffness" else -0.125
        for name, field in effect.table.model_fields.items():
            value = on.get(name, field.default)
            changed = value + 1 if isinstance(value, int) else 0.75 * value + 0.03125 * (value == 0)
            harmonic = name.replace("_phase_deg", "_amplitude")  # whose phase is felt with it
            given = on | ({harmonic: 0.5} if harmonic != name else {})
            plain, other = (
                Parameters(**{effect.id: some}).pack() for some in (given, given | {name: changed})
            )
            assert other != plain, f"{effect.id}.{name}"


@pytest.mark.parametrize("file", stubs())
def test_the_type_checker_knows_the_numbers_and_terms_that_there_are(file):
    """A name that is none, as P_MASSS, is an error of mypy: also an effect's that has gone."""
    written = (resources.files("stickslip.kernel") / file).read_text(encoding="utf-8")
    assert written == stubs()[file], "tests/helpers/models/kernel_stubs.py writes them anew"
