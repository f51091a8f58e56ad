"""From a campaign to its gap: fit, name, extend."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from cosim.gap.answer.answer import answer
from cosim.gap.answer.below_noise import doubts_of_noise
from cosim.gap.answer.models import Bench
from cosim.gap.answer.offered import offered
from cosim.gap.answer.unsearched import unsearched
from cosim.gap.camera.quantisation import find_quantisation, with_steps
from cosim.gap.candidates.plain import moves_across, plain_free_parameters, plain_settings
from cosim.gap.data import Campaign
from cosim.gap.doubts import doubts_of, hopeless
from cosim.gap.estimation.preparation import thinned
from cosim.gap.estimation.segmented_run import SegmentedRun
from cosim.gap.estimation.trial import Model
from cosim.gap.result import Gap
from cosim.gap.selection.powers import with_powers
from cosim.gap.selection.search import Search
from cosim.gap.selection.verdict import judge
from cosim.processes import processes


def find_gap(
    campaign: Campaign,
    *,
    jobs: int = 2,
    progress: Callable[[int], object] | None = None,
) -> Gap:
    """What the plain model lacks in a campaign with tracks.

    Nothing is drawn: the same campaign gives the same answer. progress : called with 1 after every
    model tried. Runs of which only figures are known are left to `find_summary_gap`. Beside doubts
    that leave nothing to believe (`cosim.gap.doubts`) the verdict is "unknown"; where no effect
    could explain one of these, none is looked for.
    """
    doubts = doubts_of(campaign)
    runs = tuple(thinned(run) if run.track is not None else run for run in campaign.runs)
    campaign = replace(campaign, runs=runs)
    steps = find_quantisation([run for run in runs if run.track is not None])
    rounded = with_steps(campaign, steps.step) if steps else campaign
    bench = Bench.of(rounded, moves_across(campaign))
    model = Model(plain_free_parameters(rounded, bench.planar), plain_settings(rounded))
    with processes(jobs, partial(_load, bench.short[0])) as mapped:
        search = Search(bench.short, bench.runs, mapped, progress)
        if hopeless(doubts):
            gap = unsearched(campaign, bench, search.plain(model), doubts)
        else:
            finding = judge(search, model, partial(offered, bench))
            finding, powers = with_powers(finding, bench.short, bench.runs)
            gap = answer(campaign, bench, finding, powers, steps, mapped)
    if not any(doubt.check == "sampling" for doubt in doubts):
        estimated, nothing = "x" in campaign.noise_estimated, gap.verdict == "none"
        doubts += tuple(doubts_of_noise(gap.model, estimated, nothing))
    return gap.doubted(doubts)


def _load(segmented: SegmentedRun) -> None:
    """Have a process load what it needs."""
    segmented.places({}, segmented.starts)
