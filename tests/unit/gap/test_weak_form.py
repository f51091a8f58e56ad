"""Rows of the equation of motion: exact integrals, unit noise, evidence, and what they ask for."""

import json
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from gap_campaigns import KNOWN, NOISE, campaign_with, motion, noisy, seen
from scipy.special import logsumexp
from scipy.stats import multivariate_normal

from cosim.gap.extended import part_of
from cosim.gap.fitting import Fitting
from cosim.gap.naming import Naming
from cosim.gap.scatter import Scatter, scatter_text
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.constants import ALIKE, SCATTER_RANGE
from cosim.gap.weak_form.evidence import posterior
from cosim.gap.weak_form.ladder import Search
from cosim.gap.weak_form.rig_unknowns import MU_K, MU_S, SCATTER, ZERO_NAME
from cosim.gap.weak_form.rows import STICK, rows_of
from cosim.gap.weak_form.surface import tracks_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import smooth
from cosim.gap.windows.run_model import parameters_of

MASS, STIFFNESS = KNOWN["mass"], 4.0 * KNOWN["stiffness"]
#: Masses and speeds of five runs.
RUNS = ((0.6, 0.05), (0.6, 0.1), (0.6, 0.2), (1.1, 0.05), (1.1, 0.1))
FRICTION = {"mu_s": 0.3, "mu_k": 0.2}
#: Every argument that an effect stands for, at a plain size; "" is none.
EFFECTS = {
    "": {},
    "velocity_weakening": {"linear": 0.6},
    "film_drag": {"coefficient": 0.6},
    "structural_damping": {"coefficient": 0.6},
    "spring_hardening": {"cubic": 2e4},
    "run_in": {"change": -0.2, "distance": 0.3},
    "thermal_weakening": {"per_joule": 0.5, "relaxation_time": 3.0},
    "load_dependence": {"exponent": -0.25, "reference_force": 8.0},
    "static_strengthening": {"rate": 0.1, "hold_time": 0.1},
    "surface_pattern": {"amplitude": 0.1, "wavelength": 0.07},
    "speed_ripple": {"amplitude": 0.05, "frequency": 0.9},
}
#: Those that no effect of the catalogue stands for, by what differs from run to run.
FROM_RUN_TO_RUN = {
    "other.order": [{}] * len(RUNS),
    "other.room": [{"ambient_degC": degrees} for degrees in (0.0, 12.0, 4.0, 15.0, 0.0)],
}
QUICK = ("", "velocity_weakening", "surface_pattern")


def written(folder, parts=None, more=None, duration=10.0, held_out=(), seed=0, **blocks):
    """A campaign. parts : of friction in each run; more : keys of its table."""
    runs = []
    for number, (mass, speed) in enumerate(RUNS):
        part = 1.0 if parts is None else parts[number]
        run = moved(speed, mass, duration, part, json.dumps(blocks))
        table = {"surface_speed": speed, "mass": mass, "hold_out": number in held_out}
        table |= {} if more is None else more[number]
        runs.append(seen(run, 100 * seed + number, **table))
    return campaign_with(folder, runs)


@cache
def moved(speed, mass, duration, part, blocks):
    """Motions are computed once. part : of friction; blocks : JSON"""
    friction = {name: part * mu for name, mu in FRICTION.items()}
    return motion(speed, mass, duration=duration, **friction, **json.loads(blocks))


def system_of(campaign, every=True):
    rows = [rows_of(track, campaign.rig) for track in tracks_of(campaign, list(campaign.runs))]
    return System(campaign, rows, every=every)


def rows_alone(folder, columns, speed, noise):
    """Of a campaign of one run."""
    runs = [{"surface_speed": speed, "columns": columns}]
    campaign = campaign_with(folder, runs, noise={"x": noise})
    return rows_of(smooth(campaign.runs[0]), campaign.rig)


def found_in(campaign):
    """Names of the findings."""
    system = system_of(campaign)
    arguments = Arguments(campaign, system.runs, system.level)
    waves = periodic.kinds(system.level.kinetic)
    ladder = Search(system, arguments.unknowns(), waves, arguments.near).climb()
    return [finding.name for finding in ladder.findings]


