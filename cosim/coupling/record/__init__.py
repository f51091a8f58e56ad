"""What of a run is on disk while it goes: its rows, its messages, checkpoints to go on from."""

from cosim.coupling.record.folder import RunFolder
from cosim.coupling.record.keeper import Keep
from cosim.coupling.record.log import LOG, MessageLog
from cosim.coupling.record.table import GrowingTable

__all__ = ["LOG", "GrowingTable", "Keep", "MessageLog", "RunFolder"]
