"""What was meant by a name that does not exist."""

import pytest

from cosim.names import nearest, nearest_key, unknown_name

KEYS = ["rig.mass", "rig.spring_length", "springs.stiffness", "belt.length", "ice.length"]


@pytest.mark.parametrize(
    ("given", "meant"),
    [
        ("rig.mas", "rig.mass"),
        ("stiffness", "springs.stiffness"),  # of that name in another table
        ("ice.lenght", "ice.length"),  # of its table before any other
        ("spring.stifness", "springs.stiffness"),
        ("colour", None),
    ],
)
def test_a_key_is_looked_for_by_name_then_in_its_table_then_anywhere(given, meant):
    assert nearest_key(given, KEYS) == meant


def test_how_similar_two_names_must_be_is_the_askers_choice():
    assert nearest("run_inn", ["run_in", "film_drag"]) == "run_in"
    assert nearest("zzz", ["run_in"]) is None
    assert nearest("zzz", ["run_in"], similarity=0.0) == "run_in"


def test_where_nothing_is_near_what_there_is_is_told_up_to_a_dozen():
    assert unknown_name("port", "zzz", ["x", "heat"]) == "no port is named 'zzz'; known: heat, x"
    assert unknown_name("port", "zzz", []) == "no port is named 'zzz'; known: none"
    many = [f"p{n:02}" for n in range(20)]
    assert unknown_name("port", "zzz", many).endswith("p10, p11, ...")
