"""Headline, ranking, table, page and JSON of an answer say one thing, whatever was found."""

from dataclasses import replace
from types import SimpleNamespace

import gap_answers as answers
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from cosim.gap import read_campaign
from cosim.gap.extended import Part
from cosim.gap.find import find_gap
from cosim.gap.judge import judge
from cosim.gap.laws import FreeCurve
from cosim.gap.quantities import digits, fitted_quantities, percent
from cosim.gap.rates import by_direction
from cosim.gap.report_of_findings import ranking_of, sentence_of
from cosim.gap.result import Exponent, Rates, Rejected, Rung, Score
from cosim.gap.show import files, text
from cosim.gap.show.numbers import as_data
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.ladder import Finding
from cosim.gap.weak_form.unknowns import Curve, Unknown
from cosim.gap.windows import Number

NAMES = ("film_drag", "structural_damping", "run_in", "velocity_weakening")
KEY = "film_drag.coefficient"
SPEED = np.array([0.1, 0.4])


def found(gain, others):
    """film_drag with a curve that says 0.35 N s/m; the simulated runs may say another number."""
    curve = Curve("sliding speed", "m/s", SPEED, "N")
    unknown = Unknown("film_drag", "memory 8.2 s", None, np.eye(2), curve=curve)
    finding = Finding("film_drag", (Added(unknown),), gain, others)
    drawn = FreeCurve(SPEED, 0.35 * SPEED, 1e-6 * np.eye(2))
    law = SimpleNamespace(effect="film_drag", candidate=SimpleNamespace(form="linear"))
    return Part(finding, drawn, (law,), (Number(KEY, 0.35, None, 0.0, 5.0),))


def answered(gap, part, value, sd, after, held_out, rejected=()):
    """What the workflow makes of one finding, or of none, from the functions that it calls."""
    parts = [part] if part else []
    extended = replace(gap.extended, values=gap.extended.values | {KEY: value},
                       sd=gap.extended.sd | {KEY: sd}) if part else gap.plain  # fmt: skip
    first = gap.ladder[0]
    share = min(max(1.0 - (after**2 - 1.0) / (first.gap.fit**2 - 1.0), 0.0), 1.0)
    last = Rung("film_drag" if part else "contact", "a finding", Score(after, held_out),
                first.weak, share, 10.0)  # fmt: skip
    ladder = (first, last)
    offers = {name: (-5.0 - place, ()) for place, name in enumerate(NAMES)}
    system = SimpleNamespace(rung=lambda: SimpleNamespace(evidence=0.0))
    rows = SimpleNamespace(first_offers=offers, system=system)
    verdict = judge([one.finding for one in parts], [one.effect for one in parts], ladder,
                    set(NAMES))  # fmt: skip
    made = replace(
        gap, verdict=verdict.verdict, effects=verdict.effects, classes=verdict.classes,
        ladder=ladder, extended=extended, ranking=ranking_of(rows, parts, extended, last.gap),
        laws=(), doubts=(), rejected=rejected, rates=None,
        exponents=(Exponent("film_drag", "sliding speed", 0.7, 0.6, 0.8, 1.0),) if part else (),
    )  # fmt: skip
    return replace(made, sentence=sentence_of(made, parts, [one.effect for one in rejected]))


