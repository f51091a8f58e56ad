"""What travels inside the FMU: the slave, the kernel as one text, and how parameters enter it.

Pure Python of the standard library. The kernel comes as `stickslip.generation.source` makes it, so
the effects' declarations stay behind, and pydantic with them.
"""

from __future__ import annotations

import re
from importlib import resources
from pathlib import Path

from stickslip.generation.source import kernel_source
from stickslip.kernel.layout import constants

#: Beside the kernel's text: files of the package `stickslip` as they are, but for where the names
#: of the kernel come from.
AS_THEY_ARE = ("packing.py", "status.py", "tableau.py")
PACKAGE_DOC = '"""The mechanics of StickSlip3DOF, as it travels inside the FMU."""\n'
_KERNEL = re.compile(r"(?m)^from (\.|stickslip\.)kernel\.[\w.]+ import")


def sources() -> dict[str, bytes]:
    """Path inside the FMU's resources -> content, before anything is renamed."""
    texts = {
        "slave.py": slave_file().read_text(encoding="utf-8"),
        "stickslip/__init__.py": PACKAGE_DOC,
        "stickslip/kernel.py": kernel_source(),
        "stickslip/derived.py": _derived(),
    }
    for name in AS_THEY_ARE:
        texts[f"stickslip/{name}"] = (resources.files("stickslip") / name).read_text("utf-8")
    return {
        name: _KERNEL.sub(r"from \1kernel import", text).encode() for name, text in texts.items()
    }


def slave_file() -> Path:
    """The slave: in fmu_src in a checkout, beside this file in an installed package."""
    here = Path(__file__).resolve()
    checkout = here.parents[2] / "fmu_src" / "slave.py"
    return checkout if checkout.is_file() else here.with_name("slave.py")


def _derived() -> str:
    from stickslip.derived import TEXT

    used = [name for name in constants() if re.search(rf"\b{name}\b", TEXT)]
    head = '"""The effects\' numbers in ``p``, made from their declarations."""\n\n'
    return f"{head}from .kernel import {', '.join(used)}\n{TEXT}"
