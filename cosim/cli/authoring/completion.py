"""`stickslip completion`: a script by which a shell completes commands, options and files."""

from __future__ import annotations

from argparse import Action, ArgumentParser, Namespace, _SubParsersAction
from collections.abc import Iterator
from typing import Any

from cosim.cli import DONE, BadInput
from cosim.cli.arguments import COMMANDS

EXAMPLE = "stickslip completion bash"
SHELLS = ("bash", "zsh", "fish")
#: What stands for a file where there is no metavar that says so.
FILES = ("scenario", "campaign", "system", "source", "a", "b")
#: What a key of a scenario follows, to be given a value; `couple` sets keys of its own.
KEYED, NOT_KEYED = ("changes", "vary"), "couple"


def add_arguments(parser: ArgumentParser) -> None:
    """The arguments of the command."""
    parser.add_argument(
        "shell",
        choices=SHELLS,
        help="whose script is printed (needs `pip install shtab`). bash: write it to "
        "~/.local/share/bash-completion/completions/stickslip; zsh: to _stickslip in a folder of "
        "$fpath; fish: to ~/.config/fish/completions/stickslip.fish",
    )


def execute(arguments: Namespace) -> int:
    """Print the script; 0."""
    try:
        import shtab
    except ImportError:
        raise BadInput(
            "completion: shtab is not installed, allowed after pip install shtab"
        ) from None
    from cosim.cli.arguments import parser
    from cosim.scenario import packaged_scenarios
    from cosim.scenario.keys import all_keys

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
    preamble: Any = {
        shell: text.replace("@NAMES@", names).replace("@KEYS@", keys)
        for shell, text in PREAMBLE.items()
    }
    print(shtab.complete(whole, shell=arguments.shell, preamble=preamble))
    if arguments.shell == "bash":
        print(NO_SPACE)
    return DONE


def _actions(parser: ArgumentParser, command: str = "") -> Iterator[tuple[str, Action]]:
    """Every argument of every command, with the command."""
    for action in parser._actions:
        yield command, action
        if isinstance(action, _SubParsersAction):
            for name, inner in action.choices.items():
                yield from _actions(inner, name)


#: A packaged scenario or a TOML file, in the words of each shell.
SCENARIOS: dict[str, Any] = {
    "bash": "_stickslip_scenarios",
    "zsh": "_stickslip_scenarios",
    "fish": "_stickslip_scenarios",
}
#: A key of a scenario and its sign of equality.
KEYS: dict[str, Any] = dict.fromkeys(SHELLS, "_stickslip_keys")
#: Behind that sign comes the value, behind a folder what is in it, and no space.
NO_SPACE = """
_stickslip_complete() {
  _shtab_stickslip
  if [[ ${#COMPREPLY[@]} -eq 1 && ${COMPREPLY[0]} == *[=/] ]]; then compopt -o nospace; fi
}
complete -o bashdefault -F _stickslip_complete stickslip
"""
PREAMBLE = {
    "bash": """
_stickslip_scenarios() {
  compgen -W "@NAMES@" -- "$1"
  compgen -f -X '!*.toml' -- "$1"
  compgen -f -X '!*.ssp' -- "$1"
  compgen -d -S '/' -- "$1"
}
_stickslip_keys() {
  compgen -W "@KEYS@" -- "$1"
}
""",
    "zsh": """
_stickslip_scenarios() {
  _alternative 'names:packaged scenario:(@NAMES@)' 'files:file:_files -g "*.(toml|ssp)"'
}
_stickslip_keys() {
  compadd -S '' -- @KEYS@
}
""",
    "fish": """
function _stickslip_scenarios
  printf '%s\\n' @NAMES@
  __fish_complete_suffix .toml
end
function _stickslip_keys
  printf '%s\\n' @KEYS@
end
""",
}
