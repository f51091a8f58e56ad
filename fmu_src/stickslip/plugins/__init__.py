"""Effects from outside: one Python file with a declared law each, added behind the catalogue.

A process has one set of them, from its start to its end, since the kernel's arrays are laid out for
it: files by `use`, which children inherit, and what is installed as an entry point of `GROUP`. A
file is executed: whoever names one runs its author's code. `load` makes an effect of a file,
`check` holds its terms to what can become C, `template.py` is what `stickslip effect new` writes.
"""

from .active_plugins import GROUP, VARIABLE, files, use
from .errors import PluginError

__all__ = ["GROUP", "VARIABLE", "PluginError", "files", "use"]
