"""Systems that nobody would write: a sound one, TOML or SSP, and what becomes of it."""

import copy
import re
import shutil
import zipfile
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

from fuzzed import EXTREME, NUMBERS, RUBBISH, Wildness, _values, toml
from hypothesis import strategies as st
from lag_unit import lag_unit

from cosim.scenario.validation import known_keys
from cosim.systems.specification import Coupling, Run

#: File of a unit -> units of its input and its output.
FILES = {"plain.fmu": ("", ""), "heat.fmu": ("J", "J"), "force.fmu": ("m", "N")}
#: What stands in the place of a name, a file or a number.
WILD = [
    *("", "a", "b", "a.b", "a.y", "b.u", "a.mode", "part.gain", "u", "y[1]", "../x", "ü", 'q"'),
    *("a" * 300, "\x07", "text.fmu", "none.fmu", "heat.fmu", "force.fmu", "/etc/hostname"),
]
SYSTEM = {
    "units": {
        "a": {"file": "plain.fmu", "parameters": {"part.gain": 2.0, "y": 1.0}, "substeps": 1},
        "b": {"file": "plain.fmu", "inputs": {"u": 0.5}},
    },
    "connections": [
        {"from": "a.y", "to": "b.u", "factor": 2.0, "offset": 0.0, "convert": True},
        {"from": "b.y", "to": "a.u"},
    ],
}
SPACES = " ".join(
    f'xmlns:{prefix}="http://ssp-standard.org/SSP1/SystemStructure{name}"'
    for prefix, name in {"ssd": "Description", "ssc": "Common", "ssv": "ParameterValues"}.items()
)
PORTS = (
    '<ssd:Connectors><ssd:Connector name="u" kind="input"><ssc:Real/></ssd:Connector>'
    '<ssd:Connector name="y" kind="output"><ssc:Real unit="J"/></ssd:Connector></ssd:Connectors>'
)
VALUES = (
    '<ssd:ParameterBindings><ssd:ParameterBinding prefix=""><ssd:ParameterValues>'
    '<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters><ssv:Parameter name="part.gain">'
    '<ssv:Real value="2.0"/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet>'
    "</ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"
)
COMPONENT = '<ssd:Component name="{}" source="plain.fmu">{}{}</ssd:Component>'.format
LINK = (
    '<ssd:Connection startElement="{}" startConnector="y" endElement="{}" endConnector="u">'
    '<ssc:LinearTransformation factor="1.0" offset="0.0"/></ssd:Connection>'
).format
#: One unit in a system of its own, one beside it.
STRUCTURE = (
    f'<?xml version="1.0"?><ssd:SystemStructureDescription {SPACES} version="1.0" name="s">'
    f'<ssd:System name="top"><ssd:Elements><ssd:System name="inner">{PORTS}<ssd:Elements>'
    f"{COMPONENT('a', PORTS, VALUES)}</ssd:Elements><ssd:Connections>"
    '<ssd:Connection startElement="a" startConnector="y" endConnector="y"/></ssd:Connections>'
    f"</ssd:System>{COMPONENT('b', PORTS, VALUES)}</ssd:Elements><ssd:Connections>"
    f"{LINK('inner', 'b')}</ssd:Connections></ssd:System>"
    '<ssd:DefaultExperiment startTime="0" stopTime="0.2"/></ssd:SystemStructureDescription>'
)


@cache
def made():
    """A folder with all files."""
    folder = Path(mkdtemp(prefix="fuzzed-units-"))
    for name, units in FILES.items():
        lag_unit(folder / name, *units)
    (folder / "text.fmu").write_bytes(b"no archive")
    return folder


def _coupling(draw, wild):
    """Some keys of [coupling] and [run]; where nothing is wild, a run of a few steps."""
    tables = {"coupling": {"macro_step": 0.05}, "run": {"stop": 0.2}}
    for table, model in (("coupling", Coupling), ("run", Run)):
        known = known_keys(model)
        for key in draw(st.lists(st.sampled_from(sorted(known)), max_size=3, unique=True)):
            value = draw(_values(known[key], wild()))
            tables[table][key] = draw(RUBBISH) if wild() and wild() else value
    return tables


def _places(tables):
    """(table or list, key) of everything in it."""
    pairs = tables.items() if isinstance(tables, dict) else enumerate(tables)
    for key, value in pairs:
        yield tables, key
        if isinstance(value, dict | list):
            yield from _places(value)


@st.composite
def systems(draw):
    """Tables of a system's file."""
    wild = Wildness(draw, (0, 1, 2))
    tables = copy.deepcopy(SYSTEM) | _coupling(draw, wild)
    for _ in range(draw(st.integers(0, 2))):
        places = list(_places(tables))
        table, key = places[draw(st.integers(0, len(places) - 1))]
        value = table.pop(key)
        other = draw(st.sampled_from([value, *WILD]) | NUMBERS | RUBBISH)
        if isinstance(table, dict) and draw(st.booleans()):
            table[draw(st.sampled_from([key, *WILD]))] = other
        elif isinstance(table, list):
            table.append(other)
    return tables


@st.composite
def packages(draw):
    """(text of SystemStructure.ssd, keys that are set beside it)."""
    text = STRUCTURE
    for _ in range(draw(st.integers(0, 2))):
        values = list(re.finditer(r'"([^"]*)"', text))
        value = values[draw(st.integers(0, len(values) - 1))]
        names = [each[1] for each in values]
        other = draw(st.sampled_from([*names, *map(str, EXTREME), "String", "inout", "&x;", "<"]))
        text = text[: value.start(1)] + other + text[value.end(1) :]
    elements = list(re.finditer(r"<[^<>]*/>|<ssc:\w+", text))
    if draw(st.integers(0, 3)) == 0:
        gone = elements[draw(st.integers(0, len(elements) - 1))]
        instead = draw(st.sampled_from(["", "<ssc:Nix/>", "]]>", "\x00"]))
        text = text[: gone.start()] + instead + text[gone.end() :]
    tables = _coupling(draw, Wildness(draw, (0, 1, 2)))
    changes = {f"{table}.{key}": value for table in tables for key, value in tables[table].items()}
    return text, {key: v for key, v in changes.items() if isinstance(v, int | float | str)}


def write_system(folder, tables):
    """The system's file beside its units, or None for what TOML cannot hold."""
    text = toml(tables)
    if text is None:
        return None
    for file in made().iterdir():
        shutil.copy(file, folder / file.name)
    (folder / "system.toml").write_text(text, encoding="utf-8", errors="replace")
    return folder / "system.toml"


def write_package(folder, text):
    """The archive with its units."""
    path = folder / "system.ssp"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("SystemStructure.ssd", text.encode("utf-8", errors="replace"))
        for file in made().iterdir():
            archive.write(file, file.name)
    return path


def settings_of(changes):
    """`--set` for each change, as a user would write it."""
    words = []
    for key, value in changes.items():
        spelled = str(value).lower() if isinstance(value, bool) else str(value)
        words += ["--set", f"{key}={spelled}"]
    return words
