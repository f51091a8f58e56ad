"""The arguments of `stickslip` and its commands."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from importlib import import_module
from importlib.metadata import version
from types import ModuleType
from typing import NoReturn

SCENARIO_HELP = (
    "TOML file, or the name of a packaged scenario such as reference (default), slab, warm_friction"
)
OUTPUT_HELP = "folder of the results; made when missing (default: results/NAME OF THE SCENARIO)"


# command -> what it does, an example
STUDIES = {
    "belt-length": (
        "how long the belt must be: drift of its temperature, loop after loop",
        "stickslip belt-length --length 1 2 4 --speed 0.15 0.82 -o results/belt",
    ),
    "effects": (
        "the catalogue of effects: what each adds, its parameters, and a figure",
        "stickslip effects -o results/effects",
    ),
    "friction-map": (
        "friction against speed and temperature in steady coupled sliding",
        "stickslip friction-map melting_friction --ambient -8 -o results/friction",
    ),
    "gap": (
        "what model and measurement disagree on: names the missing effect, adds it, shows it",
        "stickslip gap cold_room/campaign.toml -o results/cold_room",
    ),
    "reproduce": (
        "the source study's claims C1 to C15, each with its number, ours, and a verdict",
        "stickslip reproduce C6 C13 -o results/claims",
    ),
    "stability": (
        "which steady motions a rig has, and which it can keep to: maps and a page",
        "stickslip stability study --grid 20 -o results/stability",
    ),
    "sweep": (
        "parameter sweep: every combination of some values",
        "stickslip sweep reference --vary rig.mass=0.67,2.03 --vary surface.speed=0.15,0.37,0.82",
    ),
}

STUDY_MODULES = {
    "belt-length": "cosim.cli.belt_length",
    "effects": "cosim.cli.effects",
    "friction-map": "cosim.cli.friction_map",
    "gap": "cosim.cli.gap",
    "reproduce": "cosim.cli.reproduce",
    "stability": "cosim.cli.stability",
    "sweep": "cosim.cli.sweep",
}


class Parser(argparse.ArgumentParser):
    """An argparse parser whose errors are one line."""

    def error(self, message: str) -> NoReturn:
        """Refuse the arguments, exit status 2."""
        print(f"error: {message}; see {self.prog} --help", file=sys.stderr)
        raise SystemExit(2)


def parser(arguments: Sequence[str]) -> Parser:
    """The parser of the whole command line; `home` names the module that carries a command out.

    A study declares its own arguments. It is imported only where ``arguments`` name it, so that
    help and the other commands stay quick.
    """
    top = Parser(
        prog="stickslip",
        description="Stick-slip of an ice block on a moving surface, coupled to the heat it makes.",
        epilog="example: stickslip run",
        allow_abbrev=False,
    )
    top.add_argument("--version", action="version", version=f"stickslip {version('stickslip')}")
    top.add_argument("--debug", action="store_true", help="show the traceback of an error")
    commands = top.add_subparsers(dest="command", required=True, metavar="COMMAND")
    _add_run(commands)
    _add_simulate(commands)
    _add_build(commands)
    for name in STUDIES:
        _add_study(commands, name, chosen=name in arguments)
    return top


def _add_command(
    commands: argparse._SubParsersAction, name: str, summary: str, example: str
) -> Parser:
    command = commands.add_parser(
        name,
        help=summary,
        description=summary[0].upper() + summary[1:] + ".",
        epilog=f"example: {example}",
        allow_abbrev=False,
    )
    # Also behind the command's name; suppressed, so that it does not undo one in front of it.
    command.add_argument(
        "--debug", action="store_true", default=argparse.SUPPRESS, help="show tracebacks"
    )
    command.set_defaults(home=name)
    return command


def _add_study(commands: argparse._SubParsersAction, name: str, chosen: bool) -> None:
    summary, example = STUDIES[name]
    command = _add_command(commands, name, summary, example)
    command.set_defaults(home="study")
    if chosen:
        study_module(name).add_arguments(command)


def study_module(name: str) -> ModuleType:
    """The module of a study: `add_arguments`, `execute` and the errors that are `REFUSED` input."""
    return import_module(STUDY_MODULES[name])


def _add_run(commands: argparse._SubParsersAction) -> None:
    run = _add_command(
        commands,
        "run",
        "the coupled case: the mechanical FMU and the heat in belt and ice",
        "stickslip run my_case.toml -o results/first",
    )
    run.add_argument("scenario", nargs="?", default="reference", help=SCENARIO_HELP)
    run.add_argument("-o", "--output", metavar="DIR", help=OUTPUT_HELP)
    run.add_argument(
        "--fmu",
        metavar="FILE",
        help="the mechanical FMU (default: that in build of a checkout, or else in the user's cache"
        " folder, built when missing or stale)",
    )
    run.add_argument(
        "--animation",
        action="store_true",
        help="also write temperature.gif: belt and ice, a frame every run.snapshot_interval",
    )


def _add_simulate(commands: argparse._SubParsersAction) -> None:
    simulate = _add_command(
        commands,
        "simulate",
        "the mechanics alone, without FMU and heat conduction",
        "stickslip simulate reference -o results/mechanics",
    )
    simulate.add_argument("scenario", nargs="?", default="reference", help=SCENARIO_HELP)
    simulate.add_argument("-o", "--output", metavar="DIR", help=OUTPUT_HELP)


def _add_build(commands: argparse._SubParsersAction) -> None:
    build = _add_command(
        commands,
        "build",
        "builds StickSlip3DOF.fmu (FMI 2.0 co-simulation) for any FMI tool",
        "stickslip build -o fmus",
    )
    build.add_argument(
        "-o",
        "--output",
        metavar="DIR",
        help="folder of the FMU (default: build of a checkout, else the user's cache folder)",
    )
    build.add_argument("--fmi", choices=["2"], default="2", help="version of FMI (default: 2)")
