"""Every example in a docstring (`>>>`) of the product is run, and none is left out."""

import doctest
from importlib import import_module
from pathlib import Path

import pytest


def with_examples(package):
    """Dotted names of the modules whose text holds an example."""
    root = Path(import_module(package).__file__).parent
    for file in sorted(root.rglob("*.py")):
        if ">>> " in file.read_text(encoding="utf-8"):
            parts = [package, *file.relative_to(root).with_suffix("").parts]
            yield ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


MODULES = [name for package in ("stickslip", "thermal", "cosim") for name in with_examples(package)]


@pytest.mark.parametrize("name", MODULES)
def test_examples_do_what_they_say(name, at_home):
    module = import_module(name)
    found = doctest.testmod(module, optionflags=doctest.NORMALIZE_WHITESPACE | doctest.ELLIPSIS)
    assert found.failed == 0
    # doctest counts an example that it skips as attempted, and never looks into strings
    text = Path(module.__file__).read_text(encoding="utf-8")
    assert found.attempted == text.count(">>> ")
    assert "doctest: +SKIP" not in text