def page_of(gap):
    """The page's text; without pictures, and nobody asks the FMU."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(files, "reproduction_line", lambda gap: "")
        return answers.words_of(files._page(gap, [], []))


def contradictions(gap):
    """What two places of an answer say differently of one thing, a line each."""
    data, page, said = as_data(gap, "model.toml"), page_of(gap), gap.sentence
    numbers = {one.key: one for one in fitted_quantities(gap) if not one.owner}
    first = gap.ranking[0] if gap.ranking else None
    yield "json verdict", data["verdict"] == gap.verdict and data["effects"] == list(gap.effects)
    ranked = [row["effect"] for row in data["ranking"]]
    yield "json ranking", ranked == [row.effect for row in gap.ranking]
    yield "page verdict", page.index(gap.verdict) < page.index(said) < 200
    yield "terminal", said in "\n".join(text.closing_lines(gap)) and text.gap_line(gap) in page
    yield "probabilities", sum(row.probability for row in gap.ranking) < 1.0 + 1e-9
    if gap.effects:
        yield "first", first.effect in gap.effects and all(name in said for name in gap.effects)
        members = sum(row.probability for row in gap.ranking if row.effect in gap.effects)
        # of a partial answer others together may be more probable: it names the first alone
        yield "certain", members > 0.5 or gap.verdict == "partial"
        yield "most probable", first.probability == max(row.probability for row in gap.ranking)
        # or it is noise before and after
        yield "helps", gap.after.of_verdict < max(gap.before.of_verdict, 1.02)
    yield "none is said", ("No effect is missing" in said) == (gap.verdict == "none")
    order = [row.probability for row in gap.ranking]
    yield "in order", order == sorted(order, reverse=True)
    if gap.verdict == "class":
        least = min(row.evidence for row in gap.ranking if row.effect in gap.effects)
        rest = [row.evidence for row in gap.ranking if row.effect not in gap.effects]
        yield "members first", max(rest, default=-np.inf) <= least and "cannot tell" in said
    if gap.verdict == "none":
        yield "none is certain", all(row.probability < 0.5 for row in gap.ranking)
        yield "none is noise", "held-out runs is more" not in text.what_is_left(gap)
    if gap.verdict == "partial":
        yield "share", percent(gap.share) in said and percent(gap.share) in page
    for row in gap.ranking:
        for key, value in row.parameters.items():
            low, high = row.intervals.get(key, (-np.inf, np.inf))
            vague = numbers[key].value in ("not determined", "at its bound")
            yield f"{key} inside", low <= value <= high
            yield f"{key} told", vague == (key not in row.intervals)
            undetermined = data["extended"]["undetermined"]
            yield f"{key} vague", (key in undetermined) == (key in row.undetermined)
            size = numbers[key].text.partition(".")[2]
            is_answer = gap.verdict != "unknown" and row.effect in said
            yield f"{key} size", (size in said) == (not vague and is_answer)
            yield f"{key} shown", numbers[key].text in page
    yield "one size", "N at" not in said or not any(row.intervals for row in gap.ranking)
    for row in gap.rejected:
        yield "rejected", row.effect not in gap.effects
        yield "not first", not gap.effects or first.effect != row.effect
        gains = f"{text.evidence(row.evidence)} {text.evidence(row.simulated)}"
        yield "both gains", f"{row.effect} rejected {gains}" in page
    for score in (gap.before, gap.after):
        yield "gap", digits(score.fit) in page


@settings(max_examples=40, suppress_health_check=list(HealthCheck))
@given(
    found_one=st.booleans(), gain=st.floats(6.0, 1e4),
    others=st.dictionaries(st.sampled_from(NAMES[1:]), st.floats(-2e4, -0.01)),
    value=st.floats(0.01, 1.0), relative=st.floats(0.01, 2.0), after=st.floats(0.97, 3.5),
    held_out=st.one_of(st.none(), st.floats(0.97, 5.0)), rejects=st.booleans(),
)  # fmt: skip
def test_an_answer_does_not_contradict_itself(
    gap, found_one, gain, others, value, relative, after, held_out, rejects
):  # fmt: skip
    part = found(gain, others) if found_one else None
    rejected = (Rejected("spring_hardening", 105.0, -32.0),) * rejects
    made = answered(gap, part, value, relative * value, after, held_out, rejected)
    wrong = [name for name, holds in contradictions(made) if not holds]
    assert not wrong, (wrong, made.verdict, made.sentence)


def test_the_headline_has_the_models_number_not_that_of_the_curve(gap):
    made = answered(gap, found(500.0, {"run_in": -90.0}), 0.333, 0.0085, 1.0, 1.0)
    assert "film_drag, coefficient = 0.333 N s/m (0.319 to 0.347)" in made.sentence
    assert "memory" not in made.sentence
    assert "as the sliding speed to the power 0.70 (0.60 to 0.80)" in made.sentence


@pytest.mark.parametrize(("power", "told"), [(0.994, False), (0.9, True)])
def test_a_power_as_good_as_the_catalogue_s_is_not_told(power, told):
    assert Exponent("film_drag", "u", power, power - 0.005, power + 0.005, 1.0).holds != told


def test_friction_over_speed_has_one_name_in_headline_and_error_rates():
    """As many draws of noise call growing friction by the other name: the class is of two."""
    three = "class: film_drag, structural_damping, velocity_weakening"
    both = "class: film_drag, velocity_weakening"
    table = {"film_drag": {three: 40, both: 6, "velocity_weakening": 4}, "none": {"none": 50}}
    merged = by_direction(Rates(50, table), {"film_drag", "structural_damping"}).table
    assert merged == {
        "film_drag": {"class: film_drag, structural_damping": 40, "film_drag": 10},
        "none": {"none": 50},
    }
    assert by_direction(Rates(50, table), {"film_drag", "velocity_weakening"}).table == table


def test_the_class_in_the_headline_is_asked_of_the_error_rates(gap):
    gap = answers.other(gap, "class")
    members = "class: film_drag, velocity_weakening"
    gap = replace(gap, rates=Rates(50, {"film_drag": {members: 50}, "run_in": {members: 7}}))
    assert text.rates_lines(gap) == [
        f"If it were run_in, these runs would say {members} 7 times in 50."
    ]
    assert text.rates_lines(replace(gap, rates=None)) == []


@pytest.mark.parametrize("effects", [("film_drag", "run_in"), ("measurement.steps", "film_drag")])
def test_of_several_names_the_error_rates_of_each_are_told(gap, effects):
    """They are drawn one by one beside the others: no drawn answer is of two that are there."""
    table = {"film_drag": {"film_drag": 50}, "structural_damping": {"film_drag": 3}}
    gap = replace(gap, verdict="named", effects=effects, rates=Rates(50, table))
    said = "If it were structural_damping, these runs would say film_drag 3 times in 50."
    assert text.rates_lines(gap) == [said]


@pytest.mark.parametrize("named", [True, False])
def test_one_figure_of_scatter(gap, named):
    """Where scatter is a step of the ladder its text has it, and nothing else on the page."""
    said = "friction scatters from run to run by 0.4 %"
    rung = replace(gap.ladder[-1], name="scatter", text=said)
    page = page_of(replace(gap, ladder=(*gap.ladder, rung)) if named else gap)
    assert page.lower().count("friction scatters from run to run") == 1


def test_the_run_that_is_named_is_the_run_that_is_shown(gap):
    """The run with the largest gap, though another may have worse cycles."""
    worst = max(gap.plain.runs, key=lambda run: run.gap)
    calm = next(run for run in gap.plain.runs if run is not worst)
    residuals = calm.residuals.copy()
    residuals[: residuals.size // 6] = 0.0
    residuals[-30:] = 2.2 * np.abs(worst.residuals).max()
    residuals[:-30] = 0.0
    runs = [replace(run, residuals=residuals) if run is calm else run for run in gap.plain.runs]
    changed = replace(gap, plain=replace(gap.plain, runs=tuple(runs)))
    largest = max(changed.plain.runs, key=lambda run: run.gap).name
    (axis,) = changed.plot("run").axes
    assert axis.get_title(loc="left").startswith(largest)


@pytest.mark.parametrize("stated", [True, False])
def test_numbers_written_in_coarse_steps_are_named(stated, tmp_path):
    """Steps of 1 mm beside noise of a fifth of that, stated or not; friction is as stated."""
    runs = []
    for number, speed in enumerate(answers.SPEEDS):
        run = answers.motion(speed=speed, duration=6.0)
        x = 1e-3 * np.round(answers.noisy(run["x"], number) / 1e-3)
        columns = {"t": run.time, "x": x}
        runs.append({"surface_speed": speed, "hold_out": number == 2, "columns": columns})
    noise = {"noise": {"x": answers.NOISE}} if stated else {}
    gap = find_gap(read_campaign(answers.write_campaign(tmp_path, runs, **noise)))
    assert (gap.verdict, gap.effects) == ("named", ("measurement.quantisation",))
    assert "measurement.quantisation, 1.00 mm" in gap.sentence
    assert gap.ladder[1].name == "measurement.quantisation"
    assert gap.after.fit < 1.1 and gap.after.held_out < 1.1
    if stated:  # what the digits take of the gap is in it
        factor = gap.plain.runs[0].gap / gap.ladder[1].gap.fit
        assert gap.before.fit > 1.3 and gap.ladder[1].evidence > 100.0
        assert factor == pytest.approx(np.sqrt(1.0 + (1e-3 / answers.NOISE) ** 2 / 12.0), rel=0.1)
