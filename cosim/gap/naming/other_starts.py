"""A fit once more from other values of mu_s: where a block hardly sticks, one is like another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from cosim.gap.candidates.extend import moved
from cosim.gap.shooting.trial import Model

#: Starts of mu_s, as parts of mu_k.
_MU_S = (1.1, 1.3, 1.6)


def other_starts(model: Model, values: Mapping[str, float]) -> list[Model]:
    """The model starting where it was fitted, but for mu_s."""
    return [_from(model, values, part * values["friction.mu_k"]) for part in _MU_S]


def _from(model: Model, values: Mapping[str, float], mu_s: float) -> Model:
    free_parameters = []
    for free_parameter in model.free_parameters:
        if free_parameter.key == "friction.mu_s" and free_parameter.prior is None:
            free_parameters.append(replace(free_parameter, start=mu_s))
        else:
            free_parameters.append(
                free_parameter if free_parameter.per_run else moved(free_parameter, values)
            )
    return replace(model, free_parameters=tuple(free_parameters))
