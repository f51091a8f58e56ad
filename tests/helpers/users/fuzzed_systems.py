"""Systems that nobody would write, TOML and SSP, of a small unit in C and files that are none."""

import shutil
import zipfile
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

from fuzzed import EXTREME, NUMBERS, RUBBISH, Wildness, _values, toml
from hypothesis import strategies as st
from lag_unit import lag_unit

from cosim.scenario.validation import known_keys
from cosim.systems.settings import Coupling, Run

#: File of a unit -> units of its input and its output.
FILES = {
    "plain.fmu": ("", ""),
    "heat.fmu": ("J", "J"),
    "force.fmu": ("m", "N"),
    "kilo.fmu": ("kJ", "J"),
}
RUBBISH_FILES = {"empty.fmu": b"", "text.fmu": b"no archive", "none.fmu": None}
NAMES = ["a", "b", "c"]
#: Tenths of what is wild: much is refused at its first fault, and then nothing runs.
MILD = (0, 0, 0, 1, 1, 2)
WILD_NAMES = ["", "a.b", "../x", "ü", "a b", 'q"', "\x07", "a" * 300, "aux", "coupling"]
PORTS = ["u", "y", "taken"]
WILD_PORTS = ["", "part.gain", "mode", "nix", "y[1]", "u ", "U"]
KEYS = ["part.gain", "part.rate", "y", "mode", "u", "taken", "nix", ""]
SPACES = " ".join(
    f'xmlns:{prefix}="http://ssp-standard.org/SSP1/SystemStructure{name}"'
    for prefix, name in {
        **{"ssd": "Description", "ssc": "Common"},
        **{"ssv": "ParameterValues", "ssm": "ParameterMapping"},
    }.items()
)


@cache
def made():
    """A folder with all files."""
    folder = Path(mkdtemp(prefix="fuzzed-units-"))
    for name, units in FILES.items():
        lag_unit(folder / name, *units)
    for name, content in RUBBISH_FILES.items():
        if content is not None:
            (folder / name).write_bytes(content)
    return folder


def _pairs(draw, wild, names):
    """Sources and sinks: each fed by the one before it; or by whomever."""
    pairs = [(names[n - 1], name) for n, name in enumerate(names) if len(names) > 1]
    pairs = [pair for pair in pairs if draw(st.integers(0, 3))]
    while wild():
        pairs.append((draw(st.sampled_from(names + WILD_NAMES[:4])), draw(st.sampled_from(NAMES))))
    return pairs


def _coupling(draw, wild):
    """Some keys of [coupling] and [run]; where nothing is said, a run of a few steps."""
    tables = {}
    for table, model in (("coupling", Coupling), ("run", Run)):
        known = known_keys(model)
        for key in draw(st.lists(st.sampled_from(sorted(known)), max_size=3, unique=True)):
            value = draw(_values(known[key], wild()))
            tables.setdefault(table, {})[key] = draw(RUBBISH) if wild() and wild() else value
    choices = {
        "scheme": ["jacobi", "gauss_seidel", "iterated"],
        "step_control": ["fixed", "doubling", "defect", "energy"],
        "on_divergence": ["stop", "halve", "accept"],
        "extrapolation": ["held", "linear", "quadratic"],
    }
    coupling = tables.setdefault("coupling", {})
    for key, values in choices.items():
        if wild() or draw(st.integers(0, 3)) == 0:
            coupling[key] = draw(st.sampled_from(values))
    if draw(st.integers(0, 4)) == 0:
        ports = st.sampled_from([f"{name}.{port}" for name in NAMES for port in PORTS])
        coupling["power_bonds"] = draw(
            st.lists(st.lists(ports, min_size=1, max_size=3), max_size=2)
        )
    if not wild():
        coupling["macro_step"] = 0.05
        tables.setdefault("run", {}).update(start=0.0, stop=0.2)
    if not wild():
        tables["run"] = {**tables.get("run", {}), "checkpoint_seconds": 0}
    return tables


@st.composite
def systems(draw):
    """Tables of a system's file."""
    wild = Wildness(draw, MILD)
    names = draw(st.lists(st.sampled_from(NAMES), min_size=1, max_size=3, unique=True))
    units, file = {}, draw(st.sampled_from(["plain.fmu", "plain.fmu", "heat.fmu"]))
    for name in names:
        unit = {"file": wild.of([file], [*FILES, *RUBBISH_FILES])}
        values = {}
        for key in draw(st.lists(st.sampled_from(KEYS[: len(KEYS) if wild() else 4]), max_size=2)):
            values[key] = draw(RUBBISH if wild() else NUMBERS)
        if values:
            unit[wild.of(["parameters"], ["inputs"])] = values
        if wild():
            key = draw(st.sampled_from(["substeps", "tolerance", "time_limit", "isolate", "nix"]))
            unit[key] = draw(st.one_of(st.sampled_from([1, 2, 1e-3, *EXTREME]), RUBBISH))
        units[draw(st.sampled_from(WILD_NAMES)) if wild() and wild() else name] = unit
    links = []
    for source, sink in _pairs(draw, wild, names):
        link = {
            "from": f"{source}.{wild.of(['y'], PORTS + WILD_PORTS)}",
            "to": f"{sink}.{wild.of(['u'], PORTS + WILD_PORTS)}",
        }
        if wild():
            key = draw(st.sampled_from(["factor", "offset", "taken", "convert", "nix"]))
            link[key] = draw(st.one_of(st.sampled_from(["taken", True, False]), NUMBERS, RUBBISH))
        links.append(link)
    tables = {"units": units, "connections": links, **_coupling(draw, wild)}
    if wild() and wild():
        tables[draw(st.sampled_from(["units", "connections", "residuals", "name", "x"]))] = draw(
            RUBBISH
        )
    return tables


