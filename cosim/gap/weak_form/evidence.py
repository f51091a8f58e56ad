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
    factor, inner, scaled = _factored(gram, right, prior)
    solved = solve_triangular(inner, scaled, lower=True)
    evidence = -0.5 * (square - solved @ solved) - float(np.log(np.diag(inner)).sum())
    mean = factor @ solve_triangular(inner.T, solved)
    half = solve_triangular(inner, factor.T, lower=True)
    return Posterior(float(evidence), mean, half.T @ half)


def _factored(gram: np.ndarray, right: np.ndarray, prior: np.ndarray):
    """L of the prior = L L', the Cholesky factor of 1 + L'X'X L, and L'X'z."""
    factor = np.linalg.cholesky(prior + 1e-14 * np.diag(np.diag(prior)))
    inner = factor.T @ gram @ factor
    inner[np.diag_indices_from(inner)] += 1.0
    return factor, np.linalg.cholesky(inner), factor.T @ right
