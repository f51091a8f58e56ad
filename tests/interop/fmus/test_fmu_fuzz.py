"""Whatever a file holds that is given as a unit: it is taken, or refused in one line."""

import re
import tempfile
import zipfile
from pathlib import Path

import pytest
from c_units import HERE, made
from hypothesis import given, settings
from hypothesis import strategies as st

from cosim.coupling import FmuError, FmuParticipant
from cosim.coupling.fmu.archive import unpack

NAMES = ("faulty", "events")
ODD = ("", "-1", "0", "1e999", "nan", "x", "9" * 20, "../a", "true", "ä", "1 2", "-5", "1000000000")
EXAMPLES = settings(max_examples=100)


@pytest.fixture(scope="module")
def units(tmp_path_factory):
    folder = tmp_path_factory.mktemp("units")
    return {name: made(name, folder).read_bytes() for name in NAMES}


def taken_or_refused(content: bytes) -> None:
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "unit.fmu"
        path.write_bytes(content)
        try:
            FmuParticipant(path)
            unpack(path).cleanup()
        except FmuError as error:
            assert "\n" not in str(error) and ": " in str(error)


@EXAMPLES
@given(data=st.data(), name=st.sampled_from(NAMES))
def test_damaged_files(units, data, name):
    content = bytearray(units[name])
    # half of the damage to the directory at the end, where all is told that is in the file
    places = st.integers(0, len(content) - 1) | st.integers(len(content) - 300, len(content) - 1)
    for place in data.draw(st.lists(places, min_size=1, max_size=10)):
        content[place] = data.draw(st.integers(0, 255))
    taken_or_refused(bytes(content[: data.draw(st.integers(0, len(content)) | st.none())]))


@EXAMPLES
@given(data=st.data(), name=st.sampled_from(NAMES))
def test_descriptions_that_make_no_sense(data, name):
    text = (HERE / f"{name}.xml").read_text()
    for _ in range(data.draw(st.integers(1, 3))):
        values = list(re.finditer(r'"([^"]*)"', text))
        value = values[data.draw(st.integers(0, len(values) - 1))]
        text = text[: value.start(1)] + data.draw(st.sampled_from(ODD)) + text[value.end(1) :]
    lines = text.splitlines()
    gone = data.draw(st.integers(0, len(lines)))
    del lines[gone : gone + 1]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "unit.fmu"
        with zipfile.ZipFile(path, "w") as file:
            file.writestr("modelDescription.xml", "\n".join(lines))
        content = path.read_bytes()
    taken_or_refused(content)
