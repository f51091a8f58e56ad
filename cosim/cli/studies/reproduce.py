"""`stickslip reproduce`: its arguments, what it runs, what it leaves behind."""

import sys
import time
from argparse import Namespace

from cosim.cli import DONE, FAILED
from cosim.cli.bar import Bar
from cosim.cli.numbers import numbers_asked
from cosim.interrupts import held_interrupts
from cosim.manifest import made_by, own_folder, results_in
from cosim.report.files import json_text
from cosim.studies.reproduction import Reproduction, claim_ids, reproduce
from cosim.studies.reproduction import claims as claims  # what judges them, once and for all
from cosim.studies.reproduction.result import PAGE, RESULT, printed


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
        _ = claims.datasets  # computed before anything is written
        with results_in(folder, made, force=arguments.force), Bar(total=1, unit="page"):
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
    print(printed(claims), end="")
    print(f"{len(claims)} claims in {claims.wall_time:.1f} s; {folder / PAGE}, {folder / RESULT}")
    return DONE
