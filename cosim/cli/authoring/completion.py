"""`stickslip completion`: a script by which a shell completes commands, options and files."""

from __future__ import annotations

from argparse import Action, ArgumentParser, Namespace, _SubParsersAction
from collections.abc import Iterator
from typing import Any

from cosim.cli import DONE
from cosim.cli.arguments import COMMANDS

EXAMPLE = "stickslip completion bash"
SHELLS = ("bash", "zsh", "fish")
#: What stands for a file where there is no metavar that says so.
FILES = ("scenario", "campaign", "system", "source")


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument(
        "shell",
        choices=SHELLS,
        help="whose script is printed. bash: write it to "
        "~/.local/share/bash-completion/completions/stickslip; zsh: to _stickslip in a folder of "
        "$fpath; fish: to ~/.config/fish/completions/stickslip.fish",
    )


def refused() -> tuple[type[Exception], ...]:
    """What is bad input."""
    from cosim.files import OutputRefused

    return (OutputRefused,)


def execute(arguments: Namespace) -> int:
    """Print the script; 0."""
    import shtab

    from cosim.cli.arguments import parser
    from cosim.scenario import packaged_scenarios

    whole = parser(list(COMMANDS))
    for action in _actions(whole):
        if action.dest in FILES:
            action.complete = SCENARIOS  # type: ignore[attr-defined]  # shtab looks for it
        elif action.metavar == "DIR":
            action.complete = shtab.DIRECTORY  # type: ignore[attr-defined]
        elif action.metavar == "FILE":
            action.complete = shtab.FILE  # type: ignore[attr-defined]
    names = " ".join(packaged_scenarios())
    # a text for each shell, whatever its declaration says
    preamble: Any = {shell: text.replace("@NAMES@", names) for shell, text in PREAMBLE.items()}
    print(shtab.complete(whole, shell=arguments.shell, preamble=preamble))
    return DONE


def _actions(parser: ArgumentParser) -> Iterator[Action]:
    """Every argument of every command."""
    for action in parser._actions:
        yield action
        if isinstance(action, _SubParsersAction):
            for command in action.choices.values():
                yield from _actions(command)


#: A packaged scenario or a TOML file, in the words of each shell.
SCENARIOS: dict[str, Any] = {
    "bash": "_stickslip_scenarios",
    "zsh": "_stickslip_scenarios",
    "fish": "_stickslip_scenarios",
}
PREAMBLE = {
    "bash": """
_stickslip_scenarios() {
  compgen -W "@NAMES@" -- "$1"
  compgen -f -X '!*.toml' -- "$1"
  compgen -f -X '!*.ssp' -- "$1"
  compgen -d -S '/' -- "$1"
}
""",
    "zsh": """
_stickslip_scenarios() {
  _alternative 'names:packaged scenario:(@NAMES@)' 'files:file:_files -g "*.(toml|ssp)"'
}
""",
    "fish": """
function _stickslip_scenarios
  printf '%s\\n' @NAMES@
  __fish_complete_suffix .toml
end
""",
}
