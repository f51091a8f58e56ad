"""Values given to an FMU before it starts, checked against what it declares."""

import math
from collections.abc import Mapping
from numbers import Real

from fmpy.model_description import ModelVariable

from cosim.coupling.errors import FmuError
from cosim.names import unknown_name

Setting = float | int | bool | str


def check_settings(
    fmu_name: str,
    variables: Mapping[str, ModelVariable],
    settings: Mapping[str, Setting],
    causality: str,
) -> None:
    """Every name is a variable of the causality, every value has its type and range.

    causality: "parameter" or "input". Raises FmuError with the nearest name or the range.
    """
    known = [name for name, variable in variables.items() if variable.causality == causality]
    for name, value in settings.items():
        variable = variables.get(name)
        if variable is None:
            raise FmuError(unknown_name(f"{causality} of {fmu_name}", name, known))
        if variable.causality != causality:
            raise FmuError(f"{fmu_name}.{name} is a {variable.causality}, not a {causality}")
        _check_value(f"{fmu_name}.{name}", variable, value)


def _check_value(label: str, variable: ModelVariable, value: Setting) -> None:
    if variable.type == "String":
        if not isinstance(value, str):
            raise FmuError(f"{label} = {value!r}: must be a text")
        return
    if variable.type == "Boolean":
        if not isinstance(value, bool):
            raise FmuError(f"{label} = {value!r}: must be true or false")
        return
    if isinstance(value, bool) or not isinstance(value, Real) or not math.isfinite(value):
        raise FmuError(f"{label} = {value!r}: must be a finite number")
    if variable.type != "Real" and float(value) != int(value):
        raise FmuError(f"{label} = {value!r}: must be a whole number")
    _check_range(label, variable, float(value))


def _check_range(label: str, variable: ModelVariable, value: float) -> None:
    low = -math.inf if variable.min is None else float(variable.min)
    high = math.inf if variable.max is None else float(variable.max)
    if not low <= value <= high:
        raise FmuError(f"{label} = {value:g}: must lie in [{low:g}, {high:g}]")
