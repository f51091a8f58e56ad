"""Periods found in the misfit of a plain model: of a ripple, of a roller, of a pattern."""

from dataclasses import replace

import numpy as np
import pytest
from gap_campaigns import motion, noisy, write_campaign
from stickslip.effects.candidate import FreeParameter, Scales

from cosim.gap.candidates.catalogue import candidates
from cosim.gap.data import read_campaign
from cosim.gap.estimation.fit import with_columns
from cosim.gap.estimation.preparation import SHORT_CYCLES, Data, prepare
from cosim.gap.estimation.trial import Model, coarse_fit
from cosim.gap.selection.frequency_response import frequency_response, sums
from cosim.gap.selection.periodogram import periodogram, scan

SPEEDS, AMPLITUDE, PHASES = (0.04, 0.07), 0.08, (40.0, 190.0)
PLAIN = Model(
    (
        FreeParameter("friction.mu_s", 0.3, 0.01, 0.0, 2.0),
        FreeParameter("friction.mu_k", 0.2, 0.01, 0.0, 2.0),
    ),
    {},
)
LAWS = {
    (c.effect, c.form): c for c in candidates(Scales(0.05, 0.5, 1.0, 10.0, 38.5, 0.05, 0.87, 8.5))
}
FREQUENCY, LENGTH = 1.7, 0.031
CASES = {
    ("speed_ripple", "sine"): [{"frequency": FREQUENCY}] * 2,
    ("speed_ripple", "sine of a roller"): [{"frequency": v / LENGTH} for v in SPEEDS],
    ("surface_pattern", "sine"): [{"wavelength": LENGTH}] * 2,
}


@pytest.fixture(scope="module", params=CASES, ids=" ".join)
def scanned(request, tmp_path_factory):
    effect = request.param[0]
    runs = []
    for number, (speed, shape) in enumerate(zip(SPEEDS, CASES[request.param], strict=True)):
        wave = {"amplitude": AMPLITUDE, "phase_deg": PHASES[number]} | shape
        run = motion(speed=speed, duration=8.0, **{effect: wave})
        runs.append(
            {"columns": {"t": run.time, "x": noisy(run["x"], number)}, "surface_speed": speed}
        )
    folder = tmp_path_factory.mktemp("scan")
    campaign = read_campaign(write_campaign(folder, runs, noise={"x": 2e-4}))
    segmented_runs = prepare(campaign, campaign.runs, False, SHORT_CYCLES)
    data = Data(segmented_runs, segmented_runs, (), ())
    fitted = with_columns(PLAIN.problem(segmented_runs), coarse_fit(data, PLAIN, 8))
    law = LAWS[request.param]
    responses = [
        frequency_response(law, PLAIN, fitted.of_run(i), segmented)
        for i, segmented in enumerate(segmented_runs)
    ]
    return request.param, law, responses


def test_the_period_in_the_data_is_found_first(scanned):
    case, law, responses = scanned
    in_time = case == ("speed_ripple", "sine")
    true, length = (FREQUENCY, 8.0) if in_time else (1.0 / LENGTH, 8.0 * max(SPEEDS))
    peaks = scan(law, responses)
    best = peaks[0]
    off = abs((best.period if in_time else 1.0 / best.period) - true) * length
    # half a period more over the longest run would be out of step at its ends
    assert off < 0.5
    # linearised about a model that has none of it: the size is right within a factor
    assert 0.5 * AMPLITUDE < best.amplitude < 2.0 * AMPLITUDE
    assert 0.0 < best.step < 0.1 * (1.0 / length if in_time else LENGTH / length)
    assert [p.power for p in peaks] == sorted((p.power for p in peaks), reverse=True)


def test_normal_equations_between_the_rates_simulated(scanned):
    """Those of a sum of squares where they are known, nothing where they are not."""
    for answer in scanned[2]:
        rates = (np.arange(3, 12) + 0.5) * answer.step
        matrix, right = answer.normal(rates[rates < answer.highest])
        assert np.linalg.eigvalsh(matrix).min() > 0.0 and np.isfinite(right).all()
        above = answer.normal(np.array([answer.highest + answer.step]))
        assert not above[0].any() and not above[1].any()


def test_the_periodogram_is_nothing_where_there_is_no_misfit(scanned):
    _, law, responses = scanned
    silent = []
    for answer in responses:
        products = answer.products.copy()
        products[:, :, -1] = 0.0
        silent.append(replace(answer, products=products))
    assert not periodogram(law, silent)[1].any()


def test_a_segment_that_answers_violently_does_not_outweigh_the_others():
    """Of two segments of ten rows, the same but that one responses a thousand times as much."""
    random = np.random.default_rng(2)
    part = random.standard_normal(10) + 1j * random.standard_normal(10)
    sizes, basis = np.array([10, 10]), np.ones((20, 2))
    _, mild, _ = sums(np.concatenate([part, part]), basis, sizes)
    assert mild[0] == pytest.approx(mild[1])
    products, squares, turned = sums(np.concatenate([part, 1e3 * part]), basis, sizes)
    # it never tells an amplitude better than each row would at 1 / 0.1, the answer's own error
    assert mild[0] < squares[1] < 10 / 0.1**2
    assert np.abs(turned) == pytest.approx(
        squares * np.abs(np.sum(part**2)) / np.sum(np.abs(part) ** 2)
    )
    assert np.all(np.isfinite(products))
