"""What a coupled run's energy ledger comes to."""

import numpy as np


def exchanged(ledger):
    """Joules handed over on all connections in the run, to measure a residual by."""
    return sum(abs(flow.handed[-1]) for flow in ledger.flows if flow.handed.size)


def largest_residual(ledger):
    """Largest magnitude of the residual over the run, J."""
    return np.max(np.abs(ledger.residual), initial=0.0)
