"""The reproduction: verdicts follow from numbers; the sheet; command, page, JSON."""

import json
import math
from dataclasses import replace
from itertools import product

import numpy as np
import pytest
from command_line import executed
from stickslip.reference.scheme_options import DESCRIPTIONS

from cosim.cli import main
from cosim.cli.studies import reproduce as reproduction_command
from cosim.report.files import json_text
from cosim.studies import reproduction
from cosim.studies.reproduction import Check, Claim, Reproduction, reproduce
from cosim.studies.reproduction import claim as sheet
from cosim.studies.reproduction.motion import Motion, figures


def claim_of(*checks: Check) -> Claim:
    row = reproduction.Row("q", "m", 1.0, "§0", printed=2.0, mended=math.nan)
    return Claim("C0", "a claim", rows=[row], checks=list(checks))


@pytest.mark.parametrize("answers", list(product((True, False, None), repeat=3)))
def test_a_part_is_decided_by_the_soundest_model_that_can_tell(answers):
    decides = next((one for one in reversed(answers) if one is not None), None)
    fails = sheet.ONLY_WITH_FAULT if answers[0] else sheet.DOES_NOT_HOLD
    expected = {None: sheet.CANNOT_BE_CHECKED, True: sheet.HOLDS, False: fails}[decides]
    assert Check("it is so", *answers).verdict == expected


@pytest.mark.parametrize(("sound", "weight", "verdict"), [
    (True, sheet.PUT_IN, "follows from the assumption"),
    (True, sheet.OPEN, "undecided"),
    (False, sheet.OPEN, "undecided"),
    (False, sheet.PUT_IN, "does not hold"),
    (True, sheet.FAR, "holds"),
])  # fmt: skip
def test_a_turn_softens_the_verdict(sound, weight, verdict):
    turned = sheet.Turn("another law", "it is otherwise", not sound, weight)
    kept = sheet.Turn("another start", "it is the same", sound, weight)
    check = Check("it is so", False, None, sound, turns=[kept, turned])
    assert check.verdict == verdict and claim_of(check).turns == [turned]
    untouched = replace(check, turns=[kept])
    assert untouched.verdict == (sheet.HOLDS if sound else sheet.DOES_NOT_HOLD)
    assert claim_of(untouched).steady and claim_of(untouched).turns == [kept]


def test_a_claim_is_as_good_as_its_worst_part():
    good = Check("good", True, True, True, margin=sheet.Margin("size", 0.5, 1.0, "mm"))
    faulty = Check("faulty", True, False, False, faults=("F12", "F2"))
    bad = Check("bad", False, False, False)
    open_ = Check("open", None, None, None)
    assert claim_of(good).margins[0].text == "size 0.5 mm, limit 1 mm"
    assert claim_of(good, open_).verdict == "holds"
    assert claim_of(good, faulty).verdict == "holds only with fault F2, F12"
    assert claim_of(good, faulty, bad).verdict == "does not hold"
    assert claim_of(open_).verdict == "cannot be checked"
    assert "(other parts: 1 holds, 1 holds only with fault)" in claim_of(good, faulty, bad).reason
    turn = sheet.Turn("a change", "x", True, sheet.OPEN)
    undecided = Check("open", True, True, False, turns=[turn])
    assert claim_of(faulty, undecided).verdict == "undecided"
    assert claim_of(good, bad).reason.startswith("bad (as printed: no")


def test_faults_behind_a_part_are_found_alone_and_in_pairs():
    assert sheet.responsible(lambda faults: faults.F2 and faults.F6) == ("F2", "F6")
    assert sheet.responsible(lambda faults: False) == sheet.responsible(lambda faults: True) == ()
    pairs = sheet.responsible_pairs(lambda faults: faults.F1 or faults.F2)
    assert pairs == (("F1", "F2"),)
    both = Check("so", True, False, None, together=pairs)
    assert "ended by mending F1 and F2" in both.verdict_with_faults
    several = replace(both, together=()).verdict_with_faults
    assert several == "holds only with fault of the scheme (several together)"


@pytest.mark.parametrize("size", [1.0, 2.0, 2.1])
def test_numbers_are_judged_by_the_written_limit(monkeypatch, size):
    written = {
        "title": "small", "place": "§1", "rests": "{n} runs", "assumed": ["masses", "own"],
        "scope": "up to {n}", "remarks": ["{n} of them"],
        "row": {"size": {"says": "size of {who}", "unit": "m", "study": "camera_mK"}},
        "check": {"below": {"says": "below", "margin": "size", "so": "at most", "limit": 2.0}},
        "turn": {"wider": {"change": "wider", "figure": "size {value:.1f}", "weight": "open"}},
    }  # fmt: skip
    monkeypatch.setitem(sheet.WRITTEN, "C0", written)

    def judge(claim):
        claim.row("size", [size, None, math.nan], who="a block")
        claim.check("below", [None, 3.0, size])
        claim.turn("wider", 2.0 * size)
        return {"n": 7}

    claim = sheet.judged("C0", judge)
    check, row = claim.checks[0], claim.rows[0]
    assert (check.printed, check.mended, check.exact) == (None, False, size <= 2.0)
    assert check.margin == sheet.Margin("size", size, 2.0)
    assert check.turns == [sheet.Turn("wider", f"size {2 * size:.1f}", size <= 1.0, sheet.OPEN)]
    assert (row.quantity, row.place, row.printed) == ("size of a block", "§3.3.3, §6.1", size)
    assert (claim.rests, claim.scope, claim.remarks) == ("7 runs", "up to 7", ["7 of them"])
    assert claim.assumed == [sheet.WRITTEN["assumed"]["masses"], "own"]


