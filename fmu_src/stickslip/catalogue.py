"""A catalogue of effects as a value, and what is made of it: the kernel, and how numbers enter it.

The house's own is `CATALOGUE`, whose kernel is that of `stickslip.kernel`. One with custom effects
behind them has a kernel of its own, laid out for them; any number of them can be in one process:

>>> CATALOGUE.with_files() is CATALOGUE
True

A catalogue that is sent to another process takes the text of its files along, so that whatever is
made of it (parameters, scenarios) can be sent to where the files are not.
"""

from __future__ import annotations

import os
import sys
import threading
from collections.abc import Callable, Mapping
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path
from types import ModuleType, SimpleNamespace
from typing import TYPE_CHECKING, Any

from . import contradictions, packing
from .compiled import library
from .effects import EFFECTS, PluginError
from .effects.effect import Effect
from .generation.c_program import Program
from .generation.source import kernel_source, travelling
from .kernel import MODULES
from .plugins.load import Source, effect_in, installed, source_of

if TYPE_CHECKING:
    import numpy as np

#: Of the environment: files of effects that every scenario and campaign has, joined as in PATH.
VARIABLE = "STICKSLIP_EFFECTS"
_LOADING = threading.Lock()


class Catalogue:
    """Effects, and the kernel that is laid out for them.

    Attributes
    ----------
    effects : the house's, then those of files, then those of installed distributions
    sources : files of custom effects, as they were read
    text : the kernel as the text of one module
    """

    def __init__(self, outside: tuple[Effect, ...] = (), sources: tuple[Source, ...] = ()) -> None:
        self.outside, self.sources = outside, sources
        self.effects = (*EFFECTS, *outside) if outside else EFFECTS

    @property
    def files(self) -> tuple[Path, ...]:
        """Of custom effects, absolute."""
        return tuple(Path(source.file) for source in self.sources)

    def with_files(self, *files: str | Path) -> Catalogue:
        """The same and, behind them, the effects of files, which are executed.

        Raises PluginError in one line.
        """
        sources = {each.file: each for each in (*self.sources, *map(source_of, files))}
        return _catalogue(tuple(sources.values()), self._has_installed)

    def __reduce__(self) -> tuple[Callable[..., Catalogue], tuple[Any, ...]]:
        """As the texts that it is made of."""
        return _catalogue, (self.sources, self._has_installed)

    @property
    def _has_installed(self) -> bool:
        return len(self.outside) > len(self.sources)

    @cached_property
    def text(self) -> str:
        return kernel_source(self.effects)

    @cached_property
    def kernel(self) -> Any:
        """The kernel's functions and numbers (see `kernel.layout`) by their names, interpreted."""
        if self.outside:
            return self._travelling["kernel"]
        names: dict[str, Any] = {}
        for module in MODULES:
            names |= vars(import_module(f".kernel.{module}", __package__))
        return SimpleNamespace(**names)

    @cached_property
    def compiled(self) -> Any:
        """The kernel's functions as machine code where there is a compiler, else interpreted."""
        with _LOADING:
            return library(self.text)

    @cached_property
    def _travelling(self) -> Mapping[str, ModuleType]:
        """What travels inside the unit of these effects, as modules of this process."""
        package = ModuleType(f"stickslip.of_effects_{id(self):x}")
        sys.modules[package.__name__] = package
        made = {}
        for name, text in travelling(self.effects).items():
            made[name] = module = ModuleType(f"{package.__name__}.{name}")
            module.__package__ = package.__name__
            sys.modules[module.__name__] = module
            setattr(package, name, module)  # for `from . import kernel`
            exec(compile(text, f"<{name} of the effects>", "exec"), vars(module))
        return made

    def pack(self, values: Mapping[str, float]) -> list[float]:
        """The kernel's vector ``p``, see `packing.pack`."""
        packed: list[float] = self._packing.pack(values)
        return packed

    def packed(self, values: Mapping[str, float]) -> np.ndarray:
        """The same by machine code, in half the time."""
        import numpy as np  # a wheel's libraries are made without it

        v, p = np.array(self._packing.in_order(values)), np.zeros(self.kernel.P_SIZE)
        self.compiled.pack(v, np.array(self._packing.draws(v)), p)
        return p

    @property
    def _packing(self) -> Any:
        return self._travelling["packing"] if self.outside else packing

    def contradiction(self, values: Mapping[str, float]) -> str:
        """What the parameters contradict in, see `contradictions.contradiction`."""
        own = self._travelling["contradictions"] if self.outside else contradictions
        said: str = own.contradiction(values)
        return said


#: The house's effects alone.
CATALOGUE = Catalogue()


@cache
def _catalogue(sources: tuple[Source, ...], has_installed: bool) -> Catalogue:
    found = {each.id: each for each in EFFECTS}
    custom = [(source.file, effect_in(source)) for source in sources]
    further = [("installed effect", each) for each in installed()] if has_installed else []
    for where, effect in (*custom, *further):
        if effect.id in found:
            raise PluginError(
                f"{where}: effect id {effect.id!r} is taken; allowed is another than "
                f"{', '.join(found)}"
            )
        found[effect.id] = effect
    outside = tuple(found.values())[len(EFFECTS) :]
    if not outside:
        return CATALOGUE
    made = Catalogue(outside, sources)
    try:
        Program(made.text)  # refuses two functions of one name, as the layout does numbers
    except ValueError as error:
        raise PluginError(f"{', '.join(where for where, _ in custom)}: {error}") from None
    return made


def default_catalogue() -> Catalogue:
    """What scenarios and campaigns have that name no effects: installed ones, and of `VARIABLE`.

    Raises PluginError in one line.
    """
    named = os.environ.get(VARIABLE, "").split(os.pathsep)
    return _catalogue(tuple(source_of(name) for name in dict.fromkeys(named) if name), True)
