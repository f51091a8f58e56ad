"""`stickslip completion`: a script by which a shell completes commands, options and files."""

from argparse import Action, ArgumentParser, Namespace, _SubParsersAction
from collections.abc import Iterator
from typing import Any

from stickslip.packaged import packaged_tables

from cosim.cli import DONE, BadInput
from cosim.cli.arguments import COMMANDS, parser
from cosim.scenario import packaged_scenarios
from cosim.scenario.keys import all_keys

SHELLS = ("bash", "zsh", "fish")
#: What stands for a file where there is no metavar that says so.
FILES = ("scenario", "campaign", "system", "source", "a", "b")
#: What a key of a scenario follows, to be given a value; `couple` sets keys of its own.
KEYED, NOT_KEYED = ("changes", "vary"), "couple"


def execute(arguments: Namespace) -> int:
    """Print the script; 0."""
    try:
        import shtab
    except ImportError:
        raise BadInput(
            "completion: shtab is not installed, allowed after pip install shtab"
        ) from None
    whole = parser(list(COMMANDS))
    for command, action in _actions(whole):
        if action.dest in KEYED and command != NOT_KEYED:
            action.complete = KEYS  # type: ignore[attr-defined]
        elif action.dest in FILES:
            action.complete = SCENARIOS  # type: ignore[attr-defined]  # shtab looks for it
        elif action.metavar == "DIR":
            action.complete = shtab.DIRECTORY  # type: ignore[attr-defined]
        elif action.metavar == "FILE":
            action.complete = shtab.FILE  # type: ignore[attr-defined]
    names = " ".join(packaged_scenarios())
    # a text for each shell, whatever its declaration says
    keys = " ".join(f"{one.key}=" for one in all_keys() if "[]" not in one.key)
    texts = packaged_tables(__package__, "completion.toml")
    preamble: Any = {
        shell: text.replace("@NAMES@", names).replace("@KEYS@", keys)
        for shell, text in texts["preamble"].items()
    }
    print(shtab.complete(whole, shell=arguments.shell, preamble=preamble))
    if arguments.shell == "bash":
        print(texts["after"])
    return DONE


def _actions(parser: ArgumentParser, command: str = "") -> Iterator[tuple[str, Action]]:
    """Every argument of every command, with the command."""
    for action in parser._actions:
        yield command, action
        if isinstance(action, _SubParsersAction):
            for name, inner in action.choices.items():
                yield from _actions(inner, name)


#: Of each shell, what completes a packaged scenario or a TOML file, and a key of a scenario.
SCENARIOS: dict[str, Any] = dict.fromkeys(SHELLS, "_stickslip_scenarios")
KEYS: dict[str, Any] = dict.fromkeys(SHELLS, "_stickslip_keys")
