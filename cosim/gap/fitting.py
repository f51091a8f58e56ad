"""Models of findings, each fitted once, over the same windows."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import islice

from cosim.gap import judge
from cosim.gap.data import Campaign
from cosim.gap.extended import Part, as_points, part_of
from cosim.gap.laws import LawFit
from cosim.gap.models import Models
from cosim.gap.naming import Named
from cosim.gap.weak_form.constants import LEAST_GAIN
from cosim.gap.weak_form.ladder import Finding, price_of


@dataclass
class Fitting:
    """Models of findings, fitted over the same windows.

    known : what was fitted already, and whether each finding by itself
    """

    campaign: Campaign
    step: Callable[[], None]
    jobs: int
    known: list[tuple[Models, bool]] = field(default_factory=list)

    @property
    def is_too_long(self) -> bool:
        """Whether nothing more is asked for, as the answer takes too long."""
        return bool(self.known) and judge.is_too_long(self.known[0][0].work.simulated)

    def part(self, named: Named, finding: Finding, law: LawFit | None = None) -> Part:
        """What a finding puts into the model."""
        return part_of(self.campaign, named.system, named.rung, finding, law)

    def fitted(
        self, named: Named, parts: Sequence[Part], is_shown: bool = True, scatters: bool = True
    ) -> Models:
        """Models of these findings; of what no page shows friction need not scatter."""
        ids = list(map(id, parts))
        known = (models for models, was_shown in self.known
                 if list(map(id, models.parts)) == ids and (was_shown or not is_shown))  # fmt: skip
        models = next(known, None)
        if models is None:
            models = Models.fitted(
                self.campaign, named.system, parts, step=self.step, jobs=self.jobs,
                others=self.known[0][0] if self.known else None, is_shown=is_shown,
            )  # fmt: skip
            self.known.append((models, is_shown))
        if scatters:
            models.let_scatter()
        return models

    def without(
        self, part: Part, parts: Sequence[Part], named: Named, scatters: bool = True
    ) -> Models:
        """Models of the other findings."""
        others = [other for other in parts if other is not part]
        return self.fitted(named, others, is_shown=False, scatters=scatters)

    def gained(self, part: Part, without: Models, named: Named) -> tuple[float, Part]:
        """ln of how much more probable simulated runs are with a finding, and by which of its laws.

        Laws that follow a curve alike move the block differently: where the first brings neither
        enough nor as much less, another form of it counts with which they are much more so.
        """
        first = without.gained(part)
        if abs(first) <= LEAST_GAIN + price_of(part.finding.name):
            for form in islice(self.forms(part, named), 1, None):
                gained = without.gained(form)
                if judge.much_more(gained):
                    return gained, form
        return first, part

    def forms(self, part: Part, named: Named) -> Iterator[Part]:
        """A finding by each law of its effect that is nearly as near to its curve."""
        yield part
        for law in part.rivals(self.campaign):
            if law.effect == part.effect:
                yield self.part(named, part.finding, law)

    def best_of(self, parts: list[Part], named: Named) -> tuple[list[Part], Models]:
        """With laws that follow the curves, or with the curves where the runs ask for them.

        Where laws of two effects follow a curve, as one of the user's own and the catalogue's may,
        it is the one with which runs come out better that no fit has seen.
        """
        models = self.fitted(named, parts)
        for part in parts:
            for law in part.rivals(self.campaign):
                if law.effect == part.effect and judge.explains(models.ladder):
                    continue  # another form of it hardly tells
                other = self.part(named, part.finding, law)
                swapped = [other if one.finding is part.finding else one for one in parts]
                others = self.fitted(named, swapped)
                if others.ladder[-1].gap.of_verdict < models.ladder[-1].gap.of_verdict:
                    parts, models = swapped, others
        if not judge.explains(models.ladder):  # a law may be near its curve, and not near enough
            points = [as_points(self.campaign, named.system, part) for part in parts]
            if points != parts:
                others = self.fitted(named, points)
                if others.ladder[-1].gap.of_verdict < models.ladder[-1].gap.of_verdict:
                    return points, others
        return parts, models
