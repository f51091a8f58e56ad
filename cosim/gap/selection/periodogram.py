"""Where a periodic effect's period lies: a periodogram of the misfit by the model's own response.

Every run responds to a wave of any rate with a phase of its own and an amplitude that is the same
for all: what of the residuals such waves explain is the power.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import Candidate

from .frequency_response import FrequencyResponse

#: Steps of the periodogram, in periods over the longest run, and the fewest periods in a run.
_FINE, _FEWEST = 0.25, 1.3
#: A step of a fit, in periods over the longest run.
_STEP = 0.05
#: The most rates.
_POINTS = 8000
#: For rates at which a run tells nothing.
_NOTHING = 1e-9
#: Periods found, of which all but the first must explain this part of the misfit.
PEAKS, FEEBLE = 4, 0.03
#: What the best wave of some thousand rates explains of noise alone: twice the logarithm of their
#: number is 16.
NOISE = 20.0
#: Amplitudes are of about this size, or smaller.
_AMPLITUDE = 0.5
#: A fit sets out from an amplitude between these: a smaller one may be lost among other minima.
_STARTS = (0.02, 0.5)


@dataclass(frozen=True)
class Peak:
    """A period, as its free parameter has it (Hz or m), its amplitude, what it explains.

    power : of the sum of squares
    step : of the period on the scale of the fit (Hz, or relative), small against what is resolved
    """

    period: float
    amplitude: float
    power: float
    step: float


def scan(candidate: Candidate, responses: Sequence[FrequencyResponse]) -> list[Peak]:
    """The strongest periods, strongest first; one, though it be feeble.

    None where the runs are too short for any: a block that sticks all the time travels nowhere.
    """
    rates, power, amplitude = periodogram(candidate, responses)
    if rates.size < 2:
        return []
    least = FEEBLE * sum(response.misfit for response in responses)
    first, *others = _peaks(np.where(amplitude < 1.0, power, 0.0))
    in_time = candidate.periodic.endswith("frequency")
    part = _STEP / _FINE * (rates[1] - rates[0])
    return [
        Peak(
            float(rates[i] if in_time else 1.0 / rates[i]),
            float(np.clip(amplitude[i], *_STARTS)),
            float(power[i]),
            float(part if in_time else part / rates[i]),
        )
        for i in [first, *(i for i in others if power[i] > least)]
    ]


def periodogram(
    candidate: Candidate, responses: Sequence[FrequencyResponse]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rates (n,) per second or per metre, what a wave of each explains, and its amplitude."""
    # the response to a ripple is one in time; that of a roller is one along the surface's travel
    roller = candidate.effect == "speed_ripple" and not candidate.periodic.endswith("frequency")
    scale = [response.speed if roller else 1.0 for response in responses]
    lengths = [r.length * s for r, s in zip(responses, scale, strict=True)]
    highest = max(r.highest / s for r, s in zip(responses, scale, strict=True))
    most = min(highest * max(lengths), _FEWEST + _POINTS * _FINE)
    rates = np.arange(_FEWEST, most, _FINE) / max(lengths)
    along, strength = np.zeros(rates.size), np.full(rates.size, _AMPLITUDE**-2)
    for response, s in zip(responses, scale, strict=True):
        matrix, right = response.normal(s * rates)
        wave = np.linalg.solve(matrix + _NOTHING * np.eye(2), right[:, :, None])[:, :, 0]
        size = np.hypot(*wave.T)
        explained = np.maximum(np.sum(wave * right, axis=1), 0.0)
        felt = size > 0.0
        along[felt] += explained[felt] / size[felt]
        strength[felt] += explained[felt] / size[felt] ** 2
    amplitude = np.minimum(along / strength, 1.0)
    return rates, amplitude * (2.0 * along - amplitude * strength), amplitude


def _peaks(power: np.ndarray) -> list[int]:
    """The highest local maxima."""
    padded = np.concatenate([[-np.inf], power, [-np.inf]])
    top = np.flatnonzero((padded[1:-1] >= padded[:-2]) & (padded[1:-1] > padded[2:]))
    return sorted(top.tolist(), key=lambda i: -power[i])[:PEAKS]
