"""`stickslip explore`: what it writes, opens and refuses."""

import webbrowser

import pytest
from command_line import refusal
from stickslip.generation import compiler

from cosim.cli import main
from cosim.explore.explorer import GENERATOR
from cosim.fmu import libraries, web

#: Begins as every WebAssembly does; whether it runs is asked of a browser.
MODULE = b"\0asm\x01\0\0\0"


@pytest.fixture(autouse=True)
def kernel(tmp_path, monkeypatch):
    """A place of one's own, and a kernel that nobody has to compile."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(web, "module", lambda *_: MODULE)


@pytest.fixture
def opened(monkeypatch):
    addresses = []
    monkeypatch.setattr(webbrowser, "open", lambda address: addresses.append(address) or True)
    return addresses


def test_it_writes_a_page_and_opens_it(tmp_path, capsys, opened):
    assert main(["explore", "slab"]) == 0
    file = tmp_path / "results" / "explorer-slab.html"
    assert capsys.readouterr().out.strip() == "results/explorer-slab.html"
    assert opened == [file.as_uri()]
    assert GENERATOR in file.read_text(encoding="utf-8")


def test_without_a_browser_it_says_so(capsys, monkeypatch):
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    assert main(["explore", "-o", "page.html"]) == 0
    assert capsys.readouterr().out == "page.html\nno browser to be found: open it yourself\n"


def test_it_takes_the_place_of_its_own_pages_only(tmp_path, capsys, opened):
    assert main(["explore", "-o", "page.html", "--no-open"]) == 0
    assert main(["explore", "study", "-o", "page.html", "--no-open"]) == 0
    assert opened == []
    (tmp_path / "thesis.html").write_text("<p>mine</p>", encoding="utf-8")
    line = refusal(capsys, "explore", "-o", "thesis.html", "--no-open")
    assert line.startswith("thesis.html: was not made by stickslip explore, allowed is")
    assert (tmp_path / "thesis.html").read_text(encoding="utf-8") == "<p>mine</p>"
    assert main(["explore", "-o", "thesis.html", "--no-open", "--force"]) == 0


@pytest.fixture
def nothing_compiles(tmp_path, monkeypatch):
    """What the package brings along is in this folder, and there is no compiler."""
    monkeypatch.undo()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(libraries, "__file__", str(tmp_path / "libraries.py"))
    monkeypatch.setattr(libraries, "possible", lambda platforms: [])
    libraries.libraries.cache_clear()
    yield
    libraries.libraries.cache_clear()


def test_without_a_kernel_it_says_what_to_do(nothing_compiles, tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(web, "has_zig", lambda: False)
    said = refusal(capsys, "explore", "-o", "page.html", "--no-open")
    assert said.startswith("no kernel for the browser: ")
    assert "`pip install ziglang`" in said
    assert not (tmp_path / "page.html").exists()


@pytest.mark.skipif(not compiler.has_zig(), reason="needs zig")
def test_a_wheel_brings_the_kernel(request, tmp_path):
    """And what it brings is taken where there is no compiler."""
    folder = tmp_path / libraries.PREBUILT
    made = libraries.prebuild(folder, web.NAME, web.guid(), web.sources, [libraries.BROWSER])
    (file,) = made.iterdir()
    assert file.read_bytes().startswith(MODULE)
    request.getfixturevalue("nothing_compiles")
    assert web.module() == file.read_bytes()
