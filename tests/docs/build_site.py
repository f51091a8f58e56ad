"""Builds the documentation: `python tests/docs/build_site.py [FOLDER]`, by default results/site.

FOLDER/html/index.html is the site. The sources are copied first, so that nothing made at build time
comes to lie between them; notebooks that have not changed are not executed again in a FOLDER where
they were (FOLDER/cache; what they compute with is not looked at: remove FOLDER for that).
"""

import contextlib
import os
import shutil
import subprocess
import sys
from pathlib import Path

from gallery import NAMES, SLOW, ran

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]


def build(folder: Path, gallery: Path) -> Path:
    """Build into a folder, every warning an error; the start page.

    gallery: what the examples printed and drew, see `gallery.ran`. Raises
    subprocess.CalledProcessError, its output on the exception.
    """
    source = folder / "source"
    shutil.rmtree(source, ignore_errors=True)
    shutil.copytree(HERE / "site", source, ignore=shutil.ignore_patterns("__pycache__"))
    shutil.copytree(gallery, source / "gallery")
    shutil.copytree(ROOT / ".readme", source / "readme")
    html = folder / "html"
    subprocess.run(
        [sys.executable, "-m", "sphinx", "-W", "--keep-going", "-q", source, html],
        env=environment(folder, gallery),
        check=True,
        capture_output=True,
        text=True,
    )
    return html / "index.html"


def environment(folder: Path, gallery: Path) -> dict[str, str]:
    """That of a reader whose `stickslip` is the one under test, and whose shell stops at errors."""
    stop = folder / "stop_at_errors.sh"
    stop.write_text("set -e\n", encoding="utf-8")
    return os.environ | {
        "PATH": os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]),
        "BASH_ENV": str(stop),
        "STICKSLIP_CHECKOUT": str(ROOT),
        "STICKSLIP_SITE": str(folder),
        "STICKSLIP_GALLERY": str(gallery),
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
    with contextlib.chdir(work):
        for name in NAMES:
            if name not in SLOW:
                ran(name, gallery)
    try:
        print(build(folder, gallery))
    except subprocess.CalledProcessError as error:
        sys.exit(f"{error.stdout}{error.stderr}")


if __name__ == "__main__":
    main()
