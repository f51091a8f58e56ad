"""Which laws a search sets out with: none twice."""

from types import SimpleNamespace

from settled_campaigns import strength
from stickslip.effects.candidate import Candidate

from cosim.gap.selection.search import _are_twins, _distinct

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
