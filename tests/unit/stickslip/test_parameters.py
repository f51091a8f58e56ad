"""Every bad input is refused by a ValueError that names the key and what is allowed."""

import math
import warnings

import pytest
from stickslip import Parameters
from stickslip.kernel.layout import CURVE_LIMIT, P_PRESLIDING

# block, its values, what the message says
REFUSED = {
    "no inertia": ("rig", {"inertia": 0.0}, ["rig.inertia", "'disc' or 'ring'", "greater than 0"]),
    "centre under the block": ("rig", {"surface": "slab", "slab_radius": -0.04},
        ["slab_radius = -0.04", "above contact_radius = 0.04 m"]),
    "curve without forces": ("springs", {"force_curve_extension": [0.0, 0.1]},
        ["force_curve_extension has 2", "force_curve_force has 0", "same number"]),
    "curve too long": ("springs",
        {"force_curve_extension": [0.01 * i for i in range(CURVE_LIMIT + 1)],
         "force_curve_force": [0.1 * i for i in range(CURVE_LIMIT + 1)]},
        ["springs.force_curve_extension", "at most 16"]),
    "curve with a gap": ("springs",
        {"force_curve_extension": [0.0, math.nan], "force_curve_force": [0.0, 1.0]},
        ["force_curve_extension.1", "finite number"]),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_refused(case):
    block, values, said = REFUSED[case]
    with pytest.raises(ValueError) as refusal:
        Parameters(**{block: values})
    for words in said:
        assert words in str(refusal.value)


def test_a_creep_is_that_under_what_the_contact_holds():
    """Per load: v_c / (mu N), mu the larger of the two, with its dependence on the load."""

    def slot(**tables):
        with warnings.catch_warnings(action="ignore"):
            return Parameters(**tables).pack()[P_PRESLIDING]

    weight = 0.67 * 9.81
    for mu_s, mu_k in ((0.4, 0.2), (0.1, 0.4)):
        friction = {"mu_s": mu_s, "mu_k": mu_k, "stick_creep": 2e-3}
        assert slot(friction=friction) == pytest.approx(2e-3 / (0.4 * weight), rel=1e-14)
    grown = slot(
        friction={"mu_s": 0.4, "stick_creep": 2e-3},
        load_dependence={"exponent": 1.0, "reference_force": 2.0 * weight},
    )
    assert grown == pytest.approx(2e-3 / (0.8 * weight), rel=1e-14)
    assert slot(friction={"mu_s": 0.0, "mu_k": 0.0, "stick_creep": 2e-3}) == 0.0


def test_springs_that_push_are_told_where_the_block_can_swerve():
    with pytest.warns(UserWarning, match="unstable sideways"):
        Parameters(rig={"spring_natural_length": 0.22})
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        Parameters(rig={"spring_natural_length": 0.22, "degrees_of_freedom": ["x"]})


def test_a_curve_of_compressions_alone_ends_where_its_table_ends():
    curve = {"force_curve_extension": (-0.1, -0.07), "force_curve_force": (-1.0, 0.5)}
    flat = Parameters(springs=curve).flat()
    assert [flat[f"springs.force_curve_extension[{i}]"] for i in (1, 2, 3)] == [-0.1, -0.07, -0.07]


def test_taken_as_toml_gives_it():
    """Lists for tuples; whole numbers for floats are refused nowhere that TOML writes them."""
    taken = Parameters(rig={"mass": 1, "degrees_of_freedom": ["x"]}, springs={"stiffness": 20})
    assert taken.rig.mass == 1.0
    assert taken.flat()["rig.free_y"] == 0.0
