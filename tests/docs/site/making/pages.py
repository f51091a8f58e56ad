"""What is made at build time, from the code that it describes: parts of pages, and a figure.

Each part is a Markdown file in `made/`, which a page takes in by `{include}`.
"""

from pathlib import Path

from . import benchmarks, commands, effects, examples, fmu, keys, python, results, verification

PARTS = {
    "commands": commands.text,
    "keys": keys.scenario,
    "campaign": keys.campaign,
    "system": keys.system,
    "effects": effects.text,
    "mechanics_unit": fmu.mechanics,
    "thermal_unit": fmu.thermal,
    "result_variables": results.variables,
    "result_figures": results.figures,
    "python": python.text,
    "verification": verification.text,
    "benchmarks": benchmarks.text,
    "examples": examples.text,
}


def make(app):
    """Write them beside the sources, before these are read."""
    folder = Path(app.srcdir) / "made"
    folder.mkdir(exist_ok=True)
    for name, part in PARTS.items():
        (folder / f"{name}.md").write_text(part(), encoding="utf-8")
    benchmarks.draw_cost(folder / "coupling_cost.svg")


def setup(app):
    """Sphinx: before reading."""
    app.connect("builder-inited", make)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
