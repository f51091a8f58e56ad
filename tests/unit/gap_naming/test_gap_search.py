"""Which laws a search sets out with, none twice; and which are carried to their end."""

from dataclasses import dataclass
from types import SimpleNamespace

from settled_campaigns import strength
from stickslip.effects.candidate import Candidate

from cosim.gap.evidence.settled import ended
from cosim.gap.selection import search
from cosim.gap.selection.search import Search, _are_twins, _distinct
from cosim.gap.selection.tried import Tried

ACROSS = "lateral_friction.ratio"


def law(start, form="angle", **settings):
    angle = strength("spring_misalignment.angle_deg", start, 1.0)
    return Candidate("spring_misalignment", form, (angle,), settings)


def base(**settings):
    return SimpleNamespace(model=SimpleNamespace(settings=settings))


def test_laws_that_set_what_the_base_does_are_one():
    with_friction, without = law(3.0, **{ACROSS: 1.0}), law(3.0)
    assert _distinct(base(), [with_friction, without]) == [with_friction, without]
    # the first stands: it says all that it needs
    assert _distinct(base(**{ACROSS: 1.0}), [with_friction, without]) == [with_friction]


def test_starts_on_either_side_of_nothing_are_one_law():
    assert _are_twins(law(3.0), law(-3.0))
    assert not _are_twins(law(3.0), law(3.0))
    assert not _are_twins(law(3.0), law(-1.0))
    assert not _are_twins(law(3.0), law(-3.0, form="offset"))
    assert not _are_twins(law(3.0), law(-3.0, **{ACROSS: 1.0}))


@dataclass
class OnItsWay:
    """As much of a settled model as the search looks at to decide how far it is carried."""

    evidence: float
    promise: float
    reach: float


def test_what_cannot_be_expected_to_pay_is_left_as_it_is():
    model = OnItsWay(evidence=100.0, promise=80.0, reach=40.0)
    assert ended(model, beyond=30.0) is model


def finished(monkeypatch, models, beyond):
    """The models that a search carries on, in the order in which it does, and its answer."""
    carried = []

    def carry(self, each, beyond=float("inf")):
        carried.extend(each)
        return [OnItsWay(m.promise, m.promise, m.promise) for m in each]

    monkeypatch.setattr(Search, "_ended", carry)
    monkeypatch.setattr(Search, "_repaired", lambda self, base, few, done: done)
    monkeypatch.setattr(search, "is_noise", lambda each: False)
    tried = [Tried(law(3.0, form=str(i)), 0.0, model) for i, model in enumerate(models)]
    found = Search((), (), map)._finished(tried, OnItsWay(1000.0, 1000.0, 1000.0), beyond)
    return carried, found


def test_those_that_promise_half_as_much_as_the_best_are_carried_on(monkeypatch):
    best, second = OnItsWay(700.0, 200.0, 0.0), OnItsWay(700.0, 500.0, 0.0)
    faint, short = OnItsWay(900.0, 900.0, 0.0), OnItsWay(700.0, 300.0, 260.0)
    models = [best, short, second, faint]
    carried, found = finished(monkeypatch, models, beyond=250.0)
    assert carried == [best, second]  # the third reaches no further than 260, the last promises 100
    assert [t.candidate.form for t in found] == ["0", "2", "1", "3"]
    assert found[0].gain == 800.0 and found[1].gain == 500.0
    assert found[2].settled is short and found[3].settled is faint
