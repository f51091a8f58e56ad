"""Benchmarks by their names.

    python tests/benchmarks                            lists them
    python tests/benchmarks mechanics --json new.json  runs one; its own arguments follow

models/: mechanics and heat alone; coupling/: the master, units, rows on disk; gap/: campaigns with
known answers; commands/: commands as they are used.
"""

import ast
import runpy
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
TESTS = HERE.parent


def benchmarks() -> dict[str, Path]:
    """Name -> script, room by room: what has an `if __name__ == "__main__"`."""
    scripts = [HERE / "compare.py", *sorted(HERE.glob("*/*.py"))]
    return {file.stem: file for file in scripts if "\nif __name__ ==" in file.read_text("utf-8")}


def rooms() -> list[str]:
    """The folders that benchmarks and what tests share are imported from."""
    tops = HERE, TESTS / "helpers"
    folders = (folder for top in tops for folder in (top, *sorted(top.glob("*/"))))
    own = (each for each in folders if not (each / "__init__.py").exists())
    return [str(folder) for folder in own if any(folder.glob("*.py"))]


def listed() -> str:
    """A line for each benchmark, with what it says of itself."""
    about = {
        name: (ast.get_docstring(ast.parse(file.read_text("utf-8"))) or "").partition("\n")[0]
        for name, file in benchmarks().items()
    }
    return "\n".join(f"{name:<22}{line}" for name, line in about.items())


def main() -> None:
    known, (name, *rest) = benchmarks(), sys.argv[1:] or ["--help"]
    if name in ("-h", "--help"):
        print(__doc__, listed(), sep="\n")
    elif name not in known:
        sys.exit(f"no benchmark {name}; there are {', '.join(known)}")
    else:
        sys.path[:0] = [*rooms(), str(TESTS)]
        sys.argv = [str(known[name]), *rest]
        runpy.run_path(str(known[name]), run_name="__main__")


if __name__ == "__main__":
    main()
