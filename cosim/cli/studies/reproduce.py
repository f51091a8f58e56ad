"""`stickslip reproduce`: its arguments, what it runs, what it leaves behind."""

import re
import sys
import time
from argparse import Namespace

from stickslip.reference.scheme_errors import DESCRIPTIONS

from cosim.cli import DONE, FAILED
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.interrupts import held_interrupts
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.files import json_text
from cosim.studies.reproduction import Claim, Reproduction, claim_ids, reproduce
from cosim.studies.reproduction import claims as claims  # what judges them, once and for all
from cosim.studies.reproduction.result import PAGE, RESULT


def execute(arguments: Namespace) -> int:
    """Judge, write, print a line a claim; 0, or 1 when stopped."""
    began = time.perf_counter()
    wanted = claim_ids(arguments.claims)
    asked = numbers_asked(arguments, ("referee", "claims"))
    folder = own_folder(arguments.output, (PAGE, RESULT), arguments.force)
    made = made_by(claims=wanted)
    claims = Reproduction()
    try:
        for one in Bar(wanted, unit="claim"):
            claims += reproduce([one])
        found = claims.datasets
        with results_in(folder, made, force=arguments.force):
            claims.wall_time = time.perf_counter() - began
            claims.save(folder)
    except KeyboardInterrupt:
        if not claims:
            raise
        with held_interrupts(), results_in(folder, made, force=arguments.force) as results:
            results.complete = False
            claims.datasets, claims.wall_time = None, time.perf_counter() - began
            claims.save(folder)
            asked.give(json_text(claims.summary()))
        print(
            f"error: interrupted; {len(claims)} of {len(wanted)} claims are in {folder / PAGE}",
            file=sys.stderr,
        )
        return FAILED
    if asked.give(json_text(claims.summary())):
        return DONE
    for line in _codes(claims):
        print(line)
    for claim in claims:
        print(f"{claim.id:<4} {claim.verdict:<30} {claim.title}")
        if claim.scope:
            print(f"     scope: {claim.scope}")
        print(f"     {claim.reason}")
        if claim.first:
            print(f"     {claim.first}")
        print(f"     {_firmness(claim)}")
    if found:
        print(f"Datasets: {found['says']}")
    print(f"{len(claims)} claims in {claims.wall_time:.1f} s; {folder / PAGE}, {folder / RESULT}")
    return DONE


def _codes(claims: list[Claim]) -> list[str]:
    """What the codes of the study's faults stand for, of those that the closing lines use."""
    said = " ".join(
        f"{claim.verdict} {claim.scope} {claim.reason} {_firmness(claim)}" for claim in claims
    )
    used = [code for code in DESCRIPTIONS if re.search(rf"\b{code}\b", said)]
    lines = [f"  {code:<4} {DESCRIPTIONS[code]}" for code in used]
    return ["Faults of the study's scheme, by their numbers:", *lines] if lines else []


def _firmness(claim: Claim) -> str:
    """What would turn the verdict, in a line."""
    turn = claim.turns[0] if claim.turns else None
    if turn is None:
        return "turned by: nothing was tried"
    if claim.steady:
        return f"turned by: none of {len(claim.turns)} changes tried"
    return f"turned by: {turn.change} ({turn.figure})"
