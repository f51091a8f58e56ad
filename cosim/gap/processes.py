"""The processes that a search runs on."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from operator import neg

from joblib import Parallel, delayed, parallel_config

from cosim.interrupts import held_interrupts, unheard_by_children


@contextmanager
def processes(jobs: int) -> Iterator[Parallel]:
    """A pool that gives results in the order of the calls, as they come.

    Its processes have one thread each, else those of BLAS would be more than the cores. They do not
    hear Ctrl-C, which a terminal sends to them too: they end with the block.
    """
    with parallel_config(backend="loky", inner_max_num_threads=1):
        pool = Parallel(n_jobs=jobs, return_as="generator", max_nbytes=None)
    with pool:
        with held_interrupts(), unheard_by_children():
            list(pool(delayed(neg)(number) for number in range(jobs)))  # the first calls start them
        yield pool