@pytest.mark.parametrize(
    "effect", [name if name in QUICK else pytest.param(name, marks=pytest.mark.slow)
               for name in EFFECTS]
)  # fmt: skip
def test_what_is_there_is_named_first(effect, tmp_path):
    blocks = {effect: EFFECTS[effect]} if effect else {}
    assert found_in(written(tmp_path, **blocks))[:1] == [effect] * bool(effect)


@pytest.mark.parametrize("proportional", [True, False])
def test_springs_of_two_makes_harden_in_proportion_to_their_stiffness_or_not(
    proportional, tmp_path
):
    runs = []
    for number, (part, speed) in enumerate([(1.0, 0.06), (1.0, 0.12), (0.4, 0.06), (0.4, 0.12)]):
        stiffness = part * KNOWN["stiffness"]
        hardening = {"cubic": 1e4 * (part if proportional else 1.0)}
        run = motion(speed, stiffness=stiffness, duration=10.0, spring_hardening=hardening)
        runs.append(seen(run, number, surface_speed=speed, stiffness=stiffness))
    campaign = campaign_with(tmp_path, runs)
    named = Naming.of(campaign).named()
    part = part_of(campaign, named.system, named.rung, named.findings[0])
    assert [finding.name for finding in named.findings] == ["spring_hardening"]
    assert ("with_stiffness.spring_hardening.cubic" in part.settings) == proportional
    values = {**part.settings, **{number.key: number.start for number in part.numbers}}
    for run in campaign.runs:
        made = 1e4 * (run.stiffness / KNOWN["stiffness"] if proportional else 1.0)
        known = parameters_of(run, values)
        assert known["spring_hardening.cubic"] == pytest.approx(made, rel=0.2)


def test_what_static_friction_takes_of_a_drift_is_fitted_to_the_runs(tmp_path):
    worn = {"change": -0.3, "distance": 0.3, "static_absolute": 0.5}
    campaign = written(tmp_path, run_in=worn)
    fitting, named = Fitting(campaign, lambda: None, 2), Naming.of(campaign).named()
    assert [finding.name for finding in named.findings] == ["run_in"]
    parts = [fitting.part(named, named.findings[0])]
    models = fitting.fitted(named, parts)
    assert models.fits[-1].values["run_in.static_absolute"] == pytest.approx(0.5, abs=0.05)
    assert models.ladder[-1].gap.fit < 1.05


def test_what_stands_in_a_wave_s_place_is_offered_at_the_same_price(tmp_path):
    """A scan chooses among many waves: the one found paid for that as those do that were not.

    The finding has been moved on since it was offered, by less than what tells two apart.
    """
    system = system_of(written(tmp_path, surface_pattern={"amplitude": 0.02, "wavelength": 0.07}))
    arguments = Arguments(system.campaign, system.runs, system.level)
    waves = periodic.kinds(system.level.kinetic)
    ladder = Search(system, arguments.unknowns(), waves, arguments.near).climb()
    (finding,) = ladder.findings
    offered = {name: offer[0] for name, offer in ladder.first_offers.items()}
    for name in ("other.shaking", "spring_hardening"):
        less = offered[name] - offered["surface_pattern"]
        assert finding.others[name] == pytest.approx(less, abs=ALIKE)


def test_a_trend_over_the_runs_is_found_where_scatter_would_have_to_take_it(tmp_path):
    """However large the first finding is: what that leaves within a run is asked for otherwise."""
    blocks = {"surface_pattern": {"amplitude": 0.5, "wavelength": 0.07}}
    blocks["load_dependence"] = {"exponent": -0.5, "reference_force": 8.0}
    assert found_in(written(tmp_path, **blocks)) == ["surface_pattern", "load_dependence"]


