"""Units that would do harm, and places that units cannot be unpacked in: one line, nothing else."""

import os
import re
import shutil
import stat
import sys
import tempfile
import zipfile
from pathlib import Path

import pytest
from c_units import made
from stickslip import scratch
from stickslip.scratch import scratch_folder

from cosim.coupling import CoupledSystem, FmuError, FmuParticipant, GaussSeidel, run
from cosim.coupling.fmu import archive


@pytest.fixture
def unit(tmp_path):
    return made("faulty", tmp_path)


def refused(path, message, **settings):
    """A participant says so, in one line, and leaves nothing behind."""
    with pytest.raises(FmuError, match=message) as caught:
        with FmuParticipant(path, **settings) as participant:
            participant.enter_initialisation(0.0, 1.0)
    assert "\n" not in str(caught.value) and str(path) in str(caught.value)


@pytest.mark.parametrize(
    "name", ["../x", "a/../../x", "/etc/x", "C:/x", "c:x", "..\\x", "\\\\host\\x", ".."]
)
def test_a_member_that_points_outside_is_refused(unit, name):
    with zipfile.ZipFile(unit, "a") as file:
        file.writestr(name, "x")
    refused(unit, re.escape(f"its member {name!r} points outside the folder"))


def test_a_member_that_is_a_link_is_refused(unit):
    link = zipfile.ZipInfo("resources/link")
    link.external_attr = (stat.S_IFLNK | 0o777) << 16
    with zipfile.ZipFile(unit, "a") as file:
        file.writestr(link, "/etc/passwd")
    refused(unit, "its member 'resources/link' is a symbolic link")


def test_a_zip_bomb_is_refused(unit, monkeypatch):
    with zipfile.ZipFile(unit, "a", zipfile.ZIP_DEFLATED) as file:
        file.writestr("resources/zeros", bytes(archive.FEW_BYTES + 1))
    refused(unit, r"would be \d+ times as large unpacked \(64 MiB\), allowed is 200 times")
    monkeypatch.setattr(archive, "MOST_BYTES", 2**20)
    refused(unit, "would take 0.0625 GiB unpacked, allowed are 0.000976562 GiB")
    monkeypatch.setattr(archive, "MOST_MEMBERS", 2)
    refused(unit, "holds 3 files, allowed are 2")


def test_a_size_that_is_a_lie_does_not_fill_the_disk(unit, tmp_path):
    """What is unpacked is never more than what was added up."""
    with zipfile.ZipFile(unit, "a", zipfile.ZIP_DEFLATED) as file:
        file.writestr("resources/zeros", bytes(10**6))
    size = (10**6).to_bytes(4, "little")
    content = unit.read_bytes()
    assert content.count(size) == 2
    unit.write_bytes(content.replace(size, (10).to_bytes(4, "little")))
    refused(unit, r"damaged \(.*resources/zeros")


@pytest.mark.parametrize("entities", [
    '<!DOCTYPE d [<!ENTITY a "aaaaaaaaaa"><!ENTITY b "&a;&a;&a;&a;&a;&a;&a;&a;&a;">]>',
    '<!DOCTYPE d [<!ENTITY x SYSTEM "file:///etc/passwd">]>',
    '<!DOCTYPE fmiModelDescription SYSTEM "http://localhost:1/fmi.dtd">',
])  # fmt: skip
@pytest.mark.parametrize("encoding", ["utf-8", "utf-16"])
def test_entities_are_refused_before_they_are_read(tmp_path, entities, encoding):
    path = tmp_path / "unit.fmu"
    text = f'<?xml version="1.0" encoding="{encoding}"?>{entities}<fmiModelDescription/>'
    with zipfile.ZipFile(path, "w") as file:
        file.writestr("modelDescription.xml", text.encode(encoding))
    refused(path, "its modelDescription.xml has a document type")


@pytest.mark.parametrize("changes, message", [
    ({'fmiVersion="2.0"': 'fmiVersion="1.7"'}, "does not make sense: Unsupported FMI version"),
    ({'fmiVersion="2.0"': ""}, "does not make sense"),
    ({'declaredType="Heat"': 'declaredType="Cold"'}, "does not make sense"),
    ({'<Unknown index="4"/>': '<Unknown index="400"/>'}, "does not make sense"),
    ({"CoSimulation": "ModelExchange", 'canHandleVariableCommunicationStepSize="true"': "",
         'canInterpolateInputs="true"': ""}, "is for model exchange only"),
    ({'Identifier="faulty"': 'Identifier="../../faulty"'}, "is no name of a library"),
])  # fmt: skip
def test_a_description_without_sense_is_refused(tmp_path, changes, message):
    refused(made("faulty", tmp_path, **changes), message)


