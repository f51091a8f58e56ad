"""What the rows of a campaign ask for: its findings, each a name with its unknowns."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.weak_form import periodic
from cosim.gap.weak_form.arguments import Arguments
from cosim.gap.weak_form.camera_faults import SMOOTHING, camera_faults, filters
from cosim.gap.weak_form.constants import MOST_FINDINGS
from cosim.gap.weak_form.corners import with_corners
from cosim.gap.weak_form.ladder import Finding, Ladder, Search
from cosim.gap.weak_form.planar import ROTATION, Planar, planar_effects, rows_in_plane
from cosim.gap.weak_form.rows import RunRows, rows_of
from cosim.gap.weak_form.surface import best_phase, tracks_of
from cosim.gap.weak_form.system import Rung as Rows
from cosim.gap.weak_form.system import System
from cosim.gap.weak_form.track import thinned, with_rows
from cosim.gap.weak_form.unknowns import Unknown
from cosim.gap.windows.camera import undone

#: effect, fault or other finding -> its variants.
Unknowns = dict[str, list[Unknown]]


def asked_of(campaign: Campaign, rows: Sequence[RunRows]) -> tuple[System, Arguments, Unknowns]:
    """Rows of all runs, held out or not, their arguments, and these with the camera's faults."""
    system = System(campaign, rows, every=True)
    arguments = Arguments(campaign, system.runs, system.level)
    return system, arguments, {**arguments.unknowns(), **camera_faults(system.rung())}


@dataclass(frozen=True)
class Named:
    """What the rows ask for.

    ladder : of all runs' rows; findings : what moves the block across first, then the ladder's;
    system, rung : rows of the fitted runs, with all findings; unknowns : that were asked
    filtered : the same of a tracker's filter in place of the findings, where corners ask for it
    """

    ladder: Ladder
    findings: tuple[Finding, ...]
    system: System
    rung: Rows
    unknowns: Mapping[str, Sequence[Unknown]]
    filtered: Named | None = None

    def with_findings(self, *findings: Finding) -> Named:
        """The same rows with these findings in place of its own."""
        added = [one for finding in findings for one in finding.added]
        return replace(self, findings=findings, rung=self.system.rung(added))


@dataclass(frozen=True)
class Naming:
    """Rows of a campaign and all that can be asked of them.

    Which argument it is, every run may say; how large it is, only those that are fitted.

    rows : of every run with a track; system : of them all, held out or not
    """

    campaign: Campaign
    rows: Sequence[RunRows]
    planar: Planar
    system: System
    arguments: Arguments
    unknowns: Unknowns

    @classmethod
    def of(cls, campaign: Campaign) -> Naming:
        """Rows along x; where the block moves across, of both directions."""
        runs = with_rows([thinned(run) for run in campaign.runs if run.track is not None])
        tracks = tracks_of(campaign, runs)
        rows = [rows_of(track, campaign.rig) for track in tracks]
        planar = planar_effects(campaign, rows)
        if planar.answer == ROTATION:
            turned_back = [_turned_back(run, planar) for run in runs]
            rows = [rows_of(track, campaign.rig) for track in tracks_of(campaign, turned_back)]
        elif planar.answer:
            rows = rows_in_plane(tracks, campaign, planar)
        system, arguments, unknowns = asked_of(campaign, rows)
        if planar.answer:
            unknowns.pop("measurement.zero", None)
        return cls(campaign, rows, planar, system, arguments, unknowns)

    def named(self, without: Collection[str] = (), most: int = MOST_FINDINGS) -> Named:
        """The findings, so many along x. without : names that are not asked for"""
        unknowns = {name: some for name, some in self.unknowns.items() if name not in without}
        waves = [wave for wave in periodic.kinds(self.system.level.kinetic)
                 if wave.name not in without]  # fmt: skip
        ladder = Search(self.system, unknowns, waves, self.arguments.near, without).climb(most)
        filtered = None
        if most and not (self.planar.answer or SMOOTHING in without):
            filtered = self._at_corners(ladder, unknowns)
        if filtered and not ladder.findings:
            return filtered
        return self._named(self.rows, ladder, unknowns, filtered)

    def _named(
        self, rows: Sequence[RunRows], ladder: Ladder, unknowns: Unknowns,
        filtered: Named | None = None,
    ) -> Named:  # fmt: skip
        self._follow_surface(ladder)
        fitted = System(self.campaign, rows)
        added = [one for finding in ladder.findings for one in finding.added]
        findings = (*self._across(), *ladder.findings)
        return Named(ladder, findings, fitted, fitted.rung(added), unknowns, filtered)

    def _follow_surface(self, ladder: Ladder) -> None:
        """Give a ripple the phases that slips show, in runs whose sticks show none."""
        for finding in ladder.findings:
            if finding.name == "speed_ripple":
                sizes = ladder.rung.posterior[0][ladder.rung.part_of(finding.main)]
                wave = finding.main.unknown.wave
                for run in self.system.runs:
                    here = best_phase(self.campaign, run, wave, sizes)
                    wave.phases[run.track.run.name] = here.phases[run.track.run.name]

    def _at_corners(self, ladder: Ladder, unknowns: Unknowns) -> Named | None:
        """A tracker's filter alone, where rows of corners ask for it.

        It shows where break-aways and re-sticks are rounded, as what any other finding leaves there
        would be: of its rows it then takes more than that does of its own.
        """
        cornered = [with_corners(run) for run in self.rows]
        system = System(self.campaign, cornered, every=True)
        smoothing = {SMOOTHING: filters(system.rung())}
        if not smoothing[SMOOTHING]:
            return None
        found = Search(system, smoothing, ()).climb()
        gain = found.findings[0].gain if found.findings else 0.0
        if gain <= max((other.gain for other in ladder.findings), default=0.0):
            return None
        return self._named(cornered, found, {**unknowns, **smoothing})

    def _across(self) -> Iterator[Finding]:
        """What moves the block across, as a finding."""
        planar = self.planar
        if planar.answer:
            gain = planar.evidence[planar.answer]
            others = {name: value - gain for name, value in planar.evidence.items()
                      if name == planar.runner_up}  # fmt: skip
            yield Finding(planar.answer, (), gain, others, planar.numbers, planar.settings)


def _turned_back(run: MeasuredRun, planar: Planar) -> MeasuredRun:
    """As a camera that is not turned would have seen it: a turned one mixes y into x."""
    if not planar.settings.get(f"in@{run.name}", 1.0):
        return run
    angle, _ = planar.numbers[ROTATION]
    return replace(run, track=undone(run.motion, {ROTATION: angle}))
