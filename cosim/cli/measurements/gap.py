"""`stickslip gap`: its arguments, what it asks, what it leaves behind.

Of the CSV files that a campaign names it is asked first what kind they are and how large.
"""

import sys
from argparse import Namespace
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from types import ModuleType
from typing import Any

from stickslip.text_file import MOST_TOML, read_text, tables_in

from cosim.cli import DONE, Failed
from cosim.cli.argument_types import CAMPAIGNS, PACKAGED, STDOUT
from cosim.cli.arguments import RESULTS
from cosim.cli.bar import Bar
from cosim.cli.console import note
from cosim.cli.numbers import numbers_asked
from cosim.gap import Campaign, CampaignError, read_campaign
from cosim.gap.data.campaign_file import FILE_NAME
from cosim.gap.example import write_example
from cosim.interrupts import held_interrupts
from cosim.manifest import made_by, own_folder, results_in

#: Bytes of a run's file: a million rows and more, which take some twenty seconds and 0.7 GB.
MOST_BYTES = 64 * 2**20


def check_files(campaign: Path) -> None:
    """CampaignError in one line for a run's file that is too large, or may never end."""
    for number, name in _named(campaign):
        file = campaign.parent / name
        said = f"{campaign}: run {number}: file = {name!r}:"
        if file.exists() and not file.is_file():
            raise CampaignError(f"{said} is no regular file, allowed is a CSV file")
        if file.is_file() and (size := file.stat().st_size) > MOST_BYTES:
            raise CampaignError(
                f"{said} {size / 2**20:.3g} MiB, allowed are {MOST_BYTES >> 20} MiB: take fewer "
                "rows a second, or a part of the record"
            )


def _named(campaign: Path) -> Iterator[tuple[int, str]]:
    """Number of the run and name of its file; none of what whoever reads it will refuse."""
    try:
        runs = tables_in(read_text(campaign, MOST_TOML)).get("run")
    except (OSError, ValueError):
        return
    for number, run in enumerate(runs if isinstance(runs, list) else [], 1):
        name = run.get("file") if isinstance(run, dict) else None
        if isinstance(name, str) and name:
            yield number, name


RESULT, MODEL, PAGE = "gap.json", "model.toml", "report.html"
#: By which keys RESULT is known.
KEYS = ("campaign", "verdict", "ranking")
#: What writes an answer down.
SHOW, SHOW_SUMMARY = "cosim.gap.show.files", "cosim.studies.reproduction.summary.show"


def execute(arguments: Namespace) -> int:
    """Read, find, write, report; 0, or 1 when stopped."""
    if arguments.write_example is not None:
        print(write_example(Path(arguments.write_example), force=arguments.force))
        return DONE
    if arguments.campaign is None:
        raise CampaignError("no campaign given, allowed is a file or folder, or --write-example")
    source = _source(arguments.campaign)
    check_files(source / FILE_NAME if source.is_dir() else source)
    campaign = read_campaign(source)
    with held_interrupts():
        files = import_module(SHOW_SUMMARY if _has_no_tracks(campaign) else SHOW)
    place = arguments.output or Path(RESULTS) / f"{files.safe_name(campaign.name)}-gap"
    folder = own_folder(place, (RESULT, MODEL, PAGE), arguments.force)
    asked = numbers_asked(arguments, KEYS)
    for remark in (*campaign.remarks, *_blocking(campaign)):
        note(remark)
    with Bar(unit="step") as bar:
        gap = _find(campaign, arguments.seed, arguments.jobs, bar)
    made = made_by(campaign=str(source.resolve()))
    with results_in(folder, made, force=arguments.force):
        with held_interrupts():
            text = files.write_data(gap, folder / RESULT, folder / MODEL)
            corrected = files.write_corrected(gap, folder)
        asked.give(text)
        _show(files, gap, folder, corrected, arguments)
    return DONE


def _show(
    files: ModuleType, gap: Any, folder: Path, corrected: list[Path], arguments: Namespace
) -> None:
    """Figures and page where they are wanted, then the closing lines."""
    try:
        if not arguments.no_page:
            with Bar(unit="figure", total=len(files.drawers(gap))) as bar:
                files.write_page(gap, folder, folder / PAGE, bar.update, corrected)
    except KeyboardInterrupt:
        raise Failed(f"interrupted while drawing; {RESULT} and {MODEL} are in {folder}") from None
    names = [str(folder / name) for name in (PAGE, MODEL, RESULT)[arguments.no_page :]]
    names += map(str, corrected[:1])
    lines = [*files.closing_lines(gap), f"  files      {', '.join(names)}"]
    print("\n".join(lines), file=sys.stderr if arguments.json == STDOUT else sys.stdout)


def _source(given: str) -> Path:
    """A file or folder; the name of a packaged campaign where there is none."""
    if not Path(given).exists() and given in PACKAGED:
        return CAMPAIGNS / f"{given}.toml"
    return Path(given)


def _has_no_tracks(campaign: Campaign) -> bool:
    """Whether only figures are known of the runs, or only the study's own scheme is looked at."""
    return campaign.scheme == "study" or all(run.track is None for run in campaign.runs)


def _blocking(campaign: Campaign) -> list[str]:
    """Doubts of the data beside which no effect is searched for, a line each."""
    if _has_no_tracks(campaign):
        return []
    from cosim.gap.checks import blocking, doubts_of

    return [
        f"{doubt.text}; effects are not searched for" for doubt in blocking(doubts_of(campaign))
    ]


def _find(campaign: Campaign, seed: int, jobs: int, bar: Bar) -> Any:
    """Runs of which figures alone are known, and the study's own scheme, are searched otherwise."""
    if _has_no_tracks(campaign):
        from cosim.studies.reproduction.summary import find_summary_gap

        return find_summary_gap(campaign, seed=seed, jobs=jobs, step=bar.update)
    from cosim.gap.find import find_gap

    return find_gap(campaign, jobs=jobs, progress=bar.reach)
