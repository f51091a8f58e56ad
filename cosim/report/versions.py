"""Versions of the packages that a result depends on."""

from __future__ import annotations

import platform
from functools import cache
from importlib.metadata import PackageNotFoundError, version

PACKAGES = (
    "stickslip",
    "numpy",
    "numba",
    "scipy",
    "scikit-fem",
    "fmpy",
    "pythonfmu",
    "xarray",
    "h5netcdf",
    "matplotlib",
    "pydantic",
)


@cache
def versions() -> dict[str, str]:
    """Package -> version, Python and the platform first."""
    found = {"python": platform.python_version(), "platform": platform.platform()}
    return found | {name: _version(name) for name in PACKAGES}


def _version(name: str) -> str:
    try:
        return version(name)
    except PackageNotFoundError:
        return "not installed"