def test_figures_of_a_known_motion():
    time = np.linspace(0.0, 10.0, 20001)
    x = 0.02 + 0.01 * np.sin(2.0 * np.pi * 1.7 * time)
    phi = np.radians(20.0) * np.cos(2.0 * np.pi * 0.5 * time)  # 40 degrees in a second
    phases = np.array([[0.0, 1.0, 0.0], [1.0, 4.0, 1.0], [4.0, 5.0, 0.0], [5.0, 10.0, 1.0]])
    motion = Motion(time, x, 0.001 + 0 * x, phi, 0 * x, (time > 1.0).astype(float), phases)
    ours = figures(motion)
    assert ours["oscillations"] == pytest.approx(34.0, abs=1e-4)
    assert ours["mean_x"] == pytest.approx(0.02, abs=1e-6)
    assert ours["amplitude_x"] == pytest.approx(0.01, abs=1e-8)
    assert ours["slip_share"] == pytest.approx(0.8)
    assert (ours["slip_duration"], ours["stick_duration"]) == pytest.approx((3.0, 1.0))
    assert ours["max_rotation"] == pytest.approx(20.0, rel=1e-6)
    assert ours["mean_y"] == pytest.approx(0.001)
    assert ours["swing_rate"] == pytest.approx(40.0, rel=1e-3)
    assert figures(motion.between(4.5))["slip_share"] == pytest.approx(5.0 / 5.5)
    unseen = figures(motion, visible=0.1)
    assert math.isnan(unseen["oscillations"])
    # of several the mean of those that have it
    both = figures(motion, motion.between(4.5))
    assert both["slip_share"] == pytest.approx(0.5 * (0.8 + 5 / 5.5))
    assert figures(motion, motion.between(6.0))["stick_duration"] == pytest.approx(1.0)


def test_ids():
    assert reproduction.claim_ids(["c14", "C2", "C2"]) == ("C2", "C14")
    assert len(reproduction.claim_ids([])) == 18
    said = "claim 'C19': unknown, allowed are C1 to C18"
    with pytest.raises(reproduction.UnknownClaim, match=said):
        reproduction.claim_ids(["C1", "C19"])


@pytest.fixture(scope="module")
def quick() -> Reproduction:
    """Claims that take less than a second together."""
    return reproduce(["C1", "C2", "C3"])


def test_json(quick):
    scoped = replace(claim_of(Check("good", True, True, True)), scope="up to 0.44 m/s")
    data = json.loads(json_text(Reproduction([*quick, scoped]).summary()))
    assert [one["id"] for one in data["claims"]] == ["C1", "C2", "C3", "C0"]
    numbers = data["claims"][0]["numbers"][0]
    assert set(numbers) == {
        "quantity", "unit", "study", "place", "derived", "how", "digits",
        "printed", "mended", "exact",
    }  # fmt: skip
    assert (numbers["study"], numbers["place"]) == (4.0, "§4.2.2, eq. 4.16")
    drift = data["claims"][1]["numbers"][0]
    assert drift["study"] is None and drift["how"] == "½ µ_k g t²"
    assert drift["derived"] == pytest.approx(0.5 * 0.2086 * 9.81 * 20.0**2)
    assert data["datasets"] is None  # no claim was asked for that hangs on them
    for one in data["referee"][:3]:
        assert one["margins"] and one["turns"] and one["rests_on"] and one["place"]
        assert not one["steady"]  # what would turn it was found
    assert data["referee"][3]["scope"] == "up to 0.44 m/s"
    assert data["faults"].keys() >= DESCRIPTIONS.keys()
    assert data["claims"][3]["numbers"][0]["mended"] is None


def test_page(quick):
    html = quick._page()
    first_table = html[html.index("<tbody>") : html.index("</tbody>")]
    assert first_table.count("<tr>") == 3
    assert "http" not in html  # needs nothing but itself
    assert html.count('class="verdict holds"') >= 6
    assert "&lt;" not in Reproduction([claim_of()])._page()
    # a fault is explained before it is named in a verdict, and what is read before its numbers
    assert html.index(DESCRIPTIONS["F1"].split(",")[0]) < html.index("Referee")
    drift = html[html.index('<h2 id="C2"') :]
    assert drift.index("Both drifts are without bound") < drift.index("<table>")


def test_command(tmp_path, capsys):
    folder, result = tmp_path / "out", tmp_path / "numbers.json"
    status = executed(reproduction_command, "C3", "C1", "-o", str(folder), "--json", str(result))
    captured = capsys.readouterr()
    assert status == 0
    lines = captured.out.splitlines()
    assert [line[:2] for line in lines[:4:3]] == ["C1", "C3"]
    assert all(line.startswith("     turned by: ") for line in lines[2:6:3])
    assert captured.err == ""  # no progress bar where there is no terminal
    assert (folder / "report.html").exists()
    assert len(json.loads(result.read_text())["claims"]) == 2
    assert (folder / "reproduction.json").read_text() == result.read_text()


@pytest.mark.parametrize("judged", [0, 1])
def test_what_was_judged_before_ctrl_c_is_kept(tmp_path, capsys, monkeypatch, judged):
    def interrupted(ids):
        if len(seen) == judged:
            raise KeyboardInterrupt
        seen.extend(ids)
        return reproduce(ids)

    seen = []
    monkeypatch.setattr(reproduction_command, "reproduce", interrupted)
    status = main(["reproduce", "C1", "C2", "-o", str(tmp_path)])
    out, err = capsys.readouterr()
    assert (status, out, err.count("\n")) == (1, "", 1)
    assert err.startswith("error: interrupted")
    if judged:
        assert "1 of 2 claims are in" in err
        claims = json.loads((tmp_path / "reproduction.json").read_text())["claims"]
        assert [claim["id"] for claim in claims] == ["C1"]
    assert (tmp_path / "report.html").is_file() == bool(judged)
