"""What an effect is: parameters, terms of the kernel, candidates for a fit, a case to be shown.

The plain model is Coulomb friction along x alone, linear springs and a steady belt. Every effect
is a table of a scenario, a group of FMU parameters `effect.parameter`, and off at its defaults, so
that the plain model, one effect or several are the same kernel with other numbers.

An effect is one file. It declares an `Effect` named ``EFFECT`` and stands in the list of
`stickslip.effects`; the kernel's slots and the calls of its terms are made from that.
"""

import math
import sys
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, field
from inspect import cleandoc
from typing import Any, NoReturn

from ..quantity import Table, details


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


#: What an effect's law is a curve over: sliding speed of the contact, time at rest, heat that is
#: remembered, distance slid, place on the surface, normal force, extension of a spring, time, and
#: velocity of the block against the frame.
AXES = (
    "sliding speed", "hold time", "heat memory", "distance", "place", "load",
    "position", "time", "velocity",
)  # fmt: skip

#: Where in the model an effect can enter, for the reader.
ENTERS = ("friction", "springs", "surface", "contact")

#: What a random number can be.
DRAWN = ("normal", "uniform")

#: A function of numbers: floats in, a float out, `math` only. Its name says where it enters or what
#: it is; its arguments are bound by their names, see `stickslip.generation.places`.
Term = Callable[..., float]


def no_candidates(scales: Scales) -> Iterable[Candidate]:
    """Of an effect that `gap` does not offer to a fit."""
    return ()


@dataclass(frozen=True)
class State:
    """A number that an effect remembers, integrated with the motion.

    Attributes
    ----------
    name : by which the effect's terms take it
    rate : its rate of change; beside the common words it can take ``speed``, the mean local
        sliding speed, m/s, and ``friction_power``, W
    start : parameter that it starts from; "" is 0
    scale : what of it counts as much as the motion's own speed (``speed``, m/s), for the error
        test; None is the energy of that motion, J
    unit : as FMI writes it
    """

    name: str
    rate: Term
    start: str = ""
    scale: Term | None = None
    unit: str = "J"


@dataclass(frozen=True)
class Case:
    """A size of an effect that shows, and the rig in which it does.

    Attributes
    ----------
    effect : the effect's parameters
    rig : what else differs from the plain rig of the page, with the effect and without
    window : times that are shown, s
    warmer : of the interface above the effect's own reference_degC, K
    water : mean thickness of the water that the page names, m
    """

    effect: Mapping[str, Any]
    rig: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    window: tuple[float, float] = (4.0, 8.0)
    warmer: float = 0.0
    water: float = 0.0


@dataclass(frozen=True, eq=False)
class Effect:
    """An entry of the catalogue.

    Attributes
    ----------
    id : name of the scenario's table, of the FMU's parameter group and of the candidate in `gap`
    table : the parameters: names, units, defaults, bounds
    switch : the parameters any of which turns it on, most telling first
    enters : where in the model, one of ENTERS
    axis : of AXES, over what its law is a curve; "" where it is none
    source : where the effect is named or its law comes from
    case : how it is shown
    terms : what it adds to the kernel; each is named by its place there
    derived : numbers made of the parameters once a run; each is named by its function
    series : derived numbers of which there are several, and how many: each member has its own
    draws : random numbers that a derived number of a series can take, by name: each member has
        its own, "normal" (mean 0, standard deviation 1) or "uniform" (from 0 to 1), drawn in this
        order by the parameter ``seed``
    sums : word -> function of a member of each series; the word is its sum over them
    states : what it remembers
    core : parameters that the core of the kernel knows, and under which name (`P_...`)
    candidates : what a fit may turn in a campaign of such scales
    offered : whether `gap` tries them by itself, or only where somebody names the effect: one more
        law is one more chance to be wrong, and a campaign's answer is not to change by it
    feels_melting : switches by any of which friction in slip is another where the face of the ice
        melts, for its temperature or for the water
    """

    id: str
    table: type[Table]
    switch: tuple[str, ...]
    enters: str
    source: str
    case: Case
    terms: tuple[Term, ...] = ()
    derived: tuple[Term, ...] = ()
    series: Mapping[str, int] = field(default_factory=dict)
    draws: Mapping[str, str] = field(default_factory=dict)
    sums: Mapping[str, Term] = field(default_factory=dict)
    states: tuple[State, ...] = ()
    core: Mapping[str, str] = field(default_factory=dict)
    candidates: Callable[[Scales], Iterable[Candidate]] = no_candidates
    offered: bool = True
    feels_melting: tuple[str, ...] = ()
    axis: str = ""

    def __post_init__(self) -> None:
        """Refuses, by one line that names the effect, what would fail later and less clearly."""
        for name in ("switch", "terms", "derived", "states", "feels_melting"):
            if not isinstance(getattr(self, name), tuple):
                self.refuse(f"{name} is no tuple: (a,) is one of one member")
        if self.axis and self.axis not in AXES:
            self.refuse(f"axis {self.axis!r} is none; there are {', '.join(AXES)}")
        if self.enters not in ENTERS:
            parts = ", ".join(ENTERS)
            self.refuse(f"enters {self.enters!r}, which is no part of the model; there are {parts}")
        fields = self.table.model_fields
        self._check_draws()
        if not self.switch:
            self.refuse("no switch: which parameters turn it on?")
        for named in ("switch", "core", "feels_melting"):
            for name in getattr(self, named):
                if name not in fields:
                    self.refuse(f"{named} {name!r} is no parameter; there are {', '.join(fields)}")
        for name, each in fields.items():
            said = details(each)
            if not said.get("unit"):
                self.refuse(f"{name} has no unit: declare it by `quantity`")
            if "typical" not in said and "tried" not in said:
                self.refuse(f"{name} has neither a typical range nor a tried one")

    def refuse(self, why: str) -> NoReturn:
        """Raise ValueError with the effect's name."""
        raise ValueError(f"effect {self.id}: {why}")

    def _check_draws(self) -> None:
        if not self.draws:
            return
        if "seed" not in self.table.model_fields:
            self.refuse("draws by no parameter called seed")
        if len(set(self.series.values())) != 1:
            self.refuse("draws are for series of one length")
        for name, kind in self.draws.items():
            if kind not in DRAWN:
                self.refuse(f"draw {name!r} is {kind!r}; there are {', '.join(DRAWN)}")

    @property
    def members(self) -> int:
        """Of each of its series."""
        return max(self.series.values(), default=0)

    @property
    def sentence(self) -> str:
        """What it adds to the plain model."""
        return (self.table.__doc__ or "").split("\n")[0]

    @property
    def law(self) -> list[str]:
        """Its law in words and formulas, the paragraphs of its file; a formula is indented."""
        said = cleandoc(sys.modules[self.table.__module__].__doc__ or "")
        return said.split("\n\n")[1:]
