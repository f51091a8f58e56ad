"""Contact and ice made ready for a run, by another process where that takes long."""

from __future__ import annotations

from pathlib import Path

from cosim.processes import apart
from thermal import ThermalParameters
from thermal.ice.block import StandingBlock, standing_block
from thermal.work import seconds_to_prepare

#: What takes longer (s) is worth a process of its own, which takes two or three to start; so is a
#: mesh whose file is larger (bytes): it holds some ten thousand elements.
WORTH_A_PROCESS, LARGE_FILE = 10.0, 1_000_000


def prepared_block(parameters: ThermalParameters) -> StandingBlock:
    """Contact and ice, as `standing_block`; a fine mesh, or one from a file, by another process.

    Of such a mesh a single call of LAPACK takes minutes, and Ctrl-C would wait for its end.
    """
    mesh = Path(parameters.ice.mesh) if parameters.ice.mesh else None
    if mesh is None:
        long = seconds_to_prepare(parameters) > WORTH_A_PROCESS
    else:
        long = mesh.is_file() and mesh.stat().st_size > LARGE_FILE
    return apart(standing_block, parameters) if long else standing_block(parameters)