@pytest.mark.slow
@pytest.mark.parametrize("name", FROM_RUN_TO_RUN)
def test_what_no_effect_stands_for_is_found_by_its_own_name(name, tmp_path):
    more = FROM_RUN_TO_RUN[name]
    warmth = [each.get("ambient_degC", 4.0 * number) for number, each in enumerate(more)]
    parts = [1.0 + 0.012 * degrees for degrees in warmth]
    assert found_in(written(tmp_path, parts, more))[:1] == [name]


@pytest.fixture(scope="module")
def swinging(tmp_path_factory):
    """Rows of a block that swings, slower than the surface; amplitude and angular frequency."""
    time, (amplitude, omega) = np.arange(400) * 0.01, (0.02, 11.0)
    columns = {"t": time, "x": amplitude * np.cos(omega * time)}
    rows = rows_alone(tmp_path_factory.mktemp("swinging"), columns, 1.0, NOISE)
    return rows, amplitude, omega


def test_integrals_of_a_swing_are_exact(swinging):
    """phi (m x'' + K x) of a cosine: a B-spline's transform is a power of sinc."""
    rows, amplitude, omega = swinging
    track, block = rows.track, rows.slip
    done = block.inertia @ track.x + block.force @ (STIFFNESS * track.x)
    support = np.diff(block.force.indptr)
    knots = (support[0] + 1) // 6
    step = knots * track.interval
    middle = np.array([track.time[row].mean() for row in np.split(block.force.indices,
                       block.force.indptr[1:-1])])  # fmt: skip
    transform = step * np.sinc(omega * step / (2.0 * np.pi)) ** 6
    force = (STIFFNESS - MASS * omega**2) * amplitude * np.cos(omega * middle)
    scale = STIFFNESS * amplitude * step
    np.testing.assert_allclose(done, transform * force, atol=1e-5 * scale)


def test_rows_of_noise_have_unit_variance_and_are_independent(swinging):
    block = swinging[0].slip
    noise = NOISE * np.random.default_rng(1).standard_normal((block.place.shape[1], 2000))
    rows = block.whitened(block.place @ noise)
    correlated = np.cov(rows)
    np.testing.assert_allclose(np.diag(correlated), 1.0, atol=5.0 * np.sqrt(2.0 / 2000))
    off = correlated - np.diag(np.diag(correlated))
    assert np.max(np.abs(off)) < 5.5 / np.sqrt(2000)


@pytest.mark.parametrize("apart", [0.2, 0.35])
def test_holes_leave_rows_at_noise_where_every_sample_has_a_row(tmp_path, apart):
    """What a cubic puts into a hole is no sample more, and is off by its remainder."""
    omega, noise = np.sqrt(STIFFNESS / MASS), 2e-5
    time = np.arange(400) * apart / omega
    x = noisy(0.02 * np.cos(omega * time), 0, noise)
    kept = ~np.isin(np.arange(400), [50, 120, 200, 300])
    rows = rows_alone(tmp_path, {"t": time[kept], "x": x[kept]}, 1.0, noise)
    assert rows.track.errors is not None and len(rows) > 390
    assert abs(np.sqrt(np.mean(rows.values**2)) - 1.0) < 3.0 / np.sqrt(2 * len(rows))


@pytest.mark.parametrize(("noise", "sticks"), [(4e-4, 10), (2e-4, 39)])
def test_what_noise_hides_of_a_slip_is_no_stick(tmp_path, noise, sticks):
    """Slips of 2.5 mm at most: with noise of 0.4 mm most of their speeds are below what is seen."""
    moved = motion(0.02, MASS, duration=20.0, mu_s=0.08, mu_k=0.05)
    columns = {"t": moved.time, "x": noisy(moved["x"], 1, noise)}
    rows = rows_alone(tmp_path, columns, 0.02, noise)
    left = rows.values[rows.kinds == STICK]
    assert len(rows.track.sticks) <= sticks
    assert np.sqrt(np.mean(left**2)) < 1.0 + 3.0 / np.sqrt(2 * left.size)


