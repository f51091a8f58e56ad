"""From named parameters to the kernel's vector, and parameters that contradict each other."""

import ast
import random
import re
import warnings
from collections import Counter

import numpy as np
import pytest
from contradictory import CONTRADICTIONS, CURVE, MU, TABLE, places
from effect_cases import IDS, draw_parameters
from stickslip import EFFECTS, Parameters
from stickslip import contradictions as words
from stickslip.catalogue import CATALOGUE
from stickslip.draws import draws
from stickslip.generation.source import kernel_source
from stickslip.kernel import layout, tables
from stickslip.kernel.packing import contradictions
from stickslip.kernel.packing.vector import pack as pack_in_order
from stickslip.names import NAMES
from stickslip.packing import in_order, pack

OFF = Parameters().flat()
ALL = {
    "seed": 5, "mass": 0.01, "spring_stiffness": 0.02, "anchor_position": 1e-3,
    "start_position": 1e-3, "start_angle_deg": 1.0,
}  # fmt: skip


def test_the_values_stand_in_the_order_of_the_fmu_s_parameters():
    assert list(NAMES) == list(OFF)
    assert in_order(OFF) == list(OFF.values())
    for name, size in tables.values(EFFECTS):
        at = getattr(layout, f"V_{name}".replace(".", "_").upper())
        assert [name] * size == [each.partition("[")[0] for each in NAMES[at : at + size]]


def test_the_draws_are_those_of_python_s_generator():
    """Each seed its own, uncut; the field on the surface in pairs of deviate and turn."""
    v = in_order(Parameters(imperfections={"seed": 3}, surface_scatter={"seed": 8}).flat())
    rig, field = random.Random(3), random.Random(8)
    pairs = [(field.gauss(0.0, 1.0), field.random()) for _ in range(16)]
    own = [rig.gauss(0.0, 1.0) for _ in range(16)]
    assert draws(v) == own + [number for pair in pairs for number in pair]
    assert len(draws(v)) == layout.D_SIZE == layout.D_SURFACE_SCATTER + 32
    assert (layout.D_MASS, layout.D_START_ANGLE) == (0, 15)


def test_a_departure_is_cut_at_three_deviations():
    values = Parameters(imperfections=ALL).flat()
    v, p = in_order(values), [0.0] * layout.P_SIZE
    for far, near in ((7.0, 3.0), (-7.0, -3.0)):
        packed = []
        for drawn in (far, near):
            pack_in_order(v, [drawn] * layout.D_SIZE, p)
            packed.append(p.copy())
        assert packed[0][layout.P_MASS] == pytest.approx(0.67 * (1.0 + 0.01 * near), rel=1e-15)
        at = layout.P_SURFACE_SCATTER_WAVENUMBER  # which is not cut
        assert packed[0][: at - 1] == packed[1][: at - 1] and packed[0][at] != packed[1][at]


def packed(**imperfections):
    return np.array(Parameters(imperfections=imperfections).pack())


def test_off_a_rig_is_the_drawing_whatever_the_seed():
    assert np.array_equal(packed(), packed(seed=7))
    relative = packed()[layout.P_RELATIVE_STIFFNESS : layout.P_RELATIVE_STIFFNESS + 4]
    assert relative.tolist() == [1.0] * 4


SLOTS = {
    "mass": layout.P_MASS, "spring_stiffness": layout.P_RELATIVE_STIFFNESS,
    "anchor_position": layout.P_ANCHOR, "start_position": layout.P_INITIAL,
    "start_angle_deg": layout.P_INITIAL + 2,
}  # fmt: skip


@pytest.mark.parametrize("key", SLOTS)
def test_each_departure_is_drawn_by_itself(key):
    """Switching another on does not change it."""
    alone, all_of_them = packed(seed=5, **{key: ALL[key]}), packed(**ALL)
    assert SLOTS[key] in np.flatnonzero(alone != packed())
    assert alone[SLOTS[key]] == all_of_them[SLOTS[key]]


def test_over_many_rigs_departures_have_the_deviation_that_was_asked_for():
    """Of 4000 draws, cut at three deviations: known to 4 % with near certainty."""
    at = layout.P_RELATIVE_STIFFNESS
    springs = np.array([packed(seed=s, spring_stiffness=0.02)[at : at + 4] for s in range(1000)])
    assert springs.std() == pytest.approx(0.02, rel=0.04)
    assert abs(springs.mean() - 1.0) < 0.02 * 4.0 / np.sqrt(springs.size)
    assert np.abs(springs - 1.0).max() <= 0.06 + 1e-15


