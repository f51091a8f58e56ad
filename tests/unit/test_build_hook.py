"""What the recipe of a wheel imports is there before the product and its dependencies are."""

import subprocess
import sys

BEFORE_INSTALLED = """
import importlib.metadata, sys
for name in ("numpy", "scipy", "fmpy", "matplotlib", "xarray"):
    sys.modules[name] = None

def version(name):
    raise importlib.metadata.PackageNotFoundError(name)

importlib.metadata.version = version
from cosim.fmu import libraries, native, web
from cosim.fmu.thermal import native_unit
assert native.guid() != native_unit.guid()
assert web.sources(web.NAME) and web.sources(web.HEAT)
"""


def test_units_are_made_before_the_product_is_installed():
    asked = [sys.executable, "-c", BEFORE_INSTALLED]
    done = subprocess.run(asked, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
