"""What of a run is on disk while it goes: its rows, its messages, checkpoints to go on from."""

from cosim.coupling.record.checkpoint import (
    Checkpoint,
    CheckpointError,
    differences,
    load_checkpoint,
    require_same_setup,
    save_checkpoint,
)
from cosim.coupling.record.folder import RunFolder
from cosim.coupling.record.keeper import Keep
from cosim.coupling.record.log import LOG, MessageLog
from cosim.coupling.record.table import GrowingTable, Place, write_columns

__all__ = [
    "LOG",
    "Checkpoint",
    "CheckpointError",
    "GrowingTable",
    "Keep",
    "MessageLog",
    "Place",
    "RunFolder",
    "differences",
    "load_checkpoint",
    "require_same_setup",
    "save_checkpoint",
    "write_columns",
]
