"""`stickslip docs`: a copy that is there is opened, one that is not is built, or why not."""

from pathlib import Path

import pytest
from command_line import refusal

from cosim.cli import main
from cosim.cli.authoring import docs

#: In place of the site's own, which takes a minute.
BUILDER = """
import sys, pathlib
html = pathlib.Path(sys.argv[1]) / "html"
html.mkdir(parents=True)
(html / "index.html").write_text("built")
"""


@pytest.fixture
def nowhere(tmp_path, monkeypatch):
    """A package without documentation, and a working directory that is no checkout."""
    monkeypatch.setattr(docs.cosim, "__file__", str(tmp_path / "site-packages/cosim/__init__.py"))
    monkeypatch.setattr(docs, "files", lambda name: tmp_path / "site-packages" / name)
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    return tmp_path


def checkout():
    builder = Path(docs.BUILDER)
    builder.parent.mkdir(parents=True)
    builder.write_text(BUILDER, encoding="utf-8")


def test_an_installed_copy_is_opened(nowhere, capsys, monkeypatch):
    page = nowhere / "site-packages" / "cosim" / docs.INSTALLED
    page.parent.mkdir(parents=True)
    page.write_text("installed", encoding="utf-8")
    opened = []
    monkeypatch.setattr(docs.webbrowser, "open", lambda address: not opened.append(address))
    assert main(["docs"]) == 0
    assert opened == [page.as_uri()] and capsys.readouterr().out == f"{page}\n"


def test_a_checkout_builds_it_once(nowhere, capsys):
    checkout()
    for told in ("note: building the documentation", ""):
        assert main(["docs", "--no-open"]) == 0
        out, err = capsys.readouterr()
        page = Path(out.strip())
        assert page.read_text(encoding="utf-8") == "built" and err.startswith(told)
    assert err == ""


def test_where_it_can_be_neither_found_nor_built_one_line_says_what_to_do(nowhere, capsys):
    line = refusal(capsys, "docs")
    assert "is neither installed, as" in line and "where tests/docs is" in line


def test_what_building_lacks_is_named_with_the_remedy(nowhere, capsys, monkeypatch):
    checkout()
    monkeypatch.setattr(docs, "find_spec", lambda name: None if name == "furo" else name)
    line = refusal(capsys, "docs")
    assert "needs furo: pip install" in line and '[docs]"' in line


def test_a_build_that_fails_is_status_1(nowhere, capsys):
    checkout()
    Path(docs.BUILDER).write_text("raise SystemExit('no theme')", encoding="utf-8")
    assert main(["docs"]) == 1
    assert "was not built" in capsys.readouterr().err
