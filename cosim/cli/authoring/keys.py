"""`stickslip keys`: what a scenario can say."""

from argparse import Namespace

from cosim.cli import DONE, BadInput
from cosim.cli.numbers import numbers_asked
from cosim.names import unknown_name
from cosim.report.files import json_text
from cosim.scenario.keys import Key, all_keys, found, shown


def execute(arguments: Namespace) -> int:
    """Print the keys; 0."""
    keys = all_keys()
    chosen = found(arguments.word, keys) if arguments.word else keys
    if not chosen:
        raise BadInput(unknown_name("key", arguments.word, [key.key for key in keys]))
    asked = numbers_asked(arguments, ("key", "default", "plain", "unit"))
    if not asked.give(json_text([key._asdict() for key in chosen])):
        for key in chosen:
            _print(key)
    return DONE


def _print(key: Key) -> None:
    plain = "" if key.plain == key.default or key.key == "name" else f" (plain: {shown(key.plain)})"
    print(f"{key.words}{plain}, allowed is {key.allowed}")
    print(f"    {key.description}")
