"""A command that is a study: what its module refuses is bad input."""

from __future__ import annotations

from argparse import Namespace

from cosim.cli.arguments import study_module
from cosim.cli.errors import refusing


def main(arguments: Namespace) -> int:
    """Carry the study out; the exit status."""
    study = study_module(arguments.command)
    with refusing(*study.REFUSED):
        return study.execute(arguments)
