"""CoFmuPy: ``python in_cofmupy.py FILE SPEED STEP COUNT`` prints x after every step."""

import json
import sys
import tempfile
from pathlib import Path

from cofmupy import Coordinator

file, speed, step, count = sys.argv[1], *map(float, sys.argv[2:])
block = {"id": "block", "path": file, "initialization": {"surface_speed": speed}}
with tempfile.TemporaryDirectory() as folder:
    system = Path(folder) / "system.json"
    system.write_text(json.dumps({"fmus": [block], "connections": []}))
    coordinator = Coordinator()
    coordinator.start(str(system))
for _ in range(int(count)):
    coordinator.do_step(step)
    print("x", *coordinator.get_variable(("block", "x")))