def with_library(unit, path, content, place=None):
    """The unit with another library, or one in another place."""
    with zipfile.ZipFile(unit) as old, zipfile.ZipFile(path, "w") as file:
        for name in old.namelist():
            is_library = name.startswith("binaries/")
            at, said = (place or name, content) if is_library else (name, old.read(name))
            file.writestr(at, said)
    return path


@pytest.mark.parametrize("content", [b"#!/bin/sh\necho none\n", b"", b"\x7fELF" + bytes(60)])
def test_a_library_that_is_none_is_refused_as_the_user_s_file(unit, tmp_path, content, monkeypatch):
    """No name of the unpacked copy, which is gone by then; all is as it was."""
    monkeypatch.chdir(tmp_path)
    path = with_library(unit, tmp_path / "junk.fmu", content)
    refused(path, r"its library binaries/\S+ cannot be loaded: [^/]+; allowed is a shared library")
    assert Path.cwd() == tmp_path


@pytest.mark.skipif(sys.platform != "linux", reason="takes a library of the system")
def test_a_library_without_the_functions_of_the_standard_is_refused(unit, tmp_path):
    import _ctypes

    path = with_library(unit, tmp_path / "other.fmu", Path(_ctypes.__file__).read_bytes())
    refused(path, r"cannot be loaded: undefined symbol: fmi2\w+; allowed is a shared library")


def test_a_unit_for_other_machines_says_for_which(unit, tmp_path):
    path = with_library(unit, tmp_path / "other.fmu", "x", "binaries/amiga/faulty.library")
    refused(path, r"holds no library for this machine, binaries/.*; it is for amiga")


# --- places ---


def test_no_room_is_said_before_and_while_unpacking(unit, tmp_path, monkeypatch, full_disk):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    there = rf"{tmp_path}/stickslip.fmu-\w+"
    with monkeypatch.context() as patch:
        usage = shutil.disk_usage(tmp_path)
        patch.setattr(shutil, "disk_usage", lambda folder: usage._replace(free=10))
        refused(unit, rf"unpacked in {there}: takes 0 MiB, there are 0 MiB; .*TMPDIR")
    with monkeypatch.context() as patch:
        patch.setattr(zipfile.ZipFile, "extract", full_disk)
        refused(unit, rf"unpacked in {there}: No space left on device; .*TMPDIR")
    assert list(tmp_path.iterdir()) == [unit]


@pytest.mark.skipif(sys.platform == "win32", reason="no lock on a folder")
def test_what_a_killed_run_left_is_removed_and_what_a_living_one_has_is_not(tmp_path, monkeypatch):
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    living = scratch_folder("fmu")
    left, others = tmp_path / "stickslip.fmu-left", tmp_path / "fmu-of-another-tool"
    (left / "binaries").mkdir(parents=True)
    others.mkdir()
    scratch._clear.cache_clear()  # as in another process
    with scratch_folder("ssp") as mine:
        assert sorted(tmp_path.iterdir()) == sorted([others, *map(Path, (living.name, mine))])
    living.cleanup()


def folder_of(tmp_path):
    (folder,) = tmp_path.glob("stickslip.fmu-*")
    return folder


def test_a_folder_removed_in_mid_run_harms_nothing(unit, tmp_path, monkeypatch):
    """A unit that needs it fails by itself; its next run unpacks anew."""
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    participant = FmuParticipant(unit, "unit", parameters={"fault": 8, "at": 0.5})
    step = participant.step

    def removing(time, size):
        if time == 0.25:
            shutil.rmtree(folder_of(tmp_path))
        return step(time, size)

    participant.step = removing
    with CoupledSystem([participant], []) as system:
        for _ in range(2):
            result = run(system, GaussSeidel(("unit",)), stop=1.0, macro_step=0.25)
            assert result.status == "failed" and result.time[-1] == 0.5
            assert "too hot; the folder that it was unpacked in has been removed" in result.reason
    assert list(tmp_path.iterdir()) == [unit]


@pytest.mark.parametrize("name", ["a b", "ü", "a#b", "50%25", "(old) [1]", "R&D", "%s%n", "日本"])
@pytest.mark.parametrize("version", ["faulty", "events"])
def test_awkward_names_of_file_and_folder(tmp_path, monkeypatch, name, version):
    folder = tmp_path / name
    folder.mkdir()
    path = made(version, folder).rename(folder / f"{name}.fmu")
    monkeypatch.setattr(tempfile, "tempdir", str(folder))
    with FmuParticipant(path) as participant:
        assert os.listdir(folder) == [f"{name}.fmu"], "unpacked before there is a use for it"
        participant.enter_initialisation(0.0, 1.0)
        participant.exit_initialisation()
        participant.step(0.0, 0.1)
        participant.close()
    assert os.listdir(folder) == [f"{name}.fmu"]
