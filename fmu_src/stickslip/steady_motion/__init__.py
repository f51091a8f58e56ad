"""Which steady motion a run comes to: whether it is stable, and which others exist beside it."""

from .assessment import Assessment as Assessment
from .assessment import assess as assess
from .borders import with_pretension as with_pretension
from .live import Interface as Interface
from .live import RunEnded as RunEnded
from .regimes import regimes as regimes
from .stability import stability as stability
