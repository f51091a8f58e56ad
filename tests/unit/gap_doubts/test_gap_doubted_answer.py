"""An answer beside doubts: what is believed, and what terminal, page and gap.json say of it."""

import json
from dataclasses import replace

import pytest

from cosim.gap.answer.below_noise import doubts_of_noise
from cosim.gap.doubts import Doubt
from cosim.gap.show.numbers import as_data, as_json
from cosim.gap.show.page import page
from cosim.gap.show.score_figures import draw_parameters, draw_ranking
from cosim.gap.show.words import closing_lines, gap_line, reason

WRONG = Doubt(
    "springs", "run01, run02", 1.2, 1.7, "Hz", "run01, run02: slips swing at 1.2 Hz, expected 1.7",
    True, ("spring_hardening",),
)  # fmt: skip
FEW = Doubt("runs", "run01", 1.0, 2.0, "runs", "run01: 1 run, expected are 2 or more")


def test_beside_what_forbids_it_nothing_is_believed(gap):
    doubted = gap.doubted((FEW, WRONG))
    assert (doubted.verdict, doubted.effects, doubted.extended) == ("unknown", (), None)
    assert doubted.gap_after == gap.gap_before and doubted.ladder == gap.ladder
    assert reason(doubted) == f"these data cannot tell. {WRONG.text}."
    said = "\n".join(closing_lines(doubted))
    assert said.startswith(f"{gap.campaign.name}: Unknown: these data cannot tell.")
    assert f"doubt      {FEW.text}" in said and f"doubt      {WRONG.text}" in said
    written = json.loads(as_json(doubted, "model.toml"))
    assert written["verdict"] == "unknown" and written["believed"] is False
    assert [one["decisive"] for one in written["doubts"]] == [False, True]
    assert written["doubts"][1]["runs"] == ["run01", "run02"]
    assert (written["doubts"][1]["figure"], written["doubts"][1]["expected"]) == (1.2, 1.7)
    html = page(doubted, [])
    assert "What should be looked at before this is believed" in html and WRONG.text in html


def test_what_explains_a_doubt_stands_beside_it(gap):
    explained = replace(WRONG, explained_by=("velocity_weakening",))
    for doubts in ((explained, FEW), (FEW,)):
        beside = gap.doubted(doubts)
        assert (beside.verdict, beside.effects) == (gap.verdict, gap.effects)
        assert as_data(beside, "")["believed"] and not as_data(beside, "")["doubts"][0]["decisive"]


def test_what_fits_in_part_or_is_at_its_bound_explains_nothing(gap):
    explained = (replace(WRONG, explained_by=("velocity_weakening",)),)
    at_bound = replace(gap.extended, at_bound={"velocity_weakening.linear": 5.0})
    for answer in (replace(gap, verdict="partial"), replace(gap, extended=at_bound)):
        assert answer.doubted(explained).verdict == "unknown"


def test_where_there_is_no_doubt_none_is_written(gap):
    assert as_data(gap, "")["doubts"] == [] and "Doubts" not in page(gap, [])


@pytest.mark.parametrize(("factor", "decisive"), [(1.0, None), (1.25, False), (2.0, True)])
def test_less_than_noise_is_no_fit(factor, decisive, gap):
    """Twice the noise hides as much again as any model may leave; a quarter more is said."""

    def louder(run):
        noise = {name: factor * value for name, value in run.track.run.noise.items()}
        return replace(run, track=replace(run.track, run=replace(run.track.run, noise=noise)))

    model = replace(gap.extended, runs=tuple(map(louder, gap.extended.runs)))
    found = doubts_of_noise(model, estimated=False, nothing=True)
    assert [doubt.decisive for doubt in found] == ([] if decisive is None else [decisive])
    assert all(doubt.figure == pytest.approx(1.0 / factor, rel=0.1) for doubt in found)
    assert not any(one.decisive for one in doubts_of_noise(model, estimated=False, nothing=False))


def test_a_number_at_its_bound_is_said(gap):
    bound = replace(gap.extended, at_bound={"friction.mu_s": 0.5})
    said = replace(gap, extended=bound)
    line = "friction.mu_s is at its bound, 0.5: the fit would turn it further"
    assert line in "\n".join(closing_lines(said)) and line in page(said, [])
    assert as_data(said, "")["extended"]["at_bound"] == {"friction.mu_s": 0.5}
    assert draw_parameters(said).png


def test_where_nothing_was_held_out_it_is_said(gap):
    def fitted(run):
        return replace(run, track=replace(run.track, run=replace(run.track.run, hold_out=False)))

    alone = replace(gap, plain=replace(gap.plain, runs=tuple(map(fitted, gap.plain.runs))))
    assert gap_line(alone).startswith("nothing was held out; fit ")
    assert "held out 0" not in "\n".join(closing_lines(alone))
    assert "Nothing was held out." in page(alone, []) and "Nothing was held out." not in page(
        gap, []
    )
    assert draw_ranking(alone).png


COARSE = Doubt(
    "sampling", "run01", 4.7, 15.0, "samples a period", "run01: motion between the samples", True,
)  # fmt: skip


def test_where_nothing_could_be_believed_nothing_is_looked_for(gap, monkeypatch):
    """Beside a doubt that no effect explains; one that some effect explains is searched."""
    from cosim.gap import find

    class Searched(Exception):
        pass

    class Plain:
        def __init__(self, *_):
            pass

        def plain(self, model):
            return model

    def unsearched(campaign, bench, settled, doubts):
        return replace(
            gap, verdict="none", effects=(), ranking=(), ladder=(), extended=None, laws=(),
            searched=False,
        )  # fmt: skip

    def searched(*_):
        raise Searched

    monkeypatch.setattr(find, "Search", Plain)
    monkeypatch.setattr(find, "unsearched", unsearched)
    monkeypatch.setattr(find, "judge", searched)
    monkeypatch.setattr(find, "doubts_of", lambda campaign: (COARSE, WRONG))
    found = find.find_gap(gap.campaign, jobs=1)
    assert (found.verdict, found.believed, found.searched) == ("unknown", False, False)
    monkeypatch.setattr(find, "doubts_of", lambda campaign: (WRONG,))
    with pytest.raises(Searched):
        find.find_gap(gap.campaign, jobs=1)


def test_that_nothing_was_looked_for_is_said(gap):
    alone = replace(
        gap, verdict="none", effects=(), ranking=(), ladder=(), extended=None, laws=(),
        searched=False,
    ).doubted((COARSE,))  # fmt: skip
    said = "no effect was looked for: nothing that could be found explains the doubt (sampling)"
    assert said in "\n".join(closing_lines(alone))
    html = page(alone, [])
    assert said[1:] in html and "Every effect of the catalogue" not in html
    written = as_data(alone, "")
    assert written["searched"] is False and not written["ranking"]
    assert as_data(gap, "")["searched"] is True
