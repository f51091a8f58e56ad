"""`stickslip reproduce`: its arguments, what it runs, what it leaves behind.

What `execute` raises of `REFUSED` is bad input, in one line.
"""

from __future__ import annotations

import sys
import time
from argparse import ArgumentParser, Namespace
from importlib import import_module
from pathlib import Path

from tqdm import tqdm

from cosim.atomic import write_bytes, write_text
from cosim.folders import OutputRefused, writable
from cosim.interrupts import held_interrupts
from cosim.studies.reproduction import Claim, UnknownClaim, claim_ids, reproduce

DONE, FAILED = 0, 1
RESULT, PAGE = "reproduction.json", "report.html"
REFUSED = (UnknownClaim, OutputRefused)


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument("claims", metavar="CLAIM", nargs="*", help="C1 to C15 (default: all)")
    parser.add_argument(
        "--json", metavar="FILE", help=f"write {RESULT} there instead of the output folder"
    )
    parser.add_argument(
        "-o", "--output", metavar="DIR", default="results/reproduction",
        help="folder of report, figures and numbers (default: results/reproduction)",
    )


def execute(arguments: Namespace) -> int:
    """Judge, write, print a line a claim; 0, or 1 when stopped. Raises what is in `REFUSED`."""
    began = time.perf_counter()
    wanted = claim_ids(arguments.claims)
    folder = Path(arguments.output)
    result = Path(arguments.json) if arguments.json else folder / RESULT
    writable(folder, (PAGE,))
    writable(result.parent, (result.name,))
    claims: list[Claim] = []
    with held_interrupts():
        import_module("cosim.studies.reproduction.claims")
    try:
        for one in tqdm(wanted, disable=None, unit="claim", leave=False):
            claims += reproduce([one])
        _write(claims, folder, result, time.perf_counter() - began)
    except KeyboardInterrupt:
        if not claims:
            raise
        with held_interrupts():
            _write(claims, folder, result, time.perf_counter() - began)
        print(f"error: interrupted; {len(claims)} of {len(wanted)} claims are in {folder / PAGE}",
              file=sys.stderr)
        return FAILED
    wall_time = time.perf_counter() - began
    for claim in claims:
        print(f"{claim.id:<4} {claim.verdict:<30} {claim.title}")
        print(f"     {claim.reason}")
    print(f"{len(claims)} claims in {wall_time:.1f} s; {folder / PAGE}, {result}")
    return DONE


def _write(claims: list[Claim], folder: Path, result: Path, wall_time: float) -> None:
    """Numbers first, then figures, then the page."""
    from stickslip.reference.faults import DESCRIPTIONS

    from cosim.studies.reproduction.page import page
    from cosim.studies.reproduction.result import as_json

    write_text(as_json(claims, wall_time), result)
    for claim in claims:
        for picture in claim.pictures:
            write_bytes(picture.png, folder / f"{picture.name}.png")
    write_text(page(claims, DESCRIPTIONS), folder / PAGE)
