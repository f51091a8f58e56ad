"""All rigs that may be meant: what is not known of one is drawn, and polynomials answer for each.

The model is run for some of them, evenly spread; through its answers, the parts that a rise is made
of (`unknowns`), polynomials are laid that stand in for it. How much of the variance they miss is
measured on runs that they have not seen. On one belt, or with the length as one more dimension.

The polynomials are Legendre's on the unit cube, orthogonal under the even distribution of the
points, up to a degree p in the hyperbolic norm (sum n_i^q)^(1/q) <= p, which has few mixed terms
(Blatman and Sudret 2011, J. Comput. Phys. 230, 2345-2367); least squares; of the model's values or
of their logarithms; degree, norm and logarithm are those with the least error when each point is
left out.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pandas as pd
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray
from scipy.stats import qmc

from cosim.processes import processes
from thermal.arrays import Array

from .case import Case
from .unknowns import COLUMNS, ENTRY, ICE, INTERFACE, SAMPLE, answers, combined, unknowns_of, values

#: A rig: its case, and the values of what is not known of it.
Meant = tuple[Case, dict[str, float]]

#: Fewest runs of the model through which a polynomial is laid; a quarter more test it.
FEWEST_SAMPLES = 32
_TESTED = 0.25
#: Runs of the model between two words of how far it is.
_AT_ONCE = 8
#: Rigs among which a share of them is counted.
DRAWN = 2048
#: Largest share of the rigs that may melt their ice: rises are as if none did, which is too much
#: for those that do, and no answer where half of them are.
MOST_MELTING = 0.5


class Rigs:
    """The sampled rigs of a case, on its belt, or on belts between two lengths.

    Attributes
    ----------
    unknowns : what is drawn, with the ranges of the case
    evaluations : runs of the model
    unexplained : share of the variance that the polynomials miss, of each rise; where the rigs have
        several lengths, of the variance between rigs of one length, in the logarithm

    samples: runs of the model for the polynomials, a power of two from FEWEST_SAMPLES. lengths:
    (shortest, longest), m; left out, the case's own. floor: rises below it (K) are taken for it, so
    that where a belt never comes round logarithms have an end; with lengths only. jobs: processes.
    progress: called with the number of runs that are done since it was.
    Raises `Melts` where the air is as warm as melting ice.
    """

    def __init__(
        self,
        case: Case,
        samples: int,
        lengths: tuple[float, float] | None = None,
        floor: float = 0.0,
        jobs: int = 1,
        progress: Callable[[int], object] = lambda count: None,
    ) -> None:
        self.unknowns = unknowns_of(case)
        #: Of those that the polynomials are laid over; the linear ones enter afterwards.
        self._columns = [i for i, one in enumerate(self.unknowns) if not (one.linear or one.fixed)]
        self._lengths, self._floor = lengths, floor
        self._melts_at = case.rig.ice.melting_point_degC - case.ambient_degC
        self.evaluations = runs_for(samples)
        draws = qmc.Sobol(len(self._columns) + (lengths is not None), rng=1)
        points = np.concatenate((draws.random(samples), draws.random(self.evaluations - samples)))
        shares = np.zeros((self.evaluations, len(self.unknowns)))
        shares[:, self._columns] = points[:, : len(self._columns)]
        places = points[:, -1]
        parts = _answered(self._meant(case, shares, places), jobs, progress)
        if lengths is not None:
            parts[..., :SAMPLE] = np.maximum(parts[..., :SAMPLE], floor)
        # a rise falls by orders of magnitude with the length, and is needed at the limit; what the
        # room does goes either way, and has no logarithm
        heats = (False, True) if lengths is None else (True,)
        points, fit, tested = self._points(shares, places), slice(samples), slice(samples, None)
        self._polynomials = {
            rise: [
                fitted(points[fit], parts[fit, rise, i], heats if i < SAMPLE else (False,))
                for i in COLUMNS
            ]
            for rise in (ENTRY, INTERFACE, ICE)
        }
        self.unexplained = {
            rise: self._misses(rise, shares[tested], places[tested], parts[tested, rise])
            for rise in self._polynomials
        }

    def rise(self, which: int, shares: Array, length: float) -> Array:
        """ENTRY, INTERFACE or ICE, K: (n,), of rigs at shares (n, unknowns) of the ranges, 0 ... 1.

        length: of the belt, m, where the rigs have several.
        """
        place = 0.0
        if self._lengths is not None:
            low, high = self._lengths
            place = math.log(length / low) / math.log(high / low)
        return self._rise(which, shares, np.full(len(shares), place))

    def drawn(self, count: int = DRAWN) -> Array:
        """Shares of the ranges, evenly spread: (count, unknowns); count: a power of two."""
        return np.asarray(qmc.Sobol(len(self.unknowns), rng=2).random(count))

    def melting(self, length: float) -> float:
        """Share of the rigs, on a belt of a length, m, in which the ice's face comes to melt."""
        return float(np.mean(self.rise(ICE, self.drawn(), length) >= self._melts_at))

    def _rise(self, which: int, shares: Array, places: Array) -> Array:
        """places: (n,) of the lengths between the shortest and the longest, in the logarithm."""
        points = self._points(shares, places)
        parts = np.stack([one(points) for one in self._polynomials[which]], axis=1)
        return combined(parts, values(self.unknowns, shares))

    def _points(self, shares: Array, places: Array) -> Array:
        """Where the polynomials are asked: at levels in their middle, at the length last."""
        found = [self.unknowns[i].levelled(shares[:, i]) for i in self._columns]
        return np.stack(found if self._lengths is None else [*found, places], axis=1)

    def _meant(self, case: Case, shares: Array, places: Array) -> list[Meant]:
        """The belts and the values that shares and places stand for."""
        low, high = self._lengths or (case.length, case.length)
        belts = [case.with_length(low * (high / low) ** float(place)) for place in places]
        each: Any = pd.DataFrame(values(self.unknowns, shares)).to_dict("records")
        return list(zip(belts, each, strict=True))

    def _misses(self, which: int, shares: Array, places: Array, parts: Array) -> float:
        """Share of a rise's variance over unseen runs; the linear unknowns are drawn for each."""
        drawn = np.random.default_rng(1).random(shares.shape)
        drawn[:, self._columns] = shares[:, self._columns]
        true = spread = combined(parts, values(self.unknowns, drawn))
        found = self._rise(which, drawn, places)
        if self._lengths is not None:
            # what a length does is no doubt about a rig: all of them on the belt in the middle
            spread = self._rise(which, drawn, np.full(len(drawn), 0.5))
            spread, found, true = (
                np.log(np.maximum(rises, self._floor)) for rises in (spread, found, true)
            )
        return float(np.mean((found - true) ** 2) / np.var(spread))


