"""The public names of the packages, each by its docstring."""

import inspect
from importlib import import_module

from pydantic import BaseModel

from .markdown import code, heading, table

#: Modules whose names are public, and what they are for.
MODULES = {
    "stickslip": "The mechanics: parameters, simulation, the catalogue of effects.",
    "thermal": "The heat in belt and ice, by itself.",
    "cosim": "The way in: scenarios, runs, studies, campaigns and systems, all from here.",
    "cosim.coupling": "The master: participants, connections, schemes, the energy ledger.",
    "cosim.systems": "Systems of units from SSP and TOML files.",
    "cosim.gap": "Measured campaigns, and what the model lacks of them.",
    "cosim.studies.belt_length": "How long a belt must be.",
    "cosim.studies.stability": "Which motions a rig has, and keeps to.",
    "cosim.studies.friction_map": "Friction against speed and temperature.",
    "cosim.studies.sweep": "Every combination of some values.",
    "cosim.report": "Datasets and files of results.",
}


def text() -> str:
    """A section for each module; tables of parameters are a list, as their keys are elsewhere."""
    return "".join(_section(name, said) for name, said in MODULES.items())


def _section(module: str, said: str) -> str:
    public = {name: getattr(import_module(module), name) for name in names_of(module)}
    elsewhere = {name: home for name, what in public.items() if (home := _home(module, name, what))}
    public = {name: what for name, what in public.items() if name not in elsewhere}
    tables = {name for name, what in public.items() if _is_table(what)}
    parts = [heading(2, module, f"python-{module}"), f"{said}\n\n"]
    for name, what in public.items():
        if name not in tables and (directive := _directive(what)):
            parts.append(_documented(f"{module}.{name}", directive))
    if tables:
        rows = [(code(name), (public[name].__doc__ or "").split("\n\n")[0]) for name in tables]
        parts.append("Tables of parameters; their keys: [Keys of a scenario](scenario.md).\n\n")
        parts.append(table(("class", "is"), sorted(rows)))
    if elsewhere:
        rows = [(code(name), code(home)) for name, home in sorted(elsewhere.items())]
        parts.append(table(("also here", "told of at"), rows))
    return "".join(parts)


def _home(module: str, name: str, what: object) -> str:
    """The other module here that tells of a name; "" where this one does."""
    others = [other for other in MODULES if other != module and other.startswith(f"{module}.")]
    return next((o for o in others if getattr(import_module(o), name, None) is what), "")


def names_of(module: str) -> list[str]:
    """What is public in a module: `__all__`, or what it imports as itself."""
    home = import_module(module)
    imported = [name for name, what in vars(home).items()
                if not (name.startswith("_") or inspect.ismodule(what))]  # fmt: skip
    return sorted(getattr(home, "__all__", imported))


def _is_table(what: object) -> bool:
    return inspect.isclass(what) and issubclass(what, BaseModel)


def _directive(what: object) -> str:
    if inspect.isclass(what):
        return "autoexception" if issubclass(what, BaseException) else "autoclass"
    return "autofunction" if callable(what) else ""


def _documented(name: str, directive: str) -> str:
    members = "   :members:\n" if directive == "autoclass" else ""
    return f"```{{eval-rst}}\n.. {directive}:: {name}\n{members}```\n\n"
