"""`stickslip reproduce`: its arguments, what it runs, what it leaves behind."""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser, Namespace
from pathlib import Path
from typing import TYPE_CHECKING

from tqdm import tqdm

from cosim.cli import DONE, FAILED
from cosim.cli.arguments import add_force, add_output
from cosim.files import OutputRefused, writable, write_bytes, write_text
from cosim.interrupts import held_interrupts
from cosim.manifest import made_by, require_json, require_own, results_in

if TYPE_CHECKING:
    from cosim.studies.reproduction import Claim
    from cosim.studies.reproduction.attributions import Datasets

EXAMPLE = "stickslip reproduce C6 C13 -o results/claims"
RESULT, PAGE = "reproduction.json", "report.html"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument("claims", metavar="CLAIM", nargs="*", help="C1 to C15 (default: all)")
    parser.add_argument(
        "--json", metavar="FILE", help=f"write {RESULT} there instead of the output folder"
    )
    add_output(
        parser,
        "folder of report, figures and numbers (default: results/reproduction)",
        default="results/reproduction",
    )
    add_force(parser)


def refused() -> tuple[type[Exception], ...]:
    """What is bad input."""
    import cosim.studies.reproduction.claims  # noqa: F401  imported where Ctrl-C waits
    from cosim.studies.reproduction import UnknownClaim

    return (UnknownClaim, OutputRefused)


def execute(arguments: Namespace) -> int:
    """Judge, write, print a line a claim; 0, or 1 when stopped."""
    from cosim.studies.reproduction import claim_ids, reproduce

    began = time.perf_counter()
    wanted = claim_ids(arguments.claims)
    folder = Path(arguments.output)
    result = Path(arguments.json) if arguments.json else folder / RESULT
    writable(folder, (PAGE,))
    writable(result.parent, (result.name,))
    require_own(folder, (PAGE,) if arguments.json else (PAGE, RESULT), arguments.force)
    if arguments.json:
        require_json(result, ("referee", "claims"), arguments.force)
    made = made_by(claims=wanted)
    claims: list[Claim] = []
    try:
        for one in tqdm(wanted, disable=None, unit="claim", leave=False):
            claims += reproduce([one])
        found = _datasets(wanted)
        with results_in(folder, made, force=arguments.force) as results:
            _write(claims, folder, result, time.perf_counter() - began, found)
            results.complete = True
    except KeyboardInterrupt:
        if not claims:
            raise
        with held_interrupts(), results_in(folder, made, force=arguments.force):
            _write(claims, folder, result, time.perf_counter() - began)
        print(
            f"error: interrupted; {len(claims)} of {len(wanted)} claims are in {folder / PAGE}",
            file=sys.stderr,
        )
        return FAILED
    wall_time = time.perf_counter() - began
    for claim in claims:
        print(f"{claim.id:<4} {claim.verdict:<30} {claim.title}")
        if claim.scope:
            print(f"     scope: {claim.scope}")
        print(f"     {claim.reason}")
        print(f"     {_firmness(claim)}")
    if found:
        print(f"Datasets: {found.says}")
    print(f"{len(claims)} claims in {wall_time:.1f} s; {folder / PAGE}, {result}")
    return DONE


def _datasets(wanted: tuple[str, ...]) -> Datasets | None:
    """The study's datasets in every reading, where a claim was asked for that hangs on them."""
    from cosim.studies.reproduction.attributions import CLAIMS, datasets

    return datasets() if set(wanted) & set(CLAIMS) else None


def _firmness(claim: Claim) -> str:
    """What would turn the verdict, in a line."""
    turn = claim.turns[0] if claim.turns else None
    if turn is None:
        return "turned by: nothing was tried"
    if claim.steady:
        return f"turned by: none of {len(claim.turns)} changes tried"
    return f"turned by: {turn.change} ({turn.figure})"


def _write(
    claims: list[Claim],
    folder: Path,
    result: Path,
    wall_time: float,
    datasets: Datasets | None = None,
) -> None:
    """Numbers first, then figures, then the page."""
    from stickslip.reference.faults import DESCRIPTIONS

    from cosim.report.files import write_json
    from cosim.studies.reproduction.result import as_data, page

    write_json(as_data(claims, wall_time, datasets), result)
    for claim in claims:
        for picture in claim.pictures:
            write_bytes(picture.png, folder / f"{picture.name}.png")
    write_text(page(claims, DESCRIPTIONS, datasets), folder / PAGE)
