"""All effects of this process: the catalogue's, and behind them those from outside.

Modules of files from outside are called as if they lay below this one, so that whoever looks for
one of them, as a process does that is handed a number of such an effect, reads the effects first.
"""

from ..plugins.load import plugged
from . import FILES, catalogue

_KNOWN = catalogue(FILES)
EFFECTS = (*_KNOWN, *plugged(_KNOWN))
