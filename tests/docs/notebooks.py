"""The tutorials as notebooks: each is executed once, by whoever needs it first.

The site shows what they computed. Who needs it may be in two processes: what was executed lies in a
folder that both know.
"""

import fcntl
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory

from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from myst_nb.core.read import is_myst_markdown_notebook, read_myst_markdown_notebook
from nbclient import NotebookClient
from nbformat import NotebookNode

PAGES = Path(__file__).resolve().parent / "site" / "tutorials"
#: Longest that a cell may take, s.
PATIENCE = 600


def is_notebook(page: Path) -> bool:
    """Whether the cells of a page are executed."""
    return is_myst_markdown_notebook(page.read_text(encoding="utf-8"))


def source(page: Path) -> NotebookNode:
    """A page as its cells, none of them executed; what lies between them is Markdown."""
    text = page.read_text(encoding="utf-8")
    return read_myst_markdown_notebook(text, add_source_map=True, path=page)


class Executed:
    """What the cells of pages computed.

    folder: where that is kept, by jupyter-cache.
    environment: what the cells find in theirs.
    """

    def __init__(self, folder: Path, environment: Mapping[str, str]):
        folder.mkdir(parents=True, exist_ok=True)
        self.folder, self.environment = folder, dict(environment)

    def __call__(self, page: Path) -> NotebookNode:
        """The notebook of a page with its outputs; executed now if nobody has done so.

        Raises nbclient.exceptions.CellExecutionError where a cell fails.
        """
        with self._alone(page.stem):
            with self._alone("cache"):
                cache = get_cache(self.folder)
                try:
                    return cache.merge_match_into_notebook(source(page))[1]
                except KeyError:
                    pass
            notebook = self._execute(page)
            with self._alone("cache"):
                made = CacheBundleIn(notebook, str(page))
                cache.cache_notebook_bundle(made, check_validity=False, overwrite=True)
        return notebook

    def _execute(self, page: Path) -> NotebookNode:
        notebook = source(page)
        with TemporaryDirectory() as folder:
            # what a command prints comes in pieces of a pipe, which would be outputs of their own
            client = NotebookClient(
                notebook,
                resources={"metadata": {"path": folder}},
                timeout=PATIENCE,
                coalesce_streams=True,
                # times would be in what notebooks are known by
                record_timing=False,
                # a kernel warns of TCP, by which it is spoken to
                extra_arguments=["--log-level=ERROR"],
            )
            client.execute(env=self.environment)
        return notebook

    @contextmanager
    def _alone(self, name: str) -> Iterator[None]:
        with (self.folder / f"{name}.lock").open("w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            yield
