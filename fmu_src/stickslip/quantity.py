"""A checked table of parameters, the element that scenarios and FMU parameters are made of."""

import re
from functools import partial
from inspect import cleandoc
from typing import Any, ClassVar

from pydantic import BaseModel, ConfigDict, Field
from pydantic.fields import FieldInfo

_OF_PYDANTIC = frozenset(dir(BaseModel))
#: A line of a docstring that says what a field is, and those that go on with it.
_SAID = re.compile(r"^(\w+) : (.*(?:\n    .*)*)", re.MULTILINE)


class Table(BaseModel):
    """A table of parameters: unknown keys, NaN and infinities are refused; nothing changes later.

    A table that takes what TOML or JSON give for a tuple sets ``strict=False`` for itself. What its
    fields are it says at the end of its docstring, a line ``name : words`` each; who asks for the
    docstring gets what stands before.
    """

    model_config: ClassVar[ConfigDict] = ConfigDict(
        extra="forbid", frozen=True, allow_inf_nan=False, strict=True
    )

    def __init_subclass__(cls, **options: Any) -> None:
        """Give the fields the descriptions that the docstring has for them."""
        super().__init_subclass__(**options)
        text = cleandoc(vars(cls).get("__doc__") or "")
        said = {name: " ".join(words.split()) for name, words in _SAID.findall(text)}
        waiting = {name: each for name, each in vars(cls).items() if isinstance(each, partial)}
        for name, field in waiting.items():
            if name not in said:
                raise TypeError(f"{cls.__name__}: the docstring does not say what {name} is")
            setattr(cls, name, field(description=said[name]))
        if waiting:
            cls.__doc__ = _SAID.split(text)[0].rstrip()

    def __setattr__(self, name: str, value: Any) -> None:
        """Refuse a field, and say how another value is given."""
        if name in type(self).model_fields:
            raise AttributeError(
                f"{type(self).__name__}.{name}: does not change in place; a changed copy of a"
                " scenario is scenario.changed(surface_speed=0.2)"
            )
        super().__setattr__(name, value)

    def __dir__(self) -> list[str]:
        """Its own names: what pydantic has beside them is not for whoever looks for a key."""
        return [name for name in super().__dir__() if name not in _OF_PYDANTIC]


def quantity(
    default: Any,
    unit: str | None,
    description: str | None = None,
    typical: tuple[float, float] | None = None,
    tried: tuple[float, float] | None = None,
    **bounds: Any,
) -> Any:
    """A field with unit (`1` for a number without, None for what is no number) and description.

    Parameters
    ----------
    default : the value, or ``...`` where one must be given
    unit : of the value, as the FMU spells it
    description : what a reader of the schema is told; left out, what the table's docstring says
    typical : range in which an effect shows in a rig of this kind, for whoever looks for it
    tried : range that tests draw from, of a parameter that says where or how an effect acts and has
        no size of its own
    bounds : pydantic's gt, ge, lt, le, and whatever else it knows of a field
    """
    noted = {"unit": unit, "typical": typical, "tried": tried}
    extra = {key: value for key, value in noted.items() if value is not None} or None
    field = partial(Field, default, json_schema_extra=extra, **bounds)
    return field if description is None else field(description=description)


def details(field: FieldInfo) -> dict[str, Any]:
    """What `quantity` has noted of a field beside its description: unit, typical, tried."""
    extra = field.json_schema_extra
    return extra if isinstance(extra, dict) else {}
