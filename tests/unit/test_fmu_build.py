"""The recipe of the FMU: repeatable builds, staleness by content, what is inside."""

import ast
import re
import warnings
import zipfile

import platformdirs
import pytest

from cosim.fmu import pythonfmu_library
from cosim.fmu import stickslip3dof as recipe
from cosim.fmu.build import FmuBuildError, build_fmu, ensure_fmu, own_folder
from cosim.fmu.sources import sources

STANDARD_LIBRARY_USED = {
    "__future__",
    "collections",
    "random",
    "functools",
    "json",
    "math",
    "sys",
    "typing",
}


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("build"))


def test_the_same_content_gives_the_same_file(built, tmp_path):
    assert build_fmu(tmp_path).read_bytes() == built.read_bytes()


def test_an_fmu_of_today_s_content_is_not_built_again(built):
    before = built.stat().st_mtime_ns
    assert ensure_fmu(built.parent) == built
    assert built.stat().st_mtime_ns == before


@pytest.mark.parametrize("damage", ["missing", "truncated", "empty", "flipped", "another"])
def test_an_fmu_that_will_not_do_is_built_again(built, tmp_path, damage):
    content = built.read_bytes()
    middle = len(content) // 2
    flipped = content[:middle] + bytes([content[middle] ^ 255]) + content[middle + 1 :]
    spoilt = {"truncated": content[:-1000], "empty": b"", "flipped": flipped, "another": b"PK"}
    target = tmp_path / built.name
    if damage in spoilt:
        target.write_bytes(spoilt[damage])
    assert ensure_fmu(tmp_path).read_bytes() == content
    assert [file.name for file in tmp_path.iterdir()] == [built.name]


def test_an_fmu_of_other_content_is_stale(built, tmp_path):
    other = recipe.build(tmp_path, sources() | {"stickslip/__init__.py": b'"""Another."""\n'})
    assert recipe.built_hash(other) not in (None, recipe.content_hash())
    assert ensure_fmu(tmp_path).read_bytes() == built.read_bytes()


def test_the_fmu_stands_in_build_of_a_checkout_else_in_the_cache(tmp_path, monkeypatch):
    """Nothing is written into a user's folder that happens to have a `build`."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "build").mkdir()
    assert own_folder() == platformdirs.user_cache_path("stickslip")
    (tmp_path / "build" / "stickslip3dof.py").touch()
    assert str(own_folder()) == "build"


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FmuBuildError, match=r"file/here: cannot be made"):
        build_fmu(tmp_path / "file" / "here")


def _names_imported(node):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    return [node.module] if isinstance(node, ast.ImportFrom) and not node.level else []


def test_the_slave_needs_the_standard_library_only(built):
    """No numpy, no pydantic: whatever the host has, the FMU brings what it needs."""
    with zipfile.ZipFile(built) as archive:
        texts = [
            archive.read(name).decode()
            for name in archive.namelist()
            if re.match(r"resources/stickslip\w*[./].*\.?py$", name)
        ]
    imported = {
        name.partition(".")[0]
        for text in texts
        for node in ast.walk(ast.parse(text))
        for name in _names_imported(node)
    }
    own = {name for name in imported if re.fullmatch(r"stickslip_[0-9a-f]{12}", name)}
    assert len(texts) == len(sources()) + 1 and len(own) == 1
    assert imported - own - {"pythonfmu"} <= STANDARD_LIBRARY_USED


def test_the_module_names_carry_the_content_s_hash(built):
    content = recipe.built_hash(built)
    with zipfile.ZipFile(built) as archive:
        assert f"resources/stickslip3dof_{content}.py" in archive.namelist()
        assert f"resources/stickslip_{content}/packing.py" in archive.namelist()


def test_an_unknown_library_is_left_alone_and_what_is_lost_is_said():
    step = pythonfmu_library.REFUSED_STEP
    known = b"head" + step.found + b"tail"
    assert pythonfmu_library.corrected(known) == b"head" + step.put + b"tail"
    for unknown in (b"head", known * 2):
        with pytest.warns(UserWarning, match="not known: the FMU returns fmi2Discard"):
            assert pythonfmu_library.corrected(unknown) == unknown
    with pytest.warns(UserWarning, match="may abort at the end"):
        pythonfmu_library.corrected(b"\x7fELF" + known)


def test_the_libraries_of_the_installed_pythonfmu_are_known():
    import pythonfmu.builder

    folder = pythonfmu.builder.HERE / "resources" / "binaries"
    libraries = [*folder.rglob("*.so"), *folder.rglob("*.dll")]
    assert len(libraries) == 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for library in libraries:
            pythonfmu_library.corrected(library.read_bytes())
