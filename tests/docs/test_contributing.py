"""The guide for contributors: the effect that it adds, and the files that it and C name."""

import os
import re
import shutil
from importlib import resources
from pathlib import Path

from command_line import python

ROOT = Path(__file__).resolve().parents[2]
GUIDE = (ROOT / ".github" / "CONTRIBUTING.md").read_text(encoding="utf-8")
ASKED = """
from stickslip import EFFECTS, Parameters, simulate
rig = {"rig": {"spring_natural_length": 0.17}, "initial": {"vx": 0.15}}
plain, on = (
    simulate(Parameters(**rig, logarithmic_weakening={"fall": fall}), 0.8, 0.1, interpreted=True)
    for fall in (0.0, 0.1)
)
ledger = max(abs(run["energy_residual"]).max() for run in (plain, on))
print(EFFECTS[-1].id, abs(plain["x"] - on["x"]).max() > 1e-4, ledger < 1e-9)
"""


def test_the_guide_s_effect_is_one(tmp_path):
    code = re.search(r"```python\n(.*?)```", GUIDE, re.DOTALL)[1]
    name = re.search(r'id="(\w+)"', code)[1]
    package = Path(shutil.copytree(resources.files("stickslip"), tmp_path / "stickslip"))
    (package / "effects" / "friction" / f"{name}.py").write_text(code, encoding="utf-8")
    listed = package / "effects" / "__init__.py"
    text = listed.read_text(encoding="utf-8")
    longer = re.sub(
        r"(FILES = \(.*?)\n\)", rf'\1\n    "friction.{name}",\n)', text, flags=re.DOTALL
    )
    listed.write_text(longer, encoding="utf-8")
    said = python(ASKED, env=os.environ | {"PYTHONPATH": str(tmp_path)})
    assert said.split() == [name, "True", "True"]


def test_files_that_are_named_are_there():
    """A path in the guide; of the Python behind the C, in C."""
    named = re.findall(r"`((?:cosim|fmu_src|tests|stickslip)/[\w/]+\.\w+)`", GUIDE)
    for source in (ROOT / "fmu_src" / "native").rglob("*.[ch]"):
        named += re.findall(r"[\w/]+\.py\b", source.read_text(encoding="utf-8"))
    gone = {
        name for name in named if not any((ROOT / at / name).is_file() for at in ("", "fmu_src"))
    }
    assert len(named) > 10 and not gone
