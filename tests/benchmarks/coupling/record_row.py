"""Cost of a row on disk: of the table alone, and with its values taken from the ports.

    python tests/benchmarks record_row

Prints microseconds a row of this thread on a processor, its calls to the system included: the
median and the best of batches.
"""

from __future__ import annotations

import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median

from cosim.coupling import CoupledSystem, outputs, port_table
from cosim.coupling.exchange import Exchange
from cosim.coupling.record import GrowingTable
from cosim.coupling.result import Recording


class Outputs:
    """So many constant outputs."""

    def __init__(self, count: int):
        self.name = "outputs"
        self.ports = port_table(outputs(**{f"y{n}": "1" for n in range(count)}))

    def read(self) -> dict[str, float]:
        return {name: 0.1 * n for n, name in enumerate(self.ports)}


def batches(call: Callable[[int], object], size: int, count: int = 200) -> list[float]:
    """Microseconds a call on a processor, of each batch."""
    found = []
    for _ in range(count):
        began = time.thread_time()
        for n in range(size):
            call(n)
        found.append((time.thread_time() - began) / size * 1e6)
    return found


def main() -> None:
    """Print the table."""
    print("columns  rows                     median us  best us")
    with tempfile.TemporaryDirectory() as folder:
        for columns, size in ((10, 1000), (100, 500), (1000, 50)):
            table = GrowingTable(columns + 1, Path(folder) / "t.npy")
            row = [0.1 * n for n in range(columns + 1)]
            system = CoupledSystem([Outputs(columns)], [])  # type: ignore[list-item]
            exchange = Exchange(system)
            exchange.outputs["outputs"] = Outputs(columns).read()
            recording = Recording(system)
            cases = {
                "table, all kept": lambda n, t=table, r=row: t.append(r),
                "table, each 5th kept": lambda n, t=table, r=row: t.append(r, n % 5 == 0),
                "taken from the ports": lambda n, r=recording, e=exchange: r.add(0.1 * n, e),
            }
            for what, call in cases.items():
                found = batches(call, size)
                print(f"{columns:7d}  {what:24s} {median(found):9.2f} {min(found):8.2f}")


if __name__ == "__main__":
    main()
