"""`stickslip effect new`: a custom effect, to begin with."""

from argparse import Namespace
from importlib import resources
from pathlib import Path

from stickslip.effects import EFFECTS
from stickslip.plugins.load import TABLES

from cosim.cli import DONE
from cosim.files import OutputRefused, writable, write_unless_owned


def execute(arguments: Namespace) -> int:
    """Write the file and say what can be done with it."""
    file: Path = arguments.file
    name = file.stem
    if name in {*TABLES, *(effect.id for effect in EFFECTS)}:
        raise OutputRefused(
            f"{file}: the name {name} is in use, allowed is another; `stickslip effects` lists them"
        )
    writable(file.parent)
    write_unless_owned({file.name: text_of(name)}, file.parent, arguments.force)
    print(
        f"{file}: effect {name}, which works as it is\n"
        f'  in a scenario: effects = ["{file.name}"] at its top, and a table [{name}] with '
        "fall = 0.3\n"
        f"  its page:      stickslip effects {file} -o results/{name}"
    )
    return DONE


def text_of(name: str) -> str:
    """The template as the file of an effect of this name."""
    text = (resources.files("stickslip.plugins") / "template.py").read_text(encoding="utf-8")
    title = "".join(part.capitalize() for part in name.split("_"))
    return text.replace("Template", title).replace("template", name)
