"""A file to an effect, and whatever is wrong with it in one line."""

import ast
import hashlib
import re
import sys
import traceback
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from keyword import iskeyword
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from pydantic import ValidationError

from ..effects.effect import Candidate, Effect, Scales
from ..generation.functions import TEXT
from ..generation.terms import terms_source
from ..quantity import Table, details
from ..text_file import read_text
from ..units import UNITS
from .check import check_translatable, try_terms
from .errors import PluginError

#: Entry points of installed distributions: each names a module with an EFFECT.
GROUP = "stickslip.effects"
#: What the names of modules that are made of files begin with.
OUTSIDE = "stickslip.plugins.of_file."
#: The tables of a scenario that are no effects.
TABLES = (
    "rig", "springs", "friction", "surface", "initial", "imperfections", "solver",
    "name", "effects", "defaults", "ambient", "belt", "block", "ice", "contact", "run",
    "coupling", "input", "measurement", "offset",  # of the unit, and `gap`
)  # fmt: skip
#: Of the file of an effect.
MOST_BYTES = 2**20
#: A campaign as there could be one, to see that the candidates can be made.
SCALES = Scales(
    speed=0.1, distance=2.0, heat=3.0, duration=20.0, stiffness=38.5, travel=0.02, mass=0.87,
    force=8.5, extension=0.03,
)  # fmt: skip


class Source(NamedTuple):
    """The file of an effect as it was read: its absolute name, and its text."""

    file: str
    text: str