def runs_for(samples: int) -> int:
    """Runs of the model for polynomials through so many, tests included."""
    return samples + round(_TESTED * samples)


def _answered(meant: list[Meant], jobs: int, progress: Callable[[int], object]) -> Array:
    """`answers` to each: (n, 3, 5), in as many processes."""
    # neighbours share blocks of ice, whose modes take time
    order = np.lexsort(
        [[one[key] for _, one in meant] for key in ("contact_area", "ice_conductivity")]
    )
    shares, found = np.array_split(order, max(jobs, len(meant) // _AT_ONCE)), []
    with processes(jobs) as mapped:
        for some in mapped(_each, [([meant[i] for i in share],) for share in shares]):
            found.append(some)
            progress(len(some))
    parts = np.empty((len(meant), 3, len(COLUMNS)))
    parts[order] = np.concatenate(found)
    return parts


def _each(meant: list[Meant]) -> Array:
    return np.array([answers(*one) for one in meant]).reshape(-1, 3, len(COLUMNS))


#: Degrees and norms that are tried; a fit takes at most this part of the points for its terms.
_DEGREES, _NORMS, _MOST_TERMS = (1, 2, 3, 4, 5), (0.5, 0.75, 1.0), 0.6


@dataclass(frozen=True)
class Polynomial:
    """indices (terms, dimensions), coefficients (terms,); of the logarithm if `logarithm`."""

    indices: NDArray[np.intp]
    coefficients: Array
    logarithm: bool

    def __call__(self, points: Array) -> Array:
        """Values at points (n, dimensions) of the unit cube."""
        found = _terms(points, self.indices) @ self.coefficients
        return np.exp(found) if self.logarithm else found


def fitted(points: Array, rises: Array, kinds: tuple[bool, ...] = (False, True)) -> Polynomial:
    """Through points (n, dimensions) of the unit cube with rises (n,) there.

    kinds: whether it may be one of the rises (False), of their logarithms (True); the latter only
    where all are above 0.
    """
    fits = [
        _fit(points, rises, indices, logarithm)
        for logarithm in (kinds if np.all(rises > 0.0) else (False,))
        for indices in _index_sets(points.shape[1], int(_MOST_TERMS * len(points)))
    ]
    return min(fits, key=lambda fit: fit[1])[0]


def _fit(
    points: Array, rises: Array, indices: NDArray[np.intp], logarithm: bool
) -> tuple[Polynomial, float]:
    """The fit, and the root mean square error of each point by a fit without it."""
    terms = _terms(points, indices)
    goal = np.log(rises) if logarithm else rises
    q, r = np.linalg.qr(terms)
    coefficients = np.linalg.solve(r, q.T @ goal)
    fit = terms @ coefficients
    left_out = goal - (goal - fit) / np.maximum(1.0 - np.sum(q**2, axis=1), 1e-6)
    said = np.exp(np.minimum(left_out, 50.0)) if logarithm else left_out
    error = float(np.sqrt(np.mean((said - rises) ** 2)))
    return Polynomial(indices, coefficients, logarithm), error


def _terms(points: Array, indices: NDArray[np.intp]) -> Array:
    """The polynomials of the indices at points: (n, terms)."""
    each = legvander(2.0 * points - 1.0, int(indices.max()))
    terms = np.ones((len(points), len(indices)))
    for dimension in range(points.shape[1]):
        terms *= each[:, dimension, indices[:, dimension]]
    return terms


def _index_sets(dimensions: int, most: int) -> Iterator[NDArray[np.intp]]:
    """Degrees of each dimension in each term: (terms, dimensions), at most `most` terms."""
    seen = set()
    for norm in _NORMS:
        for degree in _DEGREES:
            found = np.array(_within(dimensions, degree, norm))
            if len(found) > most:
                break
            if len(found) not in seen:
                seen.add(len(found))
                yield found


def _within(dimensions: int, degree: int, norm: float) -> list[tuple[int, ...]]:
    """Degrees of each dimension whose hyperbolic norm is no more than the degree."""
    found: list[tuple[int, ...]] = [()]
    for _ in range(dimensions):
        longer = ((*one, n) for one in found for n in range(degree + 1))
        found = [each for each in longer if sum(n**norm for n in each) <= degree**norm + 1e-9]
    return found
