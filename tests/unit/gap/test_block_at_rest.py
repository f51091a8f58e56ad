"""A block that comes to rest on its springs: its noise is neither motion nor the cause of any."""

from functools import cache

import numpy as np
import pytest
from gap_campaigns import KNOWN, RIG, campaign_with, noisy

from cosim.gap.data.campaign_file import Rig
from cosim.gap.extended import part_of
from cosim.gap.naming import Naming
from cosim.gap.report_of_findings import exponents_of
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.rig_geometry import spring_loads
from cosim.gap.weak_form.rows import Response
from cosim.gap.weak_form.track import smooth
from cosim.gap.weak_form.unknowns import Unknown, column

MASS, NOISE, INTERVAL = KNOWN["mass"], 3e-4, 1.0 / 60.0
STIFFNESS = -(spring_loads(Rig(**RIG), KNOWN["stiffness"], np.array([1e-3]))[0][0]) / 1e-3
DAMPING = 1.5
SPEEDS = (0.06, 0.09, 0.12, 0.16, 0.2)


def ringing(speed, of_film, duration=25.0, swing=2e-3, damping=DAMPING):
    """Times and x: m x'' + c x' + K x = mu_k m g, and c V of a film, with V > x' all along."""
    time = np.arange(0.0, duration, INTERVAL)
    pulled = 0.2 * MASS * 9.81 + damping * speed * of_film
    slow = damping / (2.0 * MASS)
    omega = np.sqrt(STIFFNESS / MASS - slow**2)
    return time, pulled / STIFFNESS + swing * np.exp(-slow * time) * np.cos(omega * time)


def campaign_of(folder, of_film, **how):
    runs = []
    for number, speed in enumerate(SPEEDS):
        time, x = ringing(speed, of_film, **how)
        runs.append({"surface_speed": speed, "columns": {"t": time, "x": noisy(x, number, NOISE)}})
    return campaign_with(folder, runs, noise={"x": NOISE})


@pytest.fixture(scope="module")
def named(tmp_path_factory):
    """Whether the damping is of a film -> the campaign and what is named of it, searched once."""

    @cache
    def look_up(of_film):
        campaign = campaign_of(tmp_path_factory.mktemp("campaign"), of_film)
        return campaign, Naming.of(campaign).named()

    return look_up


@pytest.mark.parametrize("of_film", [True, False])
def test_a_film_and_a_damper_are_told_by_where_the_block_rests(of_film, named):
    """Before, the noise of speeds made shutters, resonators and hardening springs of both."""
    _, named = named(of_film)
    finding = named.findings[0]
    assert [each.name for each in named.findings] == [
        "film_drag" if of_film else "structural_damping"
    ]
    other = "structural_damping" if of_film else "film_drag"
    assert finding.others[other] < 0.0


@pytest.mark.parametrize("of_film", [True, False])
def test_damping_is_as_large_as_it_is(of_film, tmp_path):
    """Where a regressor is mostly noise its coefficient is drawn to 0: a quarter of it was left."""
    system = Naming.of(campaign_of(tmp_path, of_film)).system

    def force(run):
        film = column(run.track.sliding * run.track.direction**2)
        return Response(force=film if of_film else column(-run.track.velocity))

    added = Added(Unknown("damping", "", force, 10.0**2 * np.eye(1)))
    rung = system.rung([added])
    place = rung.part_of(added)
    value, sd = rung.posterior[0][place][0], np.sqrt(rung.posterior[1][place, place][0, 0])
    assert value == pytest.approx(DAMPING, abs=2.0 * sd) and sd < 0.3
    assert rung.gap == pytest.approx(1.0, abs=3.0 / np.sqrt(2 * system.rows.size))


@pytest.mark.parametrize(("swing", "at_rest"), [(0.0, 1.0), (1.6, 0.0), (0.75, 1.0)])
def test_a_block_rests_whose_swings_are_no_more_than_noise(swing, at_rest, tmp_path):
    """swing : amplitude in noise, of a root mean square of 0.7 times as much beside it"""
    run = campaign_of(tmp_path, False, swing=swing * NOISE, damping=0.0).runs[0]
    track = smooth(run)
    assert np.mean(track.at_rest) == pytest.approx(at_rest, abs=0.15)
    assert np.all(track.velocity[track.at_rest] == 0.0)
    assert np.std(track.cause[track.at_rest]) < 0.5 * NOISE or at_rest == 0.0


def test_the_power_of_a_force_counts_all_forms_of_its_curve(named):
    """Smooth over the speed or over its root: the rows hardly tell."""
    campaign, named = named(True)
    finding = named.findings[0]
    part = part_of(campaign, named.system, named.rung, finding)
    (found,) = exponents_of(part, named.rung, named.unknowns)
    plain, steep = (
        list(exponents_of(part, named.rung, {finding.main.unknown.name: [form]}))[0]
        for form in named.unknowns["film_drag"]
    )
    assert found.low <= 1.0 <= found.high and found.low <= found.value <= found.high
    # between the two, neither as sure as the surer one
    assert min(plain.low, steep.low) <= found.low and found.high <= max(plain.high, steep.high)
    assert found.high - found.low > plain.high - plain.low
