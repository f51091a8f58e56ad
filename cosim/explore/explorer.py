"""The explorer's page: one file with both models, the controls, scenarios and the scripts."""

import base64
import re
import zlib
from importlib import resources
from importlib.metadata import version
from typing import Any

from stickslip.catalogue import CATALOGUE, Catalogue, default_catalogue
from stickslip.kernel import layout
from stickslip.kernel.tables import value_names
from stickslip.ports import OUTPUTS

from cosim.explore.controls import groups
from cosim.fmu import web
from cosim.fmu.thermal.variables import outputs
from cosim.report.page import UPLOT, asset, render
from cosim.scenario import Scenario, read_scenario

#: Packaged scenarios that can be begun with, beside that which was asked for.
PRESETS = ("reference", "study", "slab")
#: Scripts that a run's page has, too; then those of this page, in the order in which they need each
#: other. That of the models runs in a thread of its own, without the others.
SHARED = (UPLOT, "live.js", "plot.js", "rig.js")
WORKER = "worker.js"
SCRIPTS = (
    "units.js", "scenario.js", "checks.js", "runs.js", "statistics.js", "plots.js",
    "pictures.js", "regimes.js", "top_view.js", "controls.js", "main.js",
)  # fmt: skip
#: Of a belt: the unit has room for so many with any number of modes.
MOST_CELLS = 2048
#: Says, in the page, which tool has made it.
GENERATOR = '<meta name="generator" content="stickslip explore">'


def explorer_page(scenario: Scenario | None = None) -> str:
    """HTML of the explorer, opened on a scenario (left out: the reference case).

    One file that needs nothing else. Raises CompilerError where there is no WebAssembly of the
    kernel: a checkout without zig.
    """
    catalogue = default_catalogue() if scenario is None else scenario.catalogue
    return render(
        "explorer.html.j2",
        "cosim.explore",
        generator=GENERATOR,
        version=version("stickslip"),
        style=_text("explorer.css"),
        data=page_data(scenario, catalogue),
        worker=_text(WORKER),
        programs=[(name, asset(name)) for name in SHARED]
        + [(name, _text(name)) for name in SCRIPTS],
    )


def page_data(scenario: Scenario | None = None, catalogue: Catalogue = CATALOGUE) -> dict[str, Any]:
    """What the scripts are told: both models, scenarios, controls, and places in their arrays."""
    scenarios = [read_scenario(name) for name in PRESETS]
    presets = [preset(each) for each in scenarios]
    chosen = preset(scenario) if scenario is not None else presets[0]
    if scenario is not None and chosen not in presets:
        presets.insert(0, chosen)
        scenarios.insert(0, scenario)
    warmth = outputs()
    return {
        "version": version("stickslip"),
        "kernel": _packed(web.module(web.NAME, catalogue)),
        "heat": _packed(web.module(web.HEAT)),
        "presets": [
            each | {"heat": _heat(of)} for each, of in zip(presets, scenarios, strict=True)
        ],
        "chosen": presets.index(chosen),
        "groups": groups(catalogue),
        "names": list(value_names(catalogue.effects)),
        "outputs": {port.name: getattr(layout, port.slot) for port in OUTPUTS}
        | {each.name: layout.O_SIZE + i for i, each in enumerate(warmth)},
        "sizes": {
            "row": layout.O_SIZE,
            "warmth": len(warmth),
            "all": layout.O_SIZE + len(warmth),
            "event": layout.E_WIDTH,
            "inputs": layout.U_SIZE,
            "speed": layout.U_SPEED,
            "temperature": layout.U_TEMPERATURE,
        },
        "belt_width": Scenario().belt.width,
    }


def preset(scenario: Scenario) -> dict[str, Any]:
    """Name and tables of a scenario: what departs from the plain model, and what says so."""
    plain = Scenario().to_tables()
    tables: dict[str, Any] = {}
    for name, value in scenario.to_tables().items():
        if isinstance(value, dict):
            known = plain.get(name, {}).items()
            departs = {key: entry for key, entry in value.items() if (key, entry) not in known}
            tables |= {name: departs} if departs else {}
    top = {name: value for name, value in plain.items() if not isinstance(value, dict)}
    return {"name": scenario.name, "top": top | {"name": scenario.name}, "tables": tables}


def _heat(scenario: Scenario) -> dict[str, Any]:
    """Of belt and ice: their matrices, and the parameters of the unit; or why there are none.

    A belt that is too long for the unit is cut into longer cells.
    """
    from cosim.fmu.thermal import resources  # scikit-fem
    from thermal import MeshError, ParameterError

    parameters = scenario.thermal
    shortest = parameters.belt.length / MOST_CELLS
    belt = parameters.belt.model_copy(
        update={"cell_length": max(parameters.belt.cell_length, shortest)}
    )
    try:
        made = resources.reduction(parameters.model_copy(update={"belt": belt}))
    except (ParameterError, MeshError, resources.TooLarge) as error:
        return {"block": _packed(b""), "parameters": {}, "why": str(error)}
    return {
        "block": _packed(resources.packed(made)),
        "parameters": resources.starts(made),
        "why": "",
    }


def _packed(content: bytes) -> str:
    return base64.b64encode(zlib.compress(content, 9)).decode("ascii")


def _text(name: str) -> str:
    """A file of the folder `page`, as it is."""
    text = (resources.files("cosim.explore") / "page" / name).read_text("utf-8")
    return _inside_script(text) if name.endswith(".js") else text


def _inside_script(text: str) -> str:
    """Text between script tags: nothing in it may look like the tag that ends it, or a comment.

    In a string of JavaScript or JSON the backslash means nothing there.
    """
    return re.sub(r"<(?=/script|!--)", r"\\u003c", text, flags=re.IGNORECASE)


def made_here(text: str) -> bool:
    """Whether a page, or how one begins, is the explorer's."""
    return GENERATOR in text