def cases(count):
    """Of all effects, with tables, curves and imperfections now and then."""
    draw = random.Random("packing")
    while count:
        more = {"imperfections": ALL} if draw.random() < 0.5 else {}
        on = tuple(draw.sample(IDS, draw.choice([0, 1, 3, 5])))
        tables = draw_parameters(on, draw, **more).model_dump(exclude_defaults=True)
        points = draw.choice([2, 3, 7, 16])
        if draw.random() < 0.5:
            tables["springs"] |= {
                "force_curve_extension": [0.01 * i - 0.03 + 0.002 * i**2 for i in range(points)],
                "force_curve_force": [0.3 * (i - i % 3) for i in range(points)],
            }
        if draw.random() < 0.5:
            tables["friction"] |= {
                "table_speed": [0.01 * i + 0.002 * i**2 for i in range(points)],
                "table_mu": [draw.uniform(0.1, 0.3) for _ in range(points)],
            }
        if "table_mu" in tables["friction"] and draw.random() < 0.5:
            tables["friction"] |= {
                "table_temperature_degC": [-12.0, -7.0, -1.0],
                "table_mu": [draw.uniform(0.1, 0.3) for _ in range(3 * points)],
            }
        tables["friction"]["transition_speed"] = 3e-3
        tables["friction"]["presliding_distance"] = draw.choice([0.0, 5e-5])
        try:
            yield Parameters(**tables).flat()
        except ValueError:  # two laws of one thing
            continue
        count -= 1


def test_compiled_and_interpreted_make_the_same_vector():
    kernel = CATALOGUE.compiled
    with warnings.catch_warnings(action="ignore"):
        for values in cases(40):
            v = np.array(in_order(values))
            p = np.full(layout.P_SIZE, 99.0)  # what was there does not matter
            kernel.pack(v, np.array(draws(v)), p)
            assert p.tolist() == pack(values)
            assert kernel.contradiction(v) == contradictions.NO_CONTRADICTION


def test_a_contact_without_friction_has_no_bristles():
    bristles = {"transition_speed": 3e-3, "presliding_distance": 5e-5}
    p = Parameters(friction={"mu_s": 0.0, "mu_k": 0.0, **bristles}).pack()
    assert p[layout.P_BRISTLE_STIFFNESS] == p[layout.P_PRESLIDING] == 0.0


def test_the_joined_text_gives_no_name_to_two_things():
    """Of two functions of one name the last would be called, in all files."""
    body = ast.parse(kernel_source()).body
    names = [node.name for node in body if isinstance(node, ast.FunctionDef)]
    names += [node.targets[0].id for node in body if isinstance(node, ast.Assign)]
    assert [name for name, times in Counter(names).items() if times > 1] == []


@pytest.mark.parametrize("code", CONTRADICTIONS)
def test_a_contradiction_is_known_by_its_values(code):
    for given, said in CONTRADICTIONS[code]:
        values = OFF | given
        assert given.keys() <= OFF.keys()
        assert contradictions.contradiction(in_order(values)) == getattr(contradictions, code)
        assert said in words.contradiction(values)


def test_every_contradiction_is_said_and_names_parameters_that_there_are():
    codes = {
        name: number
        for name, number in vars(contradictions).items()
        if name.isupper() and isinstance(number, int) and name not in vars(layout)
    }
    assert CONTRADICTIONS.keys() == codes.keys() - {"NO_CONTRADICTION"}
    assert sorted(codes.values()) == sorted(words.SAID) == list(range(len(codes)))
    for said in words.SAID.values():
        named = re.findall(r"\{(.*?)\}", said)
        assert all(each.removesuffix(":g") in OFF and each.endswith(":g") for each in named)


@pytest.mark.parametrize(
    "given",
    [
        {**CURVE, **places("springs.force_curve_force", 0.0, 1.0, 2.0)},  # then zeros
        {
            **places("springs.force_curve_extension", -0.2, *[-0.1] * 15),
            **places("springs.force_curve_force", -1.0, *[-0.5] * 15),
        },
        {**TABLE, **MU},
        {**TABLE, **places("friction.table_mu", 0.3, *[0.2] * 15)},
        {**TABLE, **places("friction.table_mu", 0.3, *[0.2] * 95)},
        {
            **TABLE,
            **places("friction.table_mu", *[0.2] * 6),
            **places("friction.table_temperature_degC", -9.0, *[-8.0] * 5),
        },
        {"speed_ripple.amplitude": 1.0, "speed_ripple.frequency": 100.0},
        {"speed_ripple.amplitude": 0.9, "speed_ripple.frequency": 500.0},
        {"rig.spring_natural_length": 0.4},
        {"rig.free_y": 0, "initial.y": 0.01, "initial.omega": 1.0},
        {"turning_surface.curvature": 20.0, "rig.contact_radius": 0.049},
    ],
)
def test_what_can_stand_side_by_side_does(given):
    assert words.contradiction(OFF | given) == ""
