"""While a wheel is made: compiles the kernel and the native units, for whoever installs it.

A hook of hatchling (pyproject.toml). An install from source compiles for its own machine, by the
system's compiler where there is one. A release, `STICKSLIP_PLATFORMS=all`, has everything for every
platform and the kernel of the explorer's page, by zig from PyPI. An editable install brings no
libraries; there each is compiled when it is first asked for.
"""

import os
import shutil
import sys
import tempfile
from functools import partial
from pathlib import Path
from typing import Any

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

ROOT = Path(__file__).resolve().parents[1]
SOURCES = [str(ROOT), str(ROOT / "fmu_src")]
IS_RELEASE = os.environ.get("STICKSLIP_PLATFORMS") == "all"


class NativeUnits(BuildHookInterface):
    """Compiles into a scratch folder, and has it taken into the wheel."""

    PLUGIN_NAME = "custom"
    scratch: Path | None = None

    def dependencies(self) -> list[str]:
        """What making a wheel needs, beside what pyproject.toml names."""
        sys.path[:0] = SOURCES
        from stickslip.generation.compiler import system_compiler

        return ["ziglang>=0.17"] if IS_RELEASE or not system_compiler() else []

    def initialize(self, version: str, build_data: dict[str, Any]) -> None:
        """Before the wheel is filled."""
        if self.target_name != "wheel" or version == "editable":
            return
        sys.path[:0] = SOURCES
        from stickslip import compiled, machine_code
        from stickslip.generation.platforms import BROWSER, PLATFORMS, this_machine
        from stickslip.generation.source import kernel_source
        from stickslip.reference import scheme_code

        from cosim.fmu import libraries, native, web
        from cosim.fmu.thermal import native_unit

        self.scratch = Path(tempfile.mkdtemp(prefix="stickslip-prebuilt-"))
        units, kernels = self.scratch / "units", self.scratch / "kernels"
        platforms = PLATFORMS if IS_RELEASE else (this_machine(),)
        for unit in (native, native_unit):
            libraries.prebuild(units, unit.NAME, unit.guid(), unit.sources, platforms)
        if IS_RELEASE:
            for name in (web.NAME, web.HEAT):
                made = partial(web.sources, name)
                libraries.prebuild(units, name, web.guid(name), made, [BROWSER])
        for code in (compiled.code(kernel_source()), scheme_code()):
            code.prebuild(kernels, platforms)
        build_data["force_include"] |= {
            str(units): f"cosim/fmu/{libraries.PREBUILT}",
            str(kernels): f"stickslip/{machine_code.PREBUILT}",
        }

    def finalize(self, version: str, build_data: dict[str, Any], artifact_path: str) -> None:
        """After it."""
        if self.scratch is not None:
            shutil.rmtree(self.scratch, ignore_errors=True)