def test_a_wave_is_the_same_from_wherever_it_is_looked_for(tmp_path):
    """On surfaces off by 1 to 2 %: a longer wave on faster ones is nearly the same."""
    pattern = {"amplitude": 0.3, "wavelength": 0.15, "second_amplitude": 0.4}
    off = (0.012, -0.015, 0.01, -0.02, 0.018)
    stated = [{"surface_speed": speed * (1.0 + part)}
              for (_, speed), part in zip(RUNS, off, strict=True)]  # fmt: skip
    system = system_of(written(tmp_path, more=stated, duration=20.0, surface_pattern=pattern))
    rung, kind = system.rung(), periodic.kinds(system.level.kinetic)[0]
    for near in (0.96, 0.98, 0.99, 1.0, 1.01, 1.02, 1.04):
        found = periodic._as_one_shape(rung, kind, near / 0.15)
        assert found.wave.wavenumber == pytest.approx(1.0 / 0.15, rel=5e-3), near
        assert max(map(abs, found.wave.faster.values())) < 0.025
        assert system.rung(found.added).gap < 1.05


@pytest.mark.parametrize(
    ("times", "more", "first", "length"),
    [(2, 0.0, None, 0.15), (3, 0.0, None, 0.15), (2, 50.0, 0.08, 0.15), (2, 50.0, 0.12, 0.3)],
)
def test_a_wave_without_its_first_harmonic_is_a_shorter_one(times, more, first, length, tmp_path):
    """Also where it is less probable by e^50: the model has none of less than a tenth."""
    pattern = {"amplitude": 0.3, "wavelength": 0.15}
    system = system_of(written(tmp_path, duration=20.0, surface_pattern=pattern))
    rung, kind = system.rung(), periodic.kinds(system.level.kinetic)[0]
    longer = periodic._as_one_shape(rung, kind, 1.0 / (times * 0.15))
    assert 1.0 / longer.wave.wavenumber == pytest.approx(times * 0.15, rel=0.02)
    found, sizes = periodic._shortened(rung, longer), longer.sizes
    if more:
        sizes = np.array([first, 1.0, *[0.0] * (sizes.size - 2)])
        better = replace(longer, sizes=sizes, with_moves=found.with_moves + more)
        found = periodic._shortened(rung, better)
    assert 1.0 / found.wave.wavenumber == pytest.approx(length, rel=5e-3)


def test_evidence_is_the_density_of_the_rows():
    random = np.random.default_rng(2)
    columns, rows = random.standard_normal((30, 3)), random.standard_normal(30)
    root = random.standard_normal((3, 3))
    prior = root @ root.T
    found = posterior(columns.T @ columns, columns.T @ rows, rows @ rows, prior)
    covariance = np.eye(30) + columns @ prior @ columns.T
    density = multivariate_normal(np.zeros(30), covariance).logpdf(rows)
    assert found.log_evidence - 15.0 * np.log(2.0 * np.pi) == pytest.approx(density)
    gain = prior @ columns.T @ np.linalg.inv(covariance)
    np.testing.assert_allclose(found.mean, gain @ rows)
    np.testing.assert_allclose(found.covariance, prior - gain @ columns @ prior, atol=1e-12)


@pytest.fixture(scope="module")
def system(tmp_path_factory):
    """Of a campaign that lacks nothing; the last run is held out."""
    return system_of(written(tmp_path_factory.mktemp("plain"), held_out=(4,)), every=False)


def test_evidence_of_a_campaign_is_that_of_its_dense_covariance(system):
    """Averaged over how far friction scatters and how far the zeros lie apart."""
    rung, count, runs = system.rung(), system.rows.size, len(system.fitted)
    densities = []
    for (scatter, zeros), weight in zip(*rung.settings, strict=True):
        covariance = np.eye(count)
        for each in rung.unknowns:
            unknown = each.unknown
            part = {SCATTER: scatter, ZERO_NAME: zeros}.get(unknown.name, 1.0)
            columns = unknown.columns(system.fitted)
            prior = np.kron(np.eye(runs), unknown.prior) if unknown.per_run else unknown.prior
            covariance += part**2 * columns @ prior @ columns.T
        lower = np.linalg.cholesky(covariance)
        white = np.linalg.solve(lower, system.rows)
        densities.append(weight - 0.5 * white @ white - np.log(np.diag(lower)).sum())
    assert rung.evidence == pytest.approx(logsumexp(densities), rel=1e-9)


