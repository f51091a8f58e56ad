"""`find_gap` beside LISDD (arXiv:2606.23215) on a problem that both can do.

    python tests/benchmarks against_lisdd [--count 2] [--draws 400] [--jobs 2] [--out FOLDER]

A block that always slides: no stick, a smooth equation of motion, 6 runs of 8 s, at most one of
four terms missing. Sizes are noise units over whole runs, mu and starts fitted (lisdd/problem.py).
LISDD has the four terms for a library and knows springs and mass exactly; `find_gap` has its whole
catalogue and does not know that the block never sticks. Level 5 %. LISDD is asked on --draws
campaigns of each kind (recordings of a few motions, for which the intervals hold), `find_gap`,
which takes seconds, on --count of them, and five times as many with nothing missing. All four terms
act everywhere, so that LISDD is shown without its regimes of sliding speed as well.
"""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import partial
from pathlib import Path

ONE_THREAD = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "NUMBA_NUM_THREADS")
os.environ.update(dict.fromkeys(ONE_THREAD, "1"))  # read by the processes as they start

import joblib  # noqa: E402
import numpy as np  # noqa: E402
from baseline import Figure, arguments, write  # noqa: E402
from laboratory_score.shares import Share, share  # noqa: E402
from laboratory_score.tables import table  # noqa: E402
from lisdd.method import discover  # noqa: E402
from lisdd.problem import (  # noqa: E402
    HELD_OUT,
    TERMS,
    Run,
    measured,
    motion,
    regression,
)
from lisdd.problem import write as write_files  # noqa: E402

LEVEL = 0.05
SIZES = (1.0, 2.0, 5.0)
RECORDINGS = 40  # of one motion for LISDD, with noise of their own
NULLS = 5  # times as many campaigns with nothing missing


@dataclass(frozen=True)
class Answer:
    """refused : the plain model is; terms : what is said to be missing; seconds"""

    refused: bool
    terms: frozenset[str]
    seconds: float


Ask = Callable[[list[Run], np.random.Generator], Answer]


def by_lisdd(runs: list[Run], random: np.random.Generator, regimes: int = 4) -> Answer:
    """All runs, as nothing is held out beforehand: the method splits by itself."""
    begin = time.perf_counter()
    found = discover(regression(runs, regimes), random)
    refused = found.p <= LEVEL
    terms = frozenset({found.term}) if refused else frozenset()
    return Answer(refused, terms, time.perf_counter() - begin)


def by_find_gap(runs: list[Run], random: np.random.Generator) -> Answer:
    """The product, from files; a class or a part counts with all its members."""
    from cosim.gap import read_campaign
    from cosim.gap.find import find_gap

    with tempfile.TemporaryDirectory() as folder:
        write_files(runs, Path(folder))
        begin = time.perf_counter()
        gap = find_gap(read_campaign(folder), jobs=1)
        seconds = time.perf_counter() - begin
    return Answer(gap.verdict != "none", frozenset(gap.effects), seconds)


def asked(ask: Ask, term: str, size: float, seed: int, noise: int) -> Answer:
    """One campaign put to one of the two. noise: which recording of the motion"""
    random = np.random.default_rng([seed, noise])
    return ask(measured(motion(term, size, seed), random), random)


@dataclass(frozen=True)
class Line:
    """A method on a kind of campaign."""

    method: str
    term: str
    size: float
    refused: Share
    named: Share
    stated: Share
    seconds: float

    @classmethod
    def of(cls, method: str, term: str, size: float, answers: Iterable[Answer]) -> Line:
        """Shares of the answers: refused, named by name alone, in what is stated."""
        some = list(answers)
        return cls(
            method,
            term,
            size,
            share(some, lambda each: each.refused),
            share(some, lambda each: each.terms == {term}),
            share(some, lambda each: term in each.terms),
            float(np.median([each.seconds for each in some])),
        )

    def cells(self) -> tuple[object, ...]:
        """Of the table."""
        shares = (self.refused, self.named, self.stated) if self.term else (self.refused, "", "")
        return self.term or "nothing", f"{self.size:g}", self.method, *shares, f"{self.seconds:.2g}"


def lines(draws: int, count: int, jobs: int, seed: int, sizes: tuple[float, ...]) -> list[Line]:
    """Both methods on every kind of campaign."""
    methods: tuple[tuple[str, Ask, int], ...] = (
        ("LISDD", by_lisdd, draws),
        ("LISDD, one regime", partial(by_lisdd, regimes=1), draws),
        ("find_gap", by_find_gap, count),
    )
    kinds = [("", 0.0), *((term, size) for term in TERMS for size in sizes)]
    found = []
    with joblib.Parallel(n_jobs=jobs) as parallel:
        for term, size in kinds:
            for method, ask, repeats in methods:
                total = repeats if term or ask is not by_find_gap else NULLS * repeats
                if not total:
                    continue
                each = 1 if ask is by_find_gap else RECORDINGS
                calls = (
                    joblib.delayed(asked)(ask, term, size, seed + j // each, j % each)
                    for j in range(total)
                )
                found.append(Line.of(method, term, size, parallel(calls)))
                print(found[-1].cells(), flush=True)
    return found


def markdown(found: list[Line]) -> str:
    """The table; 95 % intervals, Clopper and Pearson's."""
    head = ("missing", "size / noise", "method", "plain model refused", "named alone")
    text = table((*head, "among what is stated", "median / s"), [line.cells() for line in found])
    return f"Level {LEVEL:.0%}; `find_gap` keeps runs {HELD_OUT} for judging.\n\n{text}"


def main() -> None:
    parser = arguments(__doc__)
    parser.add_argument("--draws", type=int, default=400, help="campaigns for LISDD")
    parser.add_argument("--count", type=int, default=2, help="campaigns for find_gap; 0: none")
    parser.add_argument("--sizes", type=float, nargs="+", default=SIZES)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path, help="folder for the table")
    told = parser.parse_args()
    found = lines(told.draws, told.count, told.jobs, told.seed, tuple(told.sizes))
    text = markdown(found)
    print(text)
    if told.out is not None:
        told.out.mkdir(parents=True, exist_ok=True)
        (told.out / "against_lisdd.md").write_text(text, encoding="utf-8")
    figures = {
        f"{line.method}, {line.term or 'nothing'} {line.size:g}, refused": Figure(
            line.refused.value, better="more" if line.term else "less"
        )
        for line in found
    }
    write(told.json, "against_lisdd", figures)


if __name__ == "__main__":
    main()
