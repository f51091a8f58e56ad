"""What moves the block across: each effect is named from y, its size recovered, x left clean."""

import numpy as np
import pytest
from gap_campaigns import campaign_with, motion, noisy

from cosim.gap.naming import Naming
from cosim.gap.weak_form import across
from cosim.gap.weak_form import planar as in_plane
from cosim.gap.weak_form.across import disc
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.planar import planar_effects, rows_in_plane
from cosim.gap.weak_form.rig_unknowns import Level
from cosim.gap.weak_form.rows import rows_of
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import smooth
from cosim.gap.windows import windows_of_campaign

NOISE, DURATION = 1e-4, 12.0
SPEEDS, HELD_OUT = (0.04, 0.09, 0.06), 0.06
ISOTROPIC = {"lateral_friction": {"ratio": 1.0}}
#: Effect -> blocks of the simulation, unknown, truth.
EFFECTS = {
    "lateral_friction": ({"initial": {"y": 8e-3}}, "ratio", 1.0),
    "turning_surface": ({"turning_surface": {"curvature": 1.2}}, "curvature", 1.2),
    "spring_misalignment": ({"spring_misalignment": {"angle_deg": 3.0}}, "turn", np.deg2rad(3.0)),
}


def measured(
    folder, rotation=(0.0, 0.0, 0.0), creep=0.0, turn_noise=None, lost=(0.0, 0.0), **blocks
):
    """A campaign of three runs in the plane.

    rotation : of the camera in each, rad; creep : of its zero across, as the root of the time, m;
    turn_noise : of the block's turn, rad, where the tracker has it; lost : from when to when it
    has lost the block, s
    """
    noise = {"x": NOISE, "y": NOISE} | ({"phi": turn_noise} if turn_noise else {})
    runs = []
    for number, (speed, angle) in enumerate(zip(SPEEDS, rotation, strict=True)):
        moved = motion(speed, duration=DURATION, **blocks)
        x, y = np.asarray(moved["x"]), np.asarray(moved["y"])
        y = y + creep * np.sqrt(moved.time / DURATION)
        columns = {
            "t": moved.time,
            "x": noisy(x * np.cos(angle) + y * np.sin(angle), number, NOISE),
            "y": noisy(y * np.cos(angle) - x * np.sin(angle), number + 50, NOISE),
        }
        if turn_noise:
            columns["phi"] = noisy(np.asarray(moved["phi"]), number + 90, turn_noise)
        kept = (moved.time < lost[0]) | (moved.time >= lost[1])
        columns = {name: values[kept] for name, values in columns.items()}
        runs.append({"surface_speed": speed, "columns": columns, "hold_out": speed == HELD_OUT})
    return campaign_with(folder, runs, noise=noise)


def tracks_and_rows(campaign):
    tracks = [smooth(run) for run in campaign.runs]
    return tracks, [rows_of(track, campaign.rig) for track in tracks]


def planar_of(folder, **given):
    """What moves the block across in a campaign of these."""
    campaign = measured(folder, **given)
    return planar_effects(campaign, tracks_and_rows(campaign)[1])


def most_spurious(campaign, rows):
    """ln evidence that the best of all arguments adds to rows along x."""
    rung = System(campaign, rows).rung()
    unknowns = Arguments(campaign, rows, Level.of(rows)).unknowns()
    return max(rung.offered(variants)[0] for variants in unknowns.values()) - rung.evidence


@pytest.mark.parametrize("effect", EFFECTS)
def test_an_effect_is_named_and_its_size_recovered(effect, tmp_path):
    blocks, number, truth = EFFECTS[effect]
    campaign = measured(tmp_path, **ISOTROPIC, **blocks)
    tracks, rows = tracks_and_rows(campaign)
    planar = planar_effects(campaign, rows)
    assert planar.answer == effect
    assert planar.fits[effect].gap < 1.1  # of the run held out, too
    value, deviation = planar.numbers[number]
    assert value == pytest.approx(truth, abs=4.0 * deviation + 0.02 * truth)
    assert most_spurious(campaign, rows_in_plane(tracks, campaign, planar)) < 4.0


def test_springs_turned_by_far_are_found_where_nothing_holds_the_block(tmp_path):
    """From springs along x the courses of a block that swings freely do not lead there."""
    blocks = {"spring_misalignment": {"angle_deg": -10.0}, "initial": {"phi": 0.1}}
    planar = planar_of(tmp_path, turn_noise=5e-4, **blocks)
    assert planar.answer == "spring_misalignment" and planar.fits[planar.answer].gap < 1.3
    assert planar.numbers["turn"][0] == pytest.approx(np.deg2rad(-10.0), rel=0.05)


def test_what_springs_do_in_a_hole_of_the_record_does_not_swing_on(tmp_path):
    """Nothing damps the block across, and nobody knows where it was along x meanwhile."""
    blocks = {"spring_misalignment": {"frame_angle_deg": 9.0}, "initial": {"phi": 0.1}}
    planar = planar_of(tmp_path, turn_noise=5e-4, lost=(5.0, 5.5), **blocks)
    assert planar.answer == "spring_misalignment" and planar.fits[planar.answer].gap < 1.3
    assert planar.numbers["frame"][0] == pytest.approx(np.deg2rad(9.0), rel=0.05)


PLACED = {
    "frame": ({"frame_angle_deg": 9.0}, {"frame": np.deg2rad(9.0)}),
    "one diagonal": (
        {"lateral_offset": 5e-3, "diagonal_offset": 5e-3}, {"shift": 5e-3, "diagonal": 5e-3},
    ),
}  # fmt: skip