def test_what_is_expected_of_scatter_is_what_the_campaign_states(system):
    """Half-normal, of `errors.friction`: 2 % where nothing is said."""
    wider = replace(system.campaign, errors=system.campaign.errors.model_copy(
        update={"friction": 0.06}))  # fmt: skip
    settings, narrow = system.rung().settings
    wide = System(wider, system.runs).rung().settings[1]
    at = [int(np.flatnonzero(np.isclose(settings[:, 0], part))[0]) for part in (0.002, 0.06)]
    expected = -0.5 * (0.06**2 - 0.002**2) / np.square([0.02, 0.06])
    found = [weights[at[1]] - weights[at[0]] for weights in (narrow, wide)]
    assert found == pytest.approx(list(expected))


@pytest.mark.parametrize("zero", [1e-4, 5e-4])
@pytest.mark.parametrize("size", [0.0, 0.03])
def test_scatter_lies_in_its_interval_whatever_the_zeros_may_be(tmp_path, size, zero):
    """Zeros of half a millimetre push a block aside as 3 % of its friction do."""
    parts = 1.0 + size * np.array([1.2, -0.9, 0.4, -1.3, 0.6])
    campaign = written(tmp_path, parts=parts)
    errors = campaign.errors.model_copy(update={"zero": zero / NOISE})
    scatter = Scatter.of(system_of(replace(campaign, errors=errors)).rung())
    _, low, high = scatter.seen
    assert (low < 1e-3 and high < 0.02) if size == 0.0 else low < np.std(parts) < high
    assert scatter.expected[2] <= high
    text = scatter_text(scatter.seen)
    assert ("at most" in text) == (low < 2.0 * SCATTER_RANGE[0])


def test_a_run_that_no_fit_has_seen_is_left_with_its_noise(system, tmp_path):
    rung, run = system.rung(), system.held_out[0]
    left = rung.left(run)
    assert np.sqrt(np.mean(left**2)) == pytest.approx(1.0, abs=4.0 / np.sqrt(2.0 * left.size))
    assert rung.held_out_gap == pytest.approx(np.sqrt(np.mean(left**2)))
    # friction of its own by a fifth is more than the scatter that the others show
    other = system_of(written(tmp_path, [1.0, 1.0, 1.0, 1.0, 1.2], held_out=(4,)), every=False)
    assert other.rung().held_out_gap > 1.3 * rung.held_out_gap


def test_intervals_of_both_coefficients_hold_the_truth(tmp_path):
    """Over twelve recordings: the squares of what they are off by, in standard deviations."""
    off = []
    for seed in range(12):
        folder = tmp_path / str(seed)
        folder.mkdir()
        campaign = written(folder, seed=seed)
        rows = [rows_of(smooth(run), campaign.rig) for run in campaign.runs]
        rung = System(campaign, rows).rung()
        mean, covariance = rung.posterior
        for name, truth in ((MU_K, FRICTION["mu_k"]), (MU_S, FRICTION["mu_s"])):
            added = next(each for each in rung.base if each.unknown.name == name)
            part = rung.part_of(added)
            off.append((mean[part][0] - truth) / np.sqrt(covariance[part, part][0, 0]))
    within = np.mean(np.abs(off) < 1.645)
    assert within >= 0.7, off  # 90 % of 24: 17 at least


def test_columns_of_a_run_are_cut_from_those_of_all(tmp_path):
    """What the unknown makes of that run alone, held out or not, its own or shared; to rounding, as
    a product of other shapes adds up in another order on some processors."""
    system = system_of(written(tmp_path, held_out=(1,)), every=False)
    assert len(system.held_out) == 1
    for each in system.rung().unknowns:
        for run in system.runs:
            alone = each.unknown.columns([run])
            found = system.columns_of(each.unknown, run)
            np.testing.assert_allclose(found, alone, rtol=1e-12, atol=1e-12 * np.abs(alone).max())
