"""What a table of parameters says of its fields."""

import pytest
from stickslip.quantity import Table, details, quantity


class Rope(Table):
    """A rope that is pulled.

    It has no mass.

    length : of the rope
    stiffness : force per extension; as it is near the load that
        the rope bears
    """

    length: float = quantity(1.0, "m", gt=0)
    stiffness: float = quantity(20.0, "N/m", typical=(10.0, 30.0))
    colour: str = quantity("red", None, "told here")


def test_fields_are_described_by_the_docstring_and_readers_get_what_stands_before():
    said = {name: field.description for name, field in Rope.model_fields.items()}
    assert said == {
        "length": "of the rope",
        "stiffness": "force per extension; as it is near the load that the rope bears",
        "colour": "told here",
    }
    assert Rope.__doc__ == "A rope that is pulled.\n\nIt has no mass."
    assert Rope.model_json_schema()["properties"]["length"]["description"] == "of the rope"
    assert details(Rope.model_fields["stiffness"]) == {"unit": "N/m", "typical": (10.0, 30.0)}
    with pytest.raises(ValueError, match="greater than 0"):
        Rope(length=0.0)


def test_a_field_that_nobody_describes_is_refused():
    with pytest.raises(TypeError, match="Chain: the docstring does not say what length is"):

        class Chain(Table):
            """A chain."""

            length: float = quantity(1.0, "m")
