"""Builds the documentation: `python tests/docs/build_site.py [FOLDER]`, by default results/site.

FOLDER/html/index.html is the site. The sources are copied first, so that nothing made at build time
comes to lie between them. Notebooks are executed side by side, and those that have not changed not
again in a FOLDER where they were (FOLDER/cache; what they compute with is not looked at: remove
FOLDER for that).
"""

import contextlib
import io
import os
import re
import shutil
import subprocess
import sys
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from gallery import NAMES, SLOW, ran
from nbclient.exceptions import CellExecutionError
from notebooks import Executed, is_notebook

from cosim.cli.bar import Bar

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def notebooks() -> list[Path]:
    """The pages of which cells are executed."""
    return sorted(filter(is_notebook, (HERE / "site").rglob("*.md")))


def build(
    folder: Path,
    gallery: Path,
    executed: Executed,
    jobs: int = 1,
    step: Callable[[], object] = lambda: None,
) -> Path:
    """Build into a folder, every warning an error; the start page.

    gallery: what the examples printed and drew, see `gallery.ran`. executed: keeps what the cells
    of the notebooks computed; jobs: how many are executed at a time; step: called after each, and
    after Sphinx. Raises CellExecutionError of a cell, subprocess.CalledProcessError of Sphinx, its
    output on the exception.
    """
    with ThreadPoolExecutor(jobs) as pool:
        for _ in pool.map(executed, notebooks()):
            step()
    source = folder / "source"
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(HERE / "site", source, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(gallery, source / "gallery")
    shutil.copytree(ROOT / ".readme", source / "readme")
    for page in source.rglob("*.md"):
        page.write_text(for_sphinx(page.read_text(encoding="utf-8")), encoding="utf-8")
    html = folder / "html"
    subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", source, html],
        env=environment(folder)
        | {"STICKSLIP_GALLERY": str(gallery), "STICKSLIP_NOTEBOOKS": str(executed.folder)},
        check=True,
        capture_output=True,
        text=True,
    )
    step()
    return html / "index.html"


def for_sphinx(text: str) -> str:
    """A page as Sphinx takes it. On a code host its tree of contents is a comment, which shows
    nothing there, in place of what the build makes there is a line, and its pictures lie where the
    README has them."""
    shown = r"(?:^\*Made from the code [^\n]*\n\n)?<!--\n(```\{(?:toctree|include)\}.*?^```)\n-->"
    text = re.sub(shown, r"\1", text, flags=re.S | re.M)
    return re.sub(r"\]\((\.\./)+\.readme/", "](/readme/", text)


def environment(folder: Path) -> dict[str, str]:
    """That of a reader whose `stickslip` is the one under test, and whose shell stops at errors.

    folder: where the shell finds that it does.
    """
    folder.mkdir(parents=True, exist_ok=True)
    stop = folder / "stop_at_errors.sh"
    stop.write_text("set -e\n", encoding="utf-8")
    return os.environ | {
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),
        "BASH_ENV": str(stop),
        "STICKSLIP_CHECKOUT": str(ROOT),
        # figures as they are drawn into the page, not into a window
        "MPLBACKEND": "module://matplotlib_inline.backend_inline",
        # a debugger would slow down every cell
        "PYDEVD_DISABLE_FILE_VALIDATION": "1",
        **{f"{library}_NUM_THREADS": "1" for library in ("OPENBLAS", "MKL", "OMP")},
    }


def main() -> None:
    """Build, and say where, or what was wrong."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ROOT / "results" / "site").resolve()
    gallery = folder / "gallery"
    work = folder / "work"
    work.mkdir(parents=True, exist_ok=True)
    examples = [name for name in NAMES if name not in SLOW]
    executed = Executed(folder / "cache", environment(folder))
    try:
        with Bar(total=len(examples) + len(notebooks()) + 1, unit="part") as bar:
            for name in examples:
                with contextlib.chdir(work), contextlib.redirect_stderr(io.StringIO()):
                    ran(name, gallery)
                bar.update()
            page = build(folder, gallery, executed, os.cpu_count() or 1, bar.update)
        print(page)
    except CellExecutionError as error:
        sys.exit(str(error))
    except subprocess.CalledProcessError as error:
        sys.exit(f"{error.stdout}{error.stderr}")


if __name__ == "__main__":
    main()
