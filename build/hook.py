"""While a wheel is made: compiles the native units, so that whoever installs it needs no compiler.

A hook of hatchling (pyproject.toml). zig, from PyPI, compiles for every platform. An editable
install brings no libraries; there a unit is compiled when it is first asked for.
"""

import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ROOT = Path(__file__).resolve().parents[1]


class NativeUnits(BuildHookInterface):
    """Compiles into a scratch folder, and has it taken into the wheel."""

    PLUGIN_NAME = "custom"
    scratch: Path | None = None

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Before the wheel is filled."""
        if self.target_name != "wheel" or version == "editable":
            return
        sys.path[:0] = [str(ROOT), str(ROOT / "fmu_src")]
        from cosim.fmu import libraries, native, web
        from cosim.fmu.platforms import BROWSER
        from cosim.fmu.thermal import native_unit

        self.scratch = Path(tempfile.mkdtemp(prefix="stickslip-prebuilt-"))
        for unit in (native, native_unit):
            libraries.prebuild(self.scratch, unit.NAME, unit.guid(), unit.sources)
        libraries.prebuild(self.scratch, web.NAME, web.guid(), web.sources, [BROWSER])
        build_data["force_include"][str(self.scratch)] = f"cosim/fmu/{libraries.PREBUILT}"

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """After it."""
        if self.scratch is not None:
            shutil.rmtree(self.scratch, ignore_errors=True)
