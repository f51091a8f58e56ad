"""The recipes of the units: repeatable builds, staleness by content, what is inside."""

import ast
import re
import sys
import warnings
import zipfile

import platformdirs
import pytest
from stickslip.generation.platforms import this_platform

from cosim.fmu import libraries, native, python_unit, pythonfmu_library
from cosim.fmu.build import FMI3, PYTHON, FmuBuildError, build_fmu, ensure_fmu, own_folder


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("build"), platforms=[this_platform()])


@pytest.fixture(scope="module")
def built_in_python(tmp_path_factory):
    return build_fmu(tmp_path_factory.mktemp("build"), PYTHON)


def test_the_same_content_gives_the_same_file(built, built_in_python, tmp_path):
    again = build_fmu(tmp_path, platforms=[this_platform()])
    assert again.read_bytes() == built.read_bytes()
    assert build_fmu(tmp_path, PYTHON).read_bytes() == built_in_python.read_bytes()


def test_a_unit_of_today_s_content_is_not_built_again(built):
    before = built.stat().st_mtime_ns
    assert ensure_fmu(built.parent) == built
    assert built.stat().st_mtime_ns == before


@pytest.mark.parametrize("damage", "missing truncated empty flipped another stale alien".split())
def test_a_unit_that_will_not_do_is_built_again(built, tmp_path, damage):
    content = built.read_bytes()
    middle = len(content) // 2
    flipped = content[:middle] + bytes([content[middle] ^ 255]) + content[middle + 1 :]
    spoilt = {"truncated": content[:-1000], "empty": b"", "flipped": flipped, "another": b"PK"}
    target = tmp_path / built.name
    if damage in spoilt:
        target.write_bytes(spoilt[damage])
    elif damage == "stale":
        _rewritten(built, target, guid="of yesterday")
        assert native.built_guid(target) == "of yesterday"
    elif damage == "alien":
        _rewritten(built, target, without="binaries/")
        assert native.built_guid(target) == native.guid() and not libraries.runs_here(target)
    assert ensure_fmu(tmp_path).read_bytes() == content
    assert [file.name for file in tmp_path.iterdir()] == [built.name]


def test_one_library_serves_both_native_units(built, tmp_path):
    own = this_platform()
    other = build_fmu(tmp_path, FMI3, [own])
    held = []
    for unit, folder in ((built, own.fmi2), (other, own.name)):
        with zipfile.ZipFile(unit) as archive:
            held.append(archive.read(f"binaries/{folder}/{native.NAME}{own.suffix}"))
        assert own.name in libraries.platforms_of(unit)
    assert held[0] == held[1]
    assert ensure_fmu(tmp_path, FMI3) == other


def _rewritten(built, target, guid=None, without="nothing"):
    with zipfile.ZipFile(built) as old, zipfile.ZipFile(target, "w") as new:
        for name in old.namelist():
            content = old.read(name)
            if name == "modelDescription.xml":
                content = content.replace(native.guid().encode(), (guid or native.guid()).encode())
            if not name.startswith(without):
                new.writestr(name, content)


def built_hash(fmu):
    with zipfile.ZipFile(fmu) as archive:
        return archive.read("resources/slavemodule.txt").decode().removeprefix("stickslip3dof_")


def test_other_content_makes_another_python_unit(built_in_python, tmp_path):
    files = python_unit.sources() | {"stickslip/__init__.py": b'"""Another."""\n'}
    other = python_unit.build(tmp_path, files)
    assert built_hash(other) != built_hash(built_in_python)


def test_the_fmu_stands_in_build_of_a_checkout_else_in_the_cache(tmp_path, monkeypatch):
    """Nothing is written into a user's folder that happens to have a `build`.

    In the cache a version has a folder of its own: another that runs at the same time would put its
    unit in the place of this one's between description and library.
    """
    monkeypatch.chdir(tmp_path)
    (tmp_path / "build").mkdir()
    assert own_folder() == platformdirs.user_cache_path("stickslip") / native.guid()[:8]
    (tmp_path / "build" / "units.py").touch()
    assert str(own_folder()) == "build"


def test_a_folder_that_cannot_be_made_is_named(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(FmuBuildError, match=r"file/here: cannot be made"):
        build_fmu(tmp_path / "file" / "here")


def _names_imported(node):
    if isinstance(node, ast.Import):
        return [alias.name for alias in node.names]
    return [node.module] if isinstance(node, ast.ImportFrom) and not node.level else []


def test_the_slave_needs_the_standard_library_only(built_in_python):
    """No numpy, no pydantic: whatever the host has, the unit brings what it needs."""
    with zipfile.ZipFile(built_in_python) as archive:
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
    assert len(texts) == len(python_unit.sources()) + 1 and len(own) == 1
    assert imported - own - {"pythonfmu"} <= sys.stdlib_module_names


def test_a_host_s_old_python_is_asked_for_a_newer_one_before_anything_else(monkeypatch):
    """What runs first is understood by any Python 3, and the first that it does is to ask."""
    door = python_unit.sources()[f"{python_unit.MODULE}.py"]
    ast.parse(door, feature_version=(3, 4))
    monkeypatch.setattr("sys.version_info", (3, 9, 18))
    with pytest.raises(ImportError, match=r"^StickSlip3DOF needs Python 3\.10 or newer, this host"):
        exec(door, {})


def test_only_the_python_unit_says_that_it_needs_another_tool(built, built_in_python):
    for unit, needs in ((built, "false"), (built_in_python, "true")):
        with zipfile.ZipFile(unit) as archive:
            text = archive.read("modelDescription.xml").decode()
        assert re.findall(r'needsExecutionTool="(\w+)"', text) == [needs] * text.count("needsExec")
        assert ("For hosts with a Python of 3.10 or newer" in text) is (needs == "true")


def test_an_unknown_library_is_left_alone_and_what_is_lost_is_said():
    step = pythonfmu_library.corrections()[0]
    found, put = (bytes.fromhex(step[key]) for key in ("found", "put"))
    known = b"head" + found + b"tail"
    assert pythonfmu_library.corrected(known) == b"head" + put + b"tail"
    for unknown in (b"head", known * 2):
        with pytest.warns(UserWarning, match="not known: the FMU returns fmi2Discard"):
            assert pythonfmu_library.corrected(unknown) == unknown
    for start, loss in (
        (pythonfmu_library.ELF, "may abort at the end"),
        (pythonfmu_library.ELF, "says nothing of its errors"),
        (pythonfmu_library.DLL, "says nothing of its errors"),
        (pythonfmu_library.ELF, "returns fmi2Fatal, not fmi2Error"),
        (pythonfmu_library.DLL, "returns fmi2Fatal, not fmi2Error"),
    ):
        with pytest.warns(UserWarning) as said:
            pythonfmu_library.corrected(start + known)
        assert any(loss in str(warning.message) for warning in said)


def test_the_libraries_of_the_installed_pythonfmu_are_known():
    import pythonfmu.builder

    folder = pythonfmu.builder.HERE / "resources" / "binaries"
    libraries = [*folder.rglob("*.so"), *folder.rglob("*.dll")]
    assert len(libraries) == 2
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        for library in libraries:
            pythonfmu_library.corrected(library.read_bytes())
