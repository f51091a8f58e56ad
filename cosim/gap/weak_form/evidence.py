"""How probable rows of unit noise are under linear unknowns with Gaussian priors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular


@dataclass(frozen=True)
class Posterior:
    """Unknowns after the rows have been seen.

    log_evidence : ln p(rows), up to the rows' own constant
    mean, covariance : (q,), (q, q) of the unknowns
    """

    log_evidence: float
    mean: np.ndarray
    covariance: np.ndarray


def posterior(gram: np.ndarray, right: np.ndarray, square: float, prior: np.ndarray) -> Posterior:
    """Of rows z = X b + e, e of unit noise, b of mean 0.

    gram : X'X (q, q); right : X'z (q,); square : z'z; prior : covariance (q, q) of b
    """
    factor = np.linalg.cholesky(prior + 1e-14 * np.diag(np.diag(prior)))
    inner = factor.T @ gram @ factor
    inner[np.diag_indices_from(inner)] += 1.0
    inner = np.linalg.cholesky(inner)  # L L' = 1 + X'X of unit unknowns
    solved = solve_triangular(inner, factor.T @ right, lower=True)
    evidence = -0.5 * (square - solved @ solved) - float(np.log(np.diag(inner)).sum())
    mean = factor @ solve_triangular(inner.T, solved)
    half = solve_triangular(inner, factor.T, lower=True)
    return Posterior(float(evidence), mean, half.T @ half)
