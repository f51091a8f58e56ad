"""Models that were tried: numbers, and what each showed of the observations, seed by seed."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace

import numpy as np

from cosim.gap.data import Campaign

from .observations import Observation, predict
from .ways import Way


@dataclass(frozen=True)
class Draw:
    """Numbers tried and what came of them.

    shares (d,): the numbers of the way's spans, as shares of their ranges. values: block.parameter
    -> number, settings included. surprise: squared distance of the known ones from what is known.
    shown (seeds, n): the observations' figures, one row a seed.
    """

    shares: np.ndarray
    values: Mapping[str, float]
    surprise: float
    shown: np.ndarray = field(repr=False)

    @property
    def seeds(self) -> int:
        """How often it was run."""
        return len(self.shown)

    @property
    def mean(self) -> np.ndarray:
        """(n,)"""
        return self.shown.mean(axis=0)


def draw(way: Way, shares: np.ndarray, n: int) -> Draw:
    """A draw that has not been run yet."""
    numbers = [float(span.at(share)) for span, share in zip(way.spans, shares, strict=True)]
    values = dict(way.settings) | {
        span.key: number for span, number in zip(way.spans, numbers, strict=True)
    }
    # a contact at rest holds at least what it holds in sliding
    values["friction.mu_k"] = min(values["friction.mu_k"], values["friction.mu_s"])
    surprise = sum(span.surprise(values[span.key]) for span in way.spans)
    return Draw(np.asarray(shares), values, surprise, np.empty((0, n)))


def without_effect(way: Way, before: Draw) -> Draw:
    """A draw of the model without the way's last effect, as one of the way: the effect is off."""
    return replace(before, values=way.off | dict(before.values))


@dataclass(frozen=True)
class Bench:
    """Runs the campaign's model for draws, a few at a time.

    seed: of the whole search; jobs: threads; step: called with the number of draws just done.
    """

    campaign: Campaign
    seen: tuple[Observation, ...]
    seed: int = 0
    jobs: int = 2
    step: Callable[[int], None] | None = None

    @property
    def smooth(self) -> bool:
        """Do figures follow the numbers smoothly? Those of the study's scheme do not."""
        return self.campaign.scheme == "exact"

    def run(self, draws: Iterable[Draw], seeds: int = 1) -> list[Draw]:
        """The draws with ``seeds`` more rows each, in their order."""
        draws = list(draws)
        requests = [(one.values, self.seed + one.seeds + i) for one in draws for i in range(seeds)]
        with ThreadPoolExecutor(max_workers=self.jobs) as pool:
            rows = list(pool.map(self._row, requests))
        return [
            replace(one, shown=np.vstack([one.shown, rows[seeds * i : seeds * (i + 1)]]))
            for i, one in enumerate(draws)
        ]

    def _row(self, request) -> np.ndarray:
        row = predict(self.campaign, self.seen, *request)
        if self.step is not None:
            self.step(1)
        return row
