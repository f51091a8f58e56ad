"""Laws of the catalogue beside the curves that the runs have drawn."""

from types import SimpleNamespace

import numpy as np
import pytest
from stickslip.effects.candidate import Scales
from stickslip.effects.contact.static_strengthening import EFFECT

from cosim.gap import models
from cosim.gap.extended import Part
from cosim.gap.laws import Context, FreeCurve, laws_of
from cosim.gap.models import Models
from cosim.gap.weak_form.ladder import Finding


def test_a_law_and_what_the_curve_has_beside_it():
    """Ageing is drawn from the shortest hold on: by then mu_s has grown already."""
    at = np.log([0.2, 0.4, 0.8, 1.6, 3.2])
    grown = 0.08 * np.log10(1.0 + np.exp(at) / 0.01) / 0.25
    curve = FreeCurve(at, grown - grown[0], 1e-6 * np.eye(at.size))
    scales = Scales(0.05, 1.0, 1.0, 20.0, 50.0, 0.02, 0.9, 9.0)
    campaign = SimpleNamespace(catalogue=SimpleNamespace(effects=[EFFECT]))
    best = laws_of(EFFECT.id, curve, Context(campaign, scales, {"mu_s": 0.25}))[0]
    assert best.candidate.form == "logarithmic"
    assert best.values["static_strengthening.rate"] == pytest.approx(0.08, rel=1e-3)
    assert best.level == pytest.approx(-grown[0], rel=1e-3)


def test_a_fit_sets_out_from_what_the_rows_have_beside_the_laws(monkeypatch):
    known = {"friction.mu_s": 0.4, "friction.mu_k": 0.2}
    monkeypatch.setattr(models, "started_from", lambda campaign, rows: dict(known))
    aged = Part(Finding(EFFECT.id, (), 30.0), None, (), (), {}, shifts={"friction.mu_s": -0.1})
    assert Models(None, None, {}, [aged], 1)._by_rows(None) == {**known, "friction.mu_s": 0.4 - 0.1}
    assert Models(None, None, {}, [], 1)._by_rows(None) == known
