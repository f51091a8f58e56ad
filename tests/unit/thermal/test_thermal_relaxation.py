from decimal import Decimal, getcontext

import numpy as np
import pytest

from thermal.relaxation import mean_decay, mean_response


@pytest.mark.parametrize("x", [0.0, 1e-300, 1e-12, 1e-4, 0.1, 0.699, 0.7, 0.701, 3.0, 50.0, 1e6])
def test_against_fifty_digits(x):
    getcontext().prec = 700 if x < 1e-100 else 60
    exact = Decimal(x)
    decay = (-exact).exp()
    first = (1 - decay) / exact if x else Decimal(1)
    second = (decay - 1 + exact) / exact**2 if x else Decimal("0.5")
    assert mean_decay(np.array([x]))[0] == pytest.approx(float(first), rel=4e-16)
    assert mean_response(np.array([x]))[0] == pytest.approx(float(second), rel=2e-15)
