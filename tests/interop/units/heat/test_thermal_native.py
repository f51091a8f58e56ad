"""The native BeltIceThermal: its sources, its resources, and a host without Python."""

import struct
import sys
import urllib.parse
from ctypes import POINTER, byref, c_double, c_int, c_size_t, c_uint, c_void_p

import pytest
from c_library import SANITIZERS, Host, compiled, compiler, host_in, unpacked
from c_unit import ERROR, Unit, references
from heat_instance import H

from cosim.fmu.thermal import native_unit, resources
from cosim.fmu.thermal.variables import NAME, reduced

# --- the native unit's sources and resources ---


@pytest.fixture(scope="module")
def library(native, tmp_path_factory):
    return Unit(native, tmp_path_factory.mktemp("library"), NAME, reduced())


@pytest.fixture
def folder(native, tmp_path):
    """Resources in a folder with a name that has to be escaped."""
    return unpacked(native, tmp_path, "resources").rename(tmp_path / "räum 1 %20#?[x]")


def locations(folder):
    path = urllib.parse.quote(str(folder))
    lower = "".join(c.lower() if i and path[i - 1 : i] == "%" else c for i, c in enumerate(path))
    bare = str(folder).replace("%", "%25")
    return [
        f"file://{path}", f"file:{path}", f"FILE://LocalHost{path}", f"file://{path}/",
        f"file://{lower}", f"file://{bare}",
    ]  # fmt: skip


@pytest.mark.skipif(sys.platform == "win32", reason="other paths")
def test_every_way_to_write_where_the_resources_are_is_read(library, folder):
    for uri in locations(folder):
        with library.instance(resources=uri.encode()) as heat:
            assert heat.handle, (uri, heat.messages)
            heat.begin()


NOWHERE = [
    (None, "is not given"), ("", "does not begin with file:"),
    ("/abs/resources", "does not begin with file:"),
    ("http://host/resources", "does not begin with file:"), ("file:resources", "is not absolute"),
    ("file:", "is not absolute"), ("file://elsewhere/resources", "another machine"),
    ("file:///a%2", "two hexadecimal digits"), ("file:///a%", "two hexadecimal digits"),
    ("file:///a%zz", "two hexadecimal digits"), ("file:///a%00b", "zero byte"),
    ("file:///" + "a" * 5000, "too long"), ("file:///not/there", "cannot be read"),
]  # fmt: skip


@pytest.mark.parametrize(("uri", "reason"), NOWHERE)
def test_what_says_no_place_is_refused_with_a_reason(library, uri, reason):
    heat = library.instance(resources=uri and uri.encode())
    assert not heat.handle
    ((status, category, text),) = heat.messages
    assert (status, category) == (ERROR, "logStatusError") and reason in text, text


def damaged(content):
    """Files that are not what they must be, and what is said of them."""
    yield b"", "no file of this unit"
    yield b"PK" + content, "no file of this unit"
    yield content[:-8], "damaged"
    yield content + b"\0", "damaged"
    yield content[:8] + struct.pack(">I", 0x01020304) + content[12:], "another order"
    yield content[:16] + struct.pack("<i", 10**6) + content[20:], "no room for|has room for"
    for place in (20, 48, 64, 70, len(content) // 2, len(content) - 1):
        broken = bytearray(content)
        broken[place] ^= 1
        yield bytes(broken), "damaged|has room for"


def test_damaged_matrices_are_refused(library, folder):
    file = folder / resources.FILE
    for content, reason in list(damaged(file.read_bytes())):
        file.write_bytes(content)
        heat = library.instance(resources=f"file://{urllib.parse.quote(str(folder))}".encode())
        assert not heat.handle
        ((_, _, text),) = heat.messages
        assert any(each in text for each in reason.split("|")), (reason, text)


# --- the native unit in a host without Python ---


@pytest.fixture
def place(folder):
    return f"file://{urllib.parse.quote(str(folder))}".encode()


def test_calls_of_what_it_does_not_offer_are_refused(library, place):
    heat = library.instance(exchanges=True, resources=place)
    assert not heat.handle and "for co-simulation" in heat.messages[0][2]
    function = library.library.fmi2SetRealInputDerivatives
    function.argtypes = (c_void_p, POINTER(c_uint), c_size_t, POINTER(c_int), POINTER(c_double))
    with library.instance(resources=place) as heat:
        heat.begin()
        arguments = (byref(c_uint(0)), 1, byref(c_int(1)), byref(c_double(1.0)))
        assert function(heat.handle, *arguments) == ERROR
        assert "heat_flow is held over a step" in heat.messages[-1][2]


@pytest.mark.skipif(sys.platform != "linux", reason="the host is written for Linux")
@pytest.mark.skipif(not compiler(), reason="needs a C compiler")
def test_a_host_in_c_finds_no_fault(native, place, tmp_path):
    """Sanitizers over sources and host: two threads of two instances, melting, states."""
    options = [*SANITIZERS, "-std=c99", "-Wall", "-Wextra", "-Werror"]
    sources = sorted(unpacked(native, tmp_path, "sources").glob("*.c"))
    library = tmp_path / "unit.so"
    compiled(*options, "-fPIC", "-shared", *sources, "-o", library, "-lm")
    host = Host(
        [host_in(tmp_path, *SANITIZERS)], library, native_unit.guid(), references(reduced()),
        RESOURCES=place.decode(),
    )  # fmt: skip
    values = {"heat_flow": 20.0, "surface_speed": 0.5, "ambient.temperature_degC": -0.05}
    melted = {*host("melted_mass", 300, H, 2, 2, **values)}
    assert len(melted) == 1 and melted.pop() > 1e-5