def _escaped(text):
    for letter, spelled in (("&", "&amp;"), ("<", "&lt;"), ('"', "&quot;")):
        text = str(text).replace(letter, spelled)
    return text


def _element(draw, wild, name, depth=0):
    """A component, now and then a system that holds some."""
    if depth < 2 and draw(st.integers(0, 5)) == 0:
        inner = [_element(draw, wild, each, depth + 1) for each in NAMES[: draw(st.integers(0, 2))]]
        ports = _connectors(draw, wild)
        return (
            f'<ssd:System name="{name}">{ports}<ssd:Elements>{"".join(inner)}</ssd:Elements>'
            f"{_connections(draw, wild, NAMES)}</ssd:System>"
        )
    source = wild.of(sorted(FILES), [*RUBBISH_FILES, "../plain.fmu", "/etc/hostname", ""])
    said = ' type="application/x-nothing"' if wild() and wild() else ""
    if wild() and wild():
        said += f' implementation="{wild.of(["CoSimulation"], ["ModelExchange", "x"])}"'
    return (
        f'<ssd:Component name="{name}" source="{_escaped(source)}"{said}>'
        f"{_connectors(draw, wild)}{_bindings(draw, wild)}</ssd:Component>"
    )


def _connectors(draw, wild):
    kinds = {"u": "input", "y": "output", "part.gain": "parameter"}
    text = ""
    for name, kind in kinds.items():
        if wild() and wild():
            continue
        type_ = wild.of(["Real"], ["Integer", "String", "Binary", "Nix", "Enumeration"])
        unit = f' unit="{wild.of(["J", "m"], ["", "?"])}"' if wild() else ""
        kind = wild.of([kind], ["input", "output", "inout", "x"])
        text += f'<ssd:Connector name="{name}" kind="{kind}"><ssc:{type_}{unit}/></ssd:Connector>'
    return f"<ssd:Connectors>{text}</ssd:Connectors>"


def _bindings(draw, wild):
    if draw(st.booleans()):
        return ""
    values = ""
    for key in draw(st.lists(st.sampled_from(KEYS[: len(KEYS) if wild() else 2]), max_size=2)):
        value = draw(NUMBERS) if not wild() else draw(st.sampled_from([*EXTREME, "x", "", "1,5"]))
        type_ = wild.of(["Real"], ["Integer", "Boolean", "Enumeration", "Nix"])
        values += (
            f'<ssv:Parameter name="{key}"><ssv:{type_} value="{_escaped(value)}"/></ssv:Parameter>'
        )
    prefix = f' prefix="{wild.of(["a"], ["", "."])}"' if wild() else ""
    source = ' source="nix.ssv"' if wild() and wild() else ""
    return (
        f"<ssd:ParameterBindings><ssd:ParameterBinding{prefix}{source}><ssd:ParameterValues>"
        f'<ssv:ParameterSet version="1.0" name="p"><ssv:Parameters>{values}</ssv:Parameters>'
        "</ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>"
    )


def _connections(draw, wild, names):
    text = ""
    for start, end in _pairs(draw, wild, names):
        inner = ""
        if wild():
            factor, offset = draw(NUMBERS), draw(NUMBERS)
            inner = f'<ssc:LinearTransformation factor="{factor}" offset="{offset}"/>'
        ends = {
            "startElement": start,
            "startConnector": wild.of(["y"], WILD_PORTS),
            "endElement": end,
            "endConnector": wild.of(["u"], WILD_PORTS),
        }
        said = " ".join(f'{key}="{_escaped(value)}"' for key, value in ends.items())
        text += f"<ssd:Connection {said}>{inner}</ssd:Connection>"
    return f"<ssd:Connections>{text}</ssd:Connections>"


@st.composite
def packages(draw):
    """(text of SystemStructure.ssd, keys that are set beside it)."""
    wild = Wildness(draw, MILD)
    names = draw(st.lists(st.sampled_from(NAMES), min_size=1, max_size=3, unique=True))
    inner = "".join(_element(draw, wild, name) for name in names)
    times = wild.of([' startTime="0" stopTime="0.2"'], ["", ' stopTime="x"', ' stopTime="-1"'])
    text = (
        f'<?xml version="1.0"?><ssd:SystemStructureDescription {SPACES} version="'
        f'{wild.of(["1.0", "2.0"], ["", "9"])}" name="{_escaped(wild.of(["s"], WILD_NAMES[:6]))}">'
        f'<ssd:System name="top"><ssd:Elements>{inner}</ssd:Elements>'
        f"{_connections(draw, wild, names)}</ssd:System>"
        f"<ssd:DefaultExperiment{times}/></ssd:SystemStructureDescription>"
    )
    if wild() and wild():
        place = draw(st.integers(0, len(text)))
        text = (
            text[:place]
            + draw(st.sampled_from(["", "<", "]]>", "&x;", "\x00"]))
            + text[place + 3 :]
        )
    changes = {
        f"{table}.{key}": value
        for table, keys in _coupling(draw, wild).items()
        for key, value in keys.items()
        if isinstance(value, int | float | str)
    }
    return text, changes


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