@pytest.mark.parametrize("placed", PLACED)
def test_a_turned_frame_and_a_diagonal_that_is_off_are_told_from_turned_springs(placed, tmp_path):
    blocks, numbers = PLACED[placed]
    initial = {"phi": 0.1}
    planar = planar_of(tmp_path, turn_noise=5e-4, spring_misalignment=blocks, initial=initial)
    assert planar.answer == "spring_misalignment" and planar.fits[planar.answer].gap < 1.3
    found = {name: value for name, (value, _) in planar.numbers.items()}
    assert found == pytest.approx(numbers, rel=0.05)  # springs are off by some percent


def test_a_swing_across_that_a_turned_camera_mixes_into_x_asks_for_nothing_along_it(tmp_path):
    campaign = measured(tmp_path, rotation=[0.09] * 3, initial={"y": 5e-3})
    named = Naming.of(campaign).named()
    assert [each.name for each in named.findings] == ["measurement.rotation"]
    assert named.rung.gap < 1.1


@pytest.mark.parametrize("turned", [(1, 1, 1), (1, 0, 1)])
def test_a_turned_camera_is_named_and_the_runs_in_which_it_is(turned, tmp_path):
    planar = planar_of(tmp_path, rotation=[0.03 * each for each in turned])
    assert planar.answer == "measurement.rotation"
    value, deviation = planar.numbers["measurement.rotation"]
    assert value == pytest.approx(0.03, abs=4.0 * deviation + 3e-4)
    told = {f"in@run{number:02d}": float(each) for number, each in enumerate(turned, 1)}
    assert planar.settings == ({} if all(turned) else told)


def test_a_block_that_stays_on_the_axis_shows_nothing(tmp_path):
    planar = planar_of(tmp_path, **ISOTROPIC)
    assert planar.answer == "" and not planar.evidence


@pytest.mark.parametrize("creep", [0.0, 8e-3])
def test_a_block_that_swings_freely_shows_no_effect(creep, tmp_path):
    assert planar_of(tmp_path, creep=creep, initial={"y": 5e-3}).answer == ""


@pytest.mark.parametrize("deviations, answer", [(3.5, ""), (4.5, "spring_misalignment")])
def test_a_form_whose_numbers_may_be_zero_is_a_swing(deviations, answer, tmp_path, monkeypatch):
    """Of a turn that is not measured the rounds of one form find more than those of another."""

    def fitted(campaign, runs, level, form, turned):
        shifted = form == ("shift",)
        number = {name: (deviations * 1e-4, 1e-4) for name in form}
        return in_plane.Fitted(form, 100.0 * shifted, number, {}, 1.0 if shifted else 2.0, turned)

    monkeypatch.setattr(in_plane, "_best_fit", fitted)
    assert planar_of(tmp_path, initial={"y": 5e-3}).answer == answer


@pytest.mark.parametrize("more, answer", [(8.0, "lateral_friction"), (12.0, "turning_surface")])
def test_how_the_load_lies_on_the_contact_is_no_effect_of_its_own(
    more, answer, tmp_path, monkeypatch
):
    """A hundredth of what friction across explains may be an uneven load's."""

    def fitted(campaign, runs, level, form, turned):
        evidence = 1000.0 if form == ("share",) else (1000.0 + more) * (form[:1] == ("curvature",))
        number = {"ratio" if name == "share" else name: (0.5, 1e-3) for name in form}
        return in_plane.Fitted(form, evidence, number, {}, 1.0 if form else 9.0, turned)

    monkeypatch.setattr(in_plane, "_best_fit", fitted)
    assert planar_of(tmp_path, initial={"y": 5e-3}).answer == answer


def test_zeros_far_beyond_their_stated_error_explain_no_place_beside_the_axis(tmp_path):
    """Not even beside anchors that turn the block, too, which no tracker has seen."""
    anchors = {"lateral_offset": 9e-3, "diagonal_offset": 9e-3}
    initial = {"y": 9e-3, "phi": 0.3}
    planar = planar_of(tmp_path, spring_misalignment=anchors, initial=initial)
    assert planar.answer == "spring_misalignment"
    assert planar.numbers["shift"][0] == pytest.approx(9e-3, rel=0.05)


def test_a_camera_that_creeps_moves_no_block(tmp_path):
    planar = planar_of(tmp_path, creep=8e-3, **ISOTROPIC)
    assert planar.answer == "" and planar.fits[""].form == ("measurement.drift, root",)


def test_friction_of_a_disc_at_its_limits():
    """f = 1, m = s / (4 U) at little spin; f = U / s, m = 2/3 at little sliding."""
    force, moment = disc(np.array([1.0, 0.01]), np.array([0.01, 1.0]))
    np.testing.assert_allclose(force, [1.0, 0.01], rtol=1e-3)
    np.testing.assert_allclose(moment, [0.0025, 2.0 / 3.0], rtol=1e-3)


@pytest.mark.parametrize(("curvature", "moves"), [(0.12, True), (0.0, False)])
def test_what_moves_a_block_across_in_the_rows_is_simulated_in_the_plane(
    curvature, moves, tmp_path
):
    """By half a noise unit and less: of a guided block a turning surface would make a long fit."""
    campaign = measured(
        tmp_path, turning_surface={"curvature": curvature}, lateral_friction={"ratio": 1.0}
    )
    assert any(across.moves_across(run) for run in campaign.runs) is moves
    assert all(windows.is_planar for windows in windows_of_campaign(campaign).values()) is moves
    for run in campaign.runs:
        assert np.std(run.motion["y"]) < 1.2 * NOISE
