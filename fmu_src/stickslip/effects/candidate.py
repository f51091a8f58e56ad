"""An effect as it is offered to a fit: free parameters, where they start, what else it needs."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field


@dataclass(frozen=True)
class FreeParameter:
    """A number to be fitted: a parameter of the model, with its range.

    Attributes
    ----------
    key : `table.parameter` of the model, or of the drive
    start : first guess
    step : change that is felt but small: scale of the fit and of its differences
    low, high : bounds
    per_run : its own value in every run (a phase), else one for the campaign
    log : fitted on a logarithmic scale; ``step`` is then relative
    """

    key: str
    start: float
    step: float
    low: float = -math.inf
    high: float = math.inf
    per_run: bool = False
    log: bool = False

    def inside(self, value: float) -> float:
        """The nearest allowed value to ``value``, on the scale of the fit."""
        low, high = (self.scaled(self.low), self.scaled(self.high))
        return min(max(value, low), high)

    def scaled(self, value: float) -> float:
        """From the parameter to the scale of the fit, where steps are of the order of one."""
        if self.log:
            return math.log(value) / self.step if value > 0.0 else -math.inf
        return value / self.step

    def value(self, scaled: float) -> float:
        """From the scale of the fit to the parameter."""
        return math.exp(scaled * self.step) if self.log else scaled * self.step


@dataclass(frozen=True)
class Scales:
    """What is typical of a campaign: where the fits of its candidates set out.

    speed : sliding speed, m/s; distance : slid in a run, m; heat : made in a run, J;
    duration : of a run, s; stiffness : of one spring, N/m; travel : stroke of the block, m;
    mass, kg; force : normal force, N; extension : of a spring as installed, m;
    longest : travel of the surface in the run in which it travels most, m; 0: not known
    """

    speed: float
    distance: float
    heat: float
    duration: float
    stiffness: float
    travel: float
    mass: float
    force: float
    extension: float = 0.0
    longest: float = 0.0


@dataclass(frozen=True)
class Candidate:
    """One way to add one effect.

    Attributes
    ----------
    effect : id in the catalogue
    form : which of its laws, in a word
    free_parameters : what is fitted beside the plain parameters
    settings : parameters of the model that are set, not fitted
    periodic : key of the free parameter that needs a scan before a fit can start, or ""
    """

    effect: str
    form: str
    free_parameters: tuple[FreeParameter, ...]
    settings: Mapping[str, float] = field(default_factory=dict)
    periodic: str = ""


@dataclass(frozen=True)
class FormsOf:
    """What writes the candidates of one effect, whose parameters go by their own names there."""

    effect: str

    def free(
        self, name: str, start: float, step: float, low: float, high: float, log: bool = False
    ) -> FreeParameter:
        """A free parameter of the effect."""
        return FreeParameter(f"{self.effect}.{name}", start, step, low, high, log=log)

    def form(self, name: str, *free: FreeParameter, **settings: float) -> Candidate:
        """A candidate with these free parameters; settings: of parameters of the effect."""
        keys = {f"{self.effect}.{key}": value for key, value in settings.items()}
        return Candidate(self.effect, name, free, keys)
