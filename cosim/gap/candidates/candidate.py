"""An effect as it is offered to a fit: its free parameters, where they start, what else it needs."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from cosim.gap.estimation.drive import SECOND
from cosim.gap.shooting.free_parameter import FreeParameter

#: Part of its usual start that a faint effect has.
_FAINT = 0.1


def _is_strength(free_parameter: FreeParameter) -> bool:
    """Whether the free parameter says how much of an effect there is: it may be nothing."""
    return (
        not (free_parameter.log or free_parameter.per_run)
        and free_parameter.low <= 0.0 <= free_parameter.high
    )


@dataclass(frozen=True)
class Candidate:
    """One way to add one effect.

    Attributes
    ----------
    effect : id in the catalogue
    form : which of its laws, in a word
    free parameters : what is fitted beside the plain parameters
    settings : parameters of the model that are set, not fitted
    lateral : it moves the block across the surface, or turns it
    periodic : key of the free parameter that needs a scan before a fit can start, or ""
    grows : what a usual hold adds to mu_s for each unit of the first free parameter; 0: nothing
    """

    effect: str
    form: str
    free_parameters: tuple[FreeParameter, ...]
    settings: Mapping[str, float] = field(default_factory=dict)
    lateral: bool = False
    periodic: str = ""
    grows: float = 0.0

    def at(self, period: float, amplitude: float, step: float) -> Candidate:
        """A periodic candidate that starts at a frequency, or wavelength, and an amplitude.

        step : of the period's free parameter; one of more than the data resolve leads to a neighbouring one
        """
        changes = {
            self.periodic: {"start": period, "step": step},
            f"{self.effect}.amplitude": {"start": amplitude},
        }
        free_parameters = (replace(k, **changes.get(k.key, {})) for k in self.free_parameters)
        return replace(self, free_parameters=tuple(free_parameters))

    @property
    def has_second(self) -> bool:
        """Whether it is periodic, but no sine."""
        return any(free_parameter.key.endswith(SECOND) for free_parameter in self.free_parameters)

    @property
    def can_be_faint(self) -> bool:
        """Whether it can be all but absent: a start from which no fit is thrown off course."""
        return not self.periodic and self.faint() != self

    def faint(self) -> Candidate:
        """The same law, starting as next to nothing."""
        return self.times(_FAINT)

    def times(self, part: float) -> Candidate:
        """The same law, starting so many times as strong, as far as it may be."""
        free_parameters = (
            replace(k, start=min(max(part * k.start, k.low), k.high)) if _is_strength(k) else k
            for k in self.free_parameters
        )
        return replace(self, free_parameters=tuple(free_parameters), grows=0.0)

    @property
    def size(self) -> int:
        """Parameters of the campaign that it adds."""
        return sum(not free_parameter.per_run for free_parameter in self.free_parameters)
