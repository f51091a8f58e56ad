"""The CSV files that a campaign names: what kind and how large they are is asked first."""

from collections.abc import Iterator
from pathlib import Path

from stickslip.text_file import MOST_TOML, read_text, tables_in

from cosim.gap import CampaignError

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
