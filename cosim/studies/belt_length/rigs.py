"""All rigs that may be meant: what is not known of one is drawn, and the model is run for each.

The rises of these runs, each with many draws of what they are linear in, are the answer: nothing
stands between it and the model. On one belt, for what a rise does over the length has steps where
a place comes round once more, which no smooth fit has.

Shares of the variance need some 1e5 rigs. There polynomials stand in for the model, laid through
the parts that a rise is made of (`unknowns`). They are Legendre's on the unit cube, orthogonal
under the even distribution of the points, up to a degree p in the hyperbolic norm
(sum n_i^q)^(1/q) <= p, which has few mixed terms (Blatman and Sudret 2011, J. Comput. Phys. 230,
2345-2367); least squares; of the model's values or of their logarithms; degree, norm and logarithm
are those with the least error when each point is left out.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from itertools import starmap
from typing import Any

import numpy as np
import pandas as pd
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray
from scipy.stats import qmc

from cosim.processes import Map
from thermal.arrays import Array

from .case import Case
from .unknowns import COLUMNS, ENTRY, ICE, SAMPLE, answers, combined, unknowns_of, values

#: Fewest rigs of a doubt.
FEWEST_SAMPLES = 32
#: Runs of the model between two words of how far it is.
_AT_ONCE = 8
#: Draws among which quantiles and shares of the rigs are counted.
DRAWN = 2**13
#: Largest share of the rigs that may melt their ice: rises are as if none did, which is too much
#: for those that do, and no answer where half of them are.
MOST_MELTING = 0.5


class Rigs:
    """The sampled rigs of a case, on its belt.

    Attributes
    ----------
    unknowns : what is drawn, with the ranges of the case
    samples : runs of the model

    samples: a power of two from FEWEST_SAMPLES. mapped: over processes; progress: called with the
    number of runs that are done since it was.
    Raises `Melts` where the air is as warm as melting ice.
    """

    def __init__(
        self,
        case: Case,
        samples: int,
        mapped: Map = starmap,
        progress: Callable[[int], object] = lambda count: None,
    ) -> None:
        self.unknowns, self.samples = unknowns_of(case), samples
        #: Of those that the model is run for; the linear ones enter afterwards.
        self._columns = [i for i, one in enumerate(self.unknowns) if not (one.linear or one.fixed)]
        self._melts_at = case.rig.ice.melting_point_degC - case.ambient_degC
        self._sampled = np.zeros((samples, len(self.unknowns)))
        self._sampled[:, self._columns] = qmc.Sobol(len(self._columns), rng=1).random(samples)
        each: Any = pd.DataFrame(values(self.unknowns, self._sampled)).to_dict("records")
        self._parts = _answered(case, each, mapped, progress)
        # neighbours in the sequence are evenly spread, so that those of one rig are
        self._rig = np.repeat(np.arange(samples), max(1, DRAWN // samples))
        drawn = qmc.Sobol(len(self.unknowns), rng=2).random(self._rig.size)
        drawn[:, self._columns] = self._sampled[self._rig][:, self._columns]
        self._drawn = values(self.unknowns, drawn)

    def rises(self, which: int) -> Array:
        """ENTRY, INTERFACE or ICE, K, of all draws: (n,)."""
        return self._combined(self._parts[:, which])

    @property
    def melting(self) -> float:
        """Share of the rigs in which the ice's face comes to melt."""
        return float(np.mean(self.rises(ICE) >= self._melts_at))

    def entry(self, shares: Array) -> Array:
        """Rise of the belt at entry by the polynomials, K: (n,), of rigs at shares (n, unknowns) of
        the ranges, 0 ... 1."""
        points = self._points(shares)
        parts = np.stack([one(points) for one in self._polynomials], axis=1)
        return combined(parts, values(self.unknowns, shares))

    @property
    def unexplained(self) -> float:
        """Share of the variance of the rise at entry that polynomials miss in runs left out."""
        missed = self._combined(np.stack([one.left_out for one in self._polynomials], axis=1))
        rises = self.rises(ENTRY)
        spread = np.var(rises)
        return float(np.mean((missed - rises) ** 2) / spread) if spread > 0.0 else 0.0

    @cached_property
    def _polynomials(self) -> list["Polynomial"]:
        """Of each part of the rise at entry."""
        points = self._points(self._sampled)
        # what sample and room do goes either way, and has no logarithm
        return [
            fitted(points, self._parts[:, ENTRY, i], (False, True) if i < SAMPLE else (False,))
            for i in COLUMNS
        ]

    def _points(self, shares: Array) -> Array:
        """Where the polynomials are asked: at levels in their middle."""
        found = [self.unknowns[i].levelled(shares[:, i]) for i in self._columns]
        return np.stack(found, axis=1) if found else np.empty((len(shares), 0))

    def _combined(self, parts: Array) -> Array:
        """A rise of all draws, K, from its parts in each rig (samples, 5)."""
        return combined(parts[self._rig], self._drawn)


def _answered(
    case: Case, rigs: list[dict[str, float]], mapped: Map, progress: Callable[[int], object]
) -> Array:
    """`answers` of each: (n, 3, 5)."""
    # neighbours share blocks of ice, whose modes take time
    order = np.lexsort([[one[key] for one in rigs] for key in ("contact_area", "ice_conductivity")])
    shares, found = np.array_split(order, max(1, len(rigs) // _AT_ONCE)), []
    for some in mapped(_each, [(case, [rigs[i] for i in share]) for share in shares]):
        found.append(some)
        progress(len(some))
    parts = np.empty((len(rigs), 3, len(COLUMNS)))
    parts[order] = np.concatenate(found)
    return parts


def _each(case: Case, rigs: list[dict[str, float]]) -> Array:
    return np.array([answers(case, one) for one in rigs])


#: Degrees and norms that are tried; a fit takes at most this part of the points for its terms.
_DEGREES, _NORMS, _MOST_TERMS = (1, 2, 3, 4, 5), (0.5, 0.75, 1.0), 0.6


@dataclass(frozen=True)
class Polynomial:
    """indices (terms, dimensions), coefficients (terms,); of the logarithm if `logarithm`.

    left_out: value at each point of the fit, (points,), by a fit without that point.
    """

    indices: NDArray[np.intp]
    coefficients: Array
    logarithm: bool
    left_out: Array

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
    return min(fits, key=lambda fit: float(np.sum((fit.left_out - rises) ** 2)))


def _fit(points: Array, rises: Array, indices: NDArray[np.intp], logarithm: bool) -> Polynomial:
    terms = _terms(points, indices)
    goal = np.log(rises) if logarithm else rises
    q, r = np.linalg.qr(terms)
    coefficients = np.linalg.solve(r, q.T @ goal)
    fit = terms @ coefficients
    left_out = goal - (goal - fit) / np.maximum(1.0 - np.sum(q**2, axis=1), 1e-6)
    said = np.exp(np.minimum(left_out, 50.0)) if logarithm else left_out
    return Polynomial(indices, coefficients, logarithm, said)


def _terms(points: Array, indices: NDArray[np.intp]) -> Array:
    """The polynomials of the indices at points: (n, terms)."""
    each = legvander(2.0 * points - 1.0, int(indices.max(initial=0)))
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
