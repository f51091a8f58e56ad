"""Scores of the laboratory's campaigns, by hand on answers made up here."""

import pytest
from laboratory_score.answers import Row, truth_of
from laboratory_score.exponents import exponents_are_near
from laboratory_score.outcome import Outcome, is_right, names_physics, outcome
from laboratory_score.parameters import compared
from laboratory_score.shares import Share
from laboratory_score.targets import scores

CONTACT = {"form": "lugre", "mu_s": 0.4, "mu_k": 0.25}


def found(verdict, effects=(), **more):
    """A gap.json, as far as it is read."""
    gap = {"before": {"fit": 9.0, "held_out": 8.0}, "after": {"fit": 1.0, "held_out": 1.05}}
    return {"verdict": verdict, "effects": list(effects), "classes": [], "gap": gap} | more


def told(*effects, kind=None, **more):
    """An entry of the laboratory's answers."""
    verdict = ["named"] if effects else ["unknown", "partial"] if kind else ["none"]
    hidden = [
        {
            "name": name,
            "shape": "a shape",
            "law": "a law of its own",
            "strength": 0.3,
            "size": {"size": 7.5, "raw": 9.0, "samples": 10},
        }
        for name in effects
    ]
    answer = {"verdict": verdict, "effects": list(effects), "out_of_catalogue": kind}
    return answer | {"hidden": hidden, "contact": CONTACT, "scatter": 0.0} | more


def row(answer, said, suite="one_effect", name="c1"):
    return Row(suite, name, truth_of(answer), said, seconds=10.0, cpu=9.0)


@pytest.mark.parametrize(
    "answer, said, kind, right",
    [
        (told("run_in"), found("named", ["run_in"]), Outcome.NAMED, True),
        (told("run_in"), found("named", ["film_drag"]), Outcome.WRONG, False),
        (told("run_in"), found("named", ["run_in", "film_drag"]), Outcome.WRONG, False),
        (told("run_in"), found("class", ["run_in", "film_drag"]), Outcome.CLASS, True),
        (told("run_in"), found("class", ["surface_pattern", "film_drag"]), Outcome.WRONG, False),
        (told("run_in"), found("partial", ["run_in"], share=0.8), Outcome.PARTIAL, False),
        (told("run_in"), found("partial", ["film_drag"], share=0.8), Outcome.WRONG, False),
        (told("run_in"), found("none"), Outcome.NONE, False),
        (told("run_in"), found("unknown"), Outcome.UNKNOWN, False),
        (told("run_in"), None, Outcome.FAILED, False),
        (told("run_in", "film_drag"), found("named", ["film_drag", "run_in"]), Outcome.NAMED, True),
        (told("run_in", "film_drag"), found("named", ["run_in"]), Outcome.WRONG, False),
        (told(), found("none"), Outcome.NONE, True),
        (told(), found("partial", ["run_in"]), Outcome.WRONG, False),
        (told(kind="guide_friction"), found("unknown"), Outcome.UNKNOWN, True),
        (told(kind="guide_friction"), found("partial", ["run_in"]), Outcome.PARTIAL, True),
        (told(kind="guide_friction"), found("named", ["run_in"]), Outcome.WRONG, False),
        (told(kind="play"), found("none"), Outcome.NONE, False),
        (told(kind="play"), None, Outcome.FAILED, False),
        (told(), found("unknown"), Outcome.UNKNOWN, False),
    ],
)
def test_kinds_of_answers(answer, said, kind, right):
    assert outcome(row(answer, said)) is kind
    assert is_right(row(answer, said)) is right


def test_an_effect_that_comes_with_another_may_be_named_or_left_out():
    answer = told("turning_surface", also_right=["lateral_friction"])
    both = found("named", ["turning_surface", "lateral_friction"])
    assert outcome(row(answer, both)) is Outcome.NAMED
    assert outcome(row(answer, found("named", ["turning_surface"]))) is Outcome.NAMED
    assert outcome(row(answer, found("named", ["lateral_friction"]))) is Outcome.WRONG


def test_a_class_excuses_one_of_two_effects():
    said = found("class", ["run_in", "film_drag"], classes=[["film_drag", "structural_damping"]])
    assert outcome(row(told("run_in", "structural_damping"), said)) is Outcome.CLASS
    assert outcome(row(told("speed_ripple", "structural_damping"), said)) is Outcome.WRONG


def test_a_fault_that_is_named_as_physics():
    fault = told("measurement.scale")
    assert names_physics(row(fault, found("named", ["run_in"])))
    assert names_physics(row(fault, found("named", ["measurement.scale", "run_in"])))
    assert names_physics(row(fault, found("partial", ["run_in"])))
    assert not names_physics(row(fault, found("named", ["measurement.clock"])))
    both = ["measurement.scale", "load_dependence"]
    assert not names_physics(row(fault, found("class", both, classes=[both])))
    assert not names_physics(row(fault, found("unknown")))


def test_exponents_of_mass_and_load_are_one():
    answer = told("run_in", exponents={"run_in": {"mass": -1.0}})

    def near(**powers):
        """As gap.json has them: the whole power, and that of the law."""
        said = [
            {"effect": "run_in", "quantity": quantity, "value": 1.0 + value, "catalogue": 1.0}
            for quantity, value in powers.items()
        ]
        return exponents_are_near(row(answer, found("named", ["run_in"], exponents=said)))

    assert near(mass=-0.85)
    assert near(load=-1.1)
    assert not near(mass=-0.7)
    assert not near(speed=-1.0)
    assert not near(**{"mass": -1.0, "sliding speed": 0.4})
    assert not near()


def test_shares_have_exact_intervals():
    # Clopper and Pearson: none of n leaves up to 1 - 0.025^(1/n)
    assert Share(0, 15).interval() == pytest.approx((0.0, 1 - 0.025 ** (1 / 15)))
    assert Share(100, 100).interval()[0] == pytest.approx(0.025**0.01)
    assert str(Share(0, 0)) == "–"


def with_sd(key, value, sd, answer, verdict="named", effects=("speed_ripple",)):
    """An answer with one fitted parameter and its standard deviation."""
    fitted = {"parameters": {key: value}, "sd": {key: sd}, "at_bound": []}
    return row(answer, found(verdict, effects, extended=fitted))


def test_coverage_is_counted_at_90_per_cent():
    for off, covered in ((1.6, True), (1.7, False)):
        value = 0.25 + off * 0.01
        one = with_sd("friction.mu_k", value, 0.01, told("speed_ripple"))
        (each,) = compared(one)
        assert each.covers() is covered
        assert each.distance == pytest.approx(off, rel=1e-3)


def test_what_a_suite_has_to_show():
    rows = [row(told("run_in"), found("named", ["run_in"]), "contact_and_shapes")] * 9
    rows += [row(told("run_in"), found("unknown"), "contact_and_shapes")]
    rows += [row(told(), found("none"), "contact_and_shapes")] * 4
    rows += [row(told(), found("class", ["run_in"]), "contact_and_shapes")]
    by_name = {each.what: each for each in scores("contact_and_shapes", rows)}
    assert by_name["named by effect"].share == Share(9, 10)
    assert by_name["named by effect"].met
    assert by_name["nothing hidden: named"].share == Share(1, 5)
    assert by_name["nothing hidden: named"].met is False
    refused = by_name["nothing hidden: `none` refused"]
    assert refused.share == Share(1, 5) and refused.met
    assert by_name["right answers: held-out gap after <= 1.1"].share == Share(9, 9)
