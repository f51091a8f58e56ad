"""What the recipe of a wheel imports is there before the product and its dependencies are."""

from command_line import python

#: Where a wheel is made there are pydantic and a compiler.
MISSING = (
    "numpy", "scipy", "fmpy", "matplotlib", "xarray", "skfem", "meshio", "jinja2", "pythonfmu",
    "thermal",
)  # fmt: skip
MAKES = """
import importlib.metadata, sys
sys.modules.update(dict.fromkeys(sys.argv[1:]))

def version(name):
    raise importlib.metadata.PackageNotFoundError(name)

if sys.argv[1:]:
    importlib.metadata.version = version
from cosim.fmu import libraries, native, web
from cosim.fmu.thermal import native_unit
print(native.guid(), native_unit.guid(), len(native_unit.sources()))
print(len(web.sources(web.NAME)), len(web.sources(web.HEAT)))
"""


def test_units_are_made_before_the_product_is_installed(tmp_path):
    """And they are the same."""
    told = [python(MAKES, *blocked, cwd=tmp_path).split() for blocked in (MISSING, ())]
    assert told[0] == told[1] and len({*told[0]}) > 2 and all(int(n) for n in told[0][2:])
