"""Where a periodic effect's period lies: the periodogram of the misfit through the model's answer.

Every run answers a wave of any rate with a phase of its own and an amplitude that is the same for
all: what of the residuals such waves explain is the power.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from stickslip.effects.candidate import Candidate

from .wave_answer import WaveAnswer

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
    """A period, as the free parameter of the candidate has it (Hz or m), its amplitude, what it explains.

    power : of the sum of squares
    step : of the period on the scale of its free parameter (Hz, or relative), small against what is resolved
    """

    period: float
    amplitude: float
    power: float
    step: float


def scan(candidate: Candidate, answers: Sequence[WaveAnswer]) -> list[Peak]:
    """The strongest periods, strongest first; one, though it be feeble.

    None where the runs are too short for any: a block that sticks all the time goes no way.
    """
    rates, power, amplitude = periodogram(candidate, answers)
    if rates.size < 2:
        return []
    least = FEEBLE * sum(answer.misfit for answer in answers)
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
    candidate: Candidate, answers: Sequence[WaveAnswer]
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Rates (n,) per second or per metre, what a wave of each explains, and its amplitude."""
    # a ripple is answered to in time; that of a roller is one along the surface's way
    roller = candidate.effect == "speed_ripple" and not candidate.periodic.endswith("frequency")
    scale = [answer.speed if roller else 1.0 for answer in answers]
    lengths = [a.length * s for a, s in zip(answers, scale, strict=True)]
    highest = max(a.highest / s for a, s in zip(answers, scale, strict=True))
    most = min(highest * max(lengths), _FEWEST + _POINTS * _FINE)
    rates = np.arange(_FEWEST, most, _FINE) / max(lengths)
    along, strength = np.zeros(rates.size), np.full(rates.size, _AMPLITUDE**-2)
    for answer, s in zip(answers, scale, strict=True):
        matrix, right = answer.normal(s * rates)
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
    return sorted(top, key=lambda i: -power[i])[:PEAKS]
