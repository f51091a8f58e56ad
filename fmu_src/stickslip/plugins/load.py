"""A file to an effect, and whatever is wrong with it in one line."""

from __future__ import annotations

import ast
import linecache
import re
import sys
import traceback
from collections.abc import Iterator
from importlib.metadata import EntryPoint, entry_points
from keyword import iskeyword
from pathlib import Path
from types import ModuleType
from typing import Any

from pydantic import ValidationError

from ..effects.candidate import Candidate, Scales
from ..effects.effect import Effect
from ..generation.terms import terms_source
from ..quantity import Table
from ..text_file import read_text
from .active_plugins import GROUP, files
from .check import check_translatable
from .errors import PluginError
from .trial import try_terms

#: The tables of a scenario that are no effects.
TABLES = (
    *("rig", "springs", "friction", "surface", "initial", "imperfections", "solver"),
    *("name", "effects", "defaults", "ambient", "belt", "block", "ice", "contact", "run"),
    *("coupling", "input", "measurement", "offset"),  # of the unit, and `gap`
)
#: Of the file of an effect.
MOST_BYTES = 2**20
#: A campaign as there could be one, to see that the candidates can be made.
SCALES = Scales(
    speed=0.1, distance=2.0, heat=3.0, duration=20.0, stiffness=38.5, travel=0.02, mass=0.87,
    force=8.5, extension=0.03,
)  # fmt: skip


def plugged(known: tuple[Effect, ...]) -> tuple[Effect, ...]:
    """The effects of this process from outside: of its files, then of what is installed.

    known : the catalogue. Raises PluginError in one line.
    """
    found: dict[str, Effect] = {}
    for where, effect in (*_of_files(), *_installed()):
        if effect.id in found or any(effect.id == each.id for each in known):
            raise PluginError(
                f"{where}: effect id {effect.id!r} is taken; allowed is another than "
                f"{', '.join([*(each.id for each in known), *found])}"
            )
        found[effect.id] = effect
    return tuple(found.values())


def file_of(effect: Effect) -> Path | None:
    """The file that was named for an effect; None for one of the catalogue or installed."""
    file = Path(getattr(sys.modules[effect.table.__module__], "__file__", None) or "")
    return file if file in files() else None


def _of_files() -> Iterator[tuple[Path, Effect]]:
    for file in files():
        yield file, effect_in(file)


def _installed() -> Iterator[tuple[str, Effect]]:
    for entry in sorted(entry_points(group=GROUP), key=lambda each: each.name):
        where = f"installed effect {entry.name} = {entry.value}"
        if entry.dist is not None:
            where += f" (of {entry.dist.name}; `pip uninstall {entry.dist.name}` removes it)"
        yield where, _of_entry(entry, where)


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


def effect_in(file: Path) -> Effect:
    """The effect that a file declares: the file is executed. Raises PluginError in one line."""
    module, text = _module(file)
    try:
        return _declared_in(module, file, text)
    except PluginError:
        del sys.modules[module.__name__]
        raise


def _declared_in(module: ModuleType, file: Path, text: str) -> Effect:
    _execute(module, file, text)
    effect = getattr(module, "EFFECT", None)
    if not isinstance(effect, Effect):
        what = "no" if effect is None else f"a {type(effect).__name__}, which is no"
        raise PluginError(f"{file}: has {what} EFFECT; allowed is EFFECT = Effect(...)")
    _check(effect, file, text)
    return effect


def _module(file: Path) -> tuple[ModuleType, str]:
    """An empty module for a file, and the file's text."""
    try:
        text = read_text(file, MOST_BYTES)
    except OSError as error:
        raise PluginError(f"{file}: cannot be read: {error.strerror}") from None
    except UnicodeDecodeError as error:
        raise PluginError(f"{file}: byte {error.start + 1} is not UTF-8") from None
    # below a module that reads the effects, so that a process that is handed a number of one can
    # find its class
    name = f"stickslip.effects.outside.{re.sub(r'[^a-zA-Z0-9_]', '_', file.stem)}"
    if name in sys.modules:
        raise PluginError(
            f"{file}: another effect's file has the same name; allowed is one of each name"
        )
    module = sys.modules[name] = ModuleType(name)
    module.__file__ = str(file)
    # the terms are read from the text that was executed, not from what the file holds by then
    linecache.cache[str(file)] = (len(text), None, text.splitlines(keepends=True), str(file))
    return module, text


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
    try:
        effect.table.model_validate(effect.table().model_dump())
    except ValidationError as error:
        raise PluginError(
            f"{file}: default of {_said(error)}; allowed is one in its bounds"
        ) from None


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