def source_of(file: str | Path) -> Source:
    """A file as it is now. Raises PluginError where it cannot be read."""
    path = Path(file).resolve()
    try:
        return Source(str(path), read_text(path, MOST_BYTES))
    except OSError as error:
        raise PluginError(f"{path}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise PluginError(f"{path}: byte {error.start + 1} is not UTF-8") from None


@cache
def effect_in(source: Source) -> Effect:
    """The effect that a file declares: the file is executed, once in a process.

    Raises PluginError in one line.
    """
    module, file = _module(source), Path(source.file)
    try:
        _execute(module, file, source.text)
        effect = getattr(module, "EFFECT", None)
        if not isinstance(effect, Effect):
            what = "no" if effect is None else f"a {type(effect).__name__}, which is no"
            raise PluginError(f"{file}: has {what} EFFECT; allowed is EFFECT = Effect(...)")
        _check(effect, file, source.text)
        return effect
    except PluginError:
        del sys.modules[module.__name__]
        raise


def file_of(effect: Effect) -> Path | None:
    """The file that was named for an effect; None for one of the house or installed."""
    module = sys.modules[effect.table.__module__]
    outside = module.__name__.startswith(OUTSIDE) and module.__file__
    return Path(module.__file__) if outside and module.__file__ else None


@cache
def installed() -> tuple[Effect, ...]:
    """The effects of installed distributions. Raises PluginError."""
    found = []
    for entry in sorted(entry_points(group=GROUP), key=lambda each: each.name):
        where = f"installed effect {entry.name} = {entry.value}"
        if entry.dist is not None:
            where += f" (of {entry.dist.name}; `pip uninstall {entry.dist.name}` removes it)"
        found.append(_of_entry(entry, where))
    return tuple(found)


def _of_entry(entry: EntryPoint, where: str) -> Effect:
    try:
        loaded = entry.load()
    except Exception as error:
        raise PluginError(f"{where}: {_said(error)}") from error
    effect = getattr(loaded, "EFFECT", loaded)
    if not isinstance(effect, Effect):
        raise PluginError(f"{where}: is no Effect; allowed is a module with one named EFFECT")
    file = Path(sys.modules[effect.table.__module__].__file__ or "")
    _check(effect, file, file.read_text(encoding="utf-8"))
    return effect


def _module(source: Source) -> ModuleType:
    """An empty module for a file: of a name that only this text of it has."""
    file, digest = Path(source.file), hashlib.sha256("".join(source).encode()).hexdigest()[:12]
    name = f"{OUTSIDE}{re.sub(r'[^a-zA-Z0-9_]', '_', file.stem)}_{digest}"
    module = sys.modules[name] = ModuleType(name)
    module.__file__ = source.file
    vars(module)[TEXT] = source.text
    return module


def _execute(module: ModuleType, file: Path, text: str) -> None:
    """Run a file's code. Nothing is written beside it."""
    try:
        exec(compile(text, str(file), "exec"), vars(module))
    except SyntaxError as error:
        where = f", line {error.lineno}" if error.lineno else ""  # a null byte has none
        raise PluginError(f"{file}{where}: {error.msg}") from None
    except (Exception, SystemExit) as error:
        raise PluginError(f"{file}{_line(error, file)}: {_said(error)}") from error


def _line(error: BaseException, file: Path) -> str:
    """Where in a file an error came up."""
    lines = [f.lineno for f in traceback.extract_tb(error.__traceback__) if f.filename == str(file)]
    return f", line {lines[-1]}" if lines else ""


def _said(error: BaseException) -> str:
    if isinstance(error, ValidationError):
        first = error.errors()[0]
        return f"{'.'.join(map(str, first['loc']))}: {first['msg']}"
    said = " ".join(str(error).split())
    if isinstance(error, ValueError):
        return said
    return f"{type(error).__name__}: {said}" if said else type(error).__name__


def _check(effect: Effect, file: Path, text: str) -> None:
    """All that the catalogue's tests hold of its own entries; PluginError."""
    where = f"{file}, line {_declared(text)}"
    named = re.fullmatch(r"[a-z][a-z0-9_]*", effect.id) and not iskeyword(effect.id)
    if not named or effect.id in TABLES:
        raise PluginError(
            f"{where}: effect id {effect.id!r} cannot be the name of a table of its own; allowed "
            f"are small letters, digits and _, but no word of Python, none of {', '.join(TABLES)}"
        )
    if effect.table.__module__ not in sys.modules or not issubclass(effect.table, Table):
        raise PluginError(f"{where}: table is no Table of this file")
    _check_table(effect, file, text)
    check_translatable(effect, file, text)
    try:
        terms_source([effect])
        effect.table.model_validate(dict(effect.case.effect))
    except ValidationError as error:
        raise PluginError(f"{where}: case: {_said(error)}") from None
    except ValueError as error:
        raise PluginError(f"{where}: {_said(error)}") from None
    try_terms(effect, file)
    _check_candidates(effect, file, where)


def _declared(text: str) -> int:
    """Line of ``EFFECT = ...``."""
    for node in ast.parse(text).body:
        if isinstance(node, ast.Assign) and ast.unparse(node.targets[0]) == "EFFECT":
            return node.lineno
    return 1


def _check_table(effect: Effect, file: Path, text: str) -> None:
    """What a page says of it, and that each parameter is one number."""
    lines = {
        node.target.id: node.lineno
        for node in ast.walk(ast.parse(text))
        if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name)
    }
    if not effect.sentence:
        raise PluginError(
            f"{file}: {effect.table.__name__} has no docstring; needed is a sentence that says "
            "what the effect adds"
        )
    for name, field in effect.table.model_fields.items():
        where = f"{file}, line {lines.get(name, 1)}: {name}"
        if field.annotation not in (float, int) and name not in effect.core:
            raise PluginError(f"{where} is neither float nor int, which a parameter has to be")
        if field.is_required():
            raise PluginError(f"{where} has no default; needed is one, 0 for a switch")
        _check_unit(details(field)["unit"], where)
    for state in effect.states:
        _check_unit(state.unit, f"{file}: {state.name}")
    try:
        effect.table.model_validate(effect.table().model_dump())
    except ValidationError as error:
        raise PluginError(
            f"{file}: default of {_said(error)}; allowed is one in its bounds"
        ) from None


def _check_unit(unit: str, where: str) -> None:
    if unit not in UNITS:
        raise PluginError(
            f"{where} is in {unit!r}, which no unit has; allowed is one of {', '.join(UNITS)}"
        )


def _check_candidates(effect: Effect, file: Path, where: str) -> None:
    """That they can be made, and turn what there is."""
    try:
        made: list[Any] = list(effect.candidates(SCALES))
    except Exception as error:
        raise PluginError(f"{file}{_line(error, file)}: candidates: {_said(error)}") from error
    own = {f"{effect.id}.{name}" for name in effect.table.model_fields}
    for candidate in made:
        if not isinstance(candidate, Candidate) or candidate.effect != effect.id:
            raise PluginError(f"{where}: candidates: {candidate!r} is no Candidate of {effect.id}")
        for key in (*(free.key for free in candidate.free_parameters), *candidate.settings):
            if key.startswith(f"{effect.id}.") and key not in own:
                raise PluginError(
                    f"{where}: candidates: {key} is no parameter; there are {', '.join(own)}"
                )
