"""A share with its interval."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TypeVar

from scipy.stats import binomtest

Each = TypeVar("Each")


@dataclass(frozen=True)
class Share:
    """So many of so many."""

    hits: int
    total: int

    @property
    def value(self) -> float:
        """Between 0 and 1; nan of nothing."""
        return self.hits / self.total if self.total else float("nan")

    def interval(self, level: float = 0.95) -> tuple[float, float]:
        """Of the true share, exact (Clopper and Pearson, Biometrika 26, 1934)."""
        if not self.total:
            return 0.0, 1.0
        low, high = binomtest(self.hits, self.total).proportion_ci(level, method="exact")
        return float(low), float(high)

    def __str__(self) -> str:
        if not self.total:
            return "–"
        low, high = self.interval()
        return (
            f"{self.hits} of {self.total} = {100 * self.value:.1f} % "
            f"({100 * low:.0f} to {100 * high:.0f})"
        )


def share(of: Iterable[Each], holds: Callable[[Each], bool]) -> Share:
    """Part of them of which something holds."""
    answers = [bool(holds(each)) for each in of]
    return Share(sum(answers), len(answers))
