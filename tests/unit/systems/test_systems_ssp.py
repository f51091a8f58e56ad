"""Systems in SSP files: nested, parameterised, with units; and what is refused in which words."""

import zipfile

import numpy as np
import pytest
from command_line import refusal
from lag_unit import lag_unit

from cosim.coupling import CouplingError, FmuError
from cosim.systems import SystemFault, read_system, run_system

SPACES = " ".join(
    f'xmlns:{prefix}="http://ssp-standard.org/SSP1/SystemStructure{name}"'
    for prefix, name in {
        **{"ssd": "Description", "ssc": "Common"},
        **{"ssv": "ParameterValues", "ssm": "ParameterMapping"},
    }.items()
)


def connectors(**kinds):
    """name=(kind, unit)."""
    inner = "".join(
        f'<ssd:Connector name="{name}" kind="{kind}"><ssc:Real'
        f"{f' unit={chr(34)}{unit}{chr(34)}' if unit else ''}/></ssd:Connector>"
        for name, (kind, unit) in kinds.items()
    )
    return f"<ssd:Connectors>{inner}</ssd:Connectors>"


def component(name, source, inner="", **attributes):
    said = "".join(f' {key}="{value}"' for key, value in attributes.items())
    return (
        f'<ssd:Component name="{name}" source="resources/{source}"{said}>'
        f"{connectors(u=('input', ''), y=('output', ''), gain=('parameter', ''))}{inner}"
        "</ssd:Component>"
    )


def connection(start, end, inner="", **attributes):
    text = ""
    for side, place in (("start", start), ("end", end)):
        element, _, port = place.rpartition(".")
        text += f' {side}Element="{element}"' if element else ""
        text += f' {side}Connector="{port}"'
    said = "".join(f' {key}="{value}"' for key, value in attributes.items())
    return f"<ssd:Connection{text}{said}>{inner}</ssd:Connection>"


def values(inner, attributes="", mapping=""):
    return (
        f"<ssd:ParameterBindings><ssd:ParameterBinding{attributes}><ssd:ParameterValues>"
        f"{parameter_set(inner)}</ssd:ParameterValues>{mapping}</ssd:ParameterBinding>"
        "</ssd:ParameterBindings>"
    )


def parameter_set(inner):
    return (
        f'<ssv:ParameterSet {SPACES} version="1.0" name="set"><ssv:Parameters>{inner}'
        "</ssv:Parameters></ssv:ParameterSet>"
    )


def real(name, value, unit=""):
    said = f' unit="{unit}"' if unit else ""
    return f'<ssv:Parameter name="{name}"><ssv:Real value="{value}"{said}/></ssv:Parameter>'


INTEGER = '<ssv:Parameter name="gain"><ssv:Integer value="{}"/></ssv:Parameter>'


def system(elements, connections="", before="", name="root"):
    return (
        f'<ssd:System name="{name}">{before}<ssd:Elements>{elements}</ssd:Elements>'
        f"<ssd:Connections>{connections}</ssd:Connections></ssd:System>"
    )


def defined(name, base, after='<ssd:DefaultExperiment stopTime="0.5"/>'):
    """Units of the file: one, and when the experiment ends."""
    unit = f'<ssc:Unit name="{name}"><ssc:BaseUnit {base}/></ssc:Unit>'
    return f"<ssd:Units>{unit}</ssd:Units>{after}"


def structure(
    content, after='<ssd:DefaultExperiment startTime="0" stopTime="0.5"/>', version="1.0"
):
    return (
        f'<ssd:SystemStructureDescription {SPACES} name="made" version="{version}">{content}'
        f"{after}</ssd:SystemStructureDescription>"
    )


@pytest.fixture
def write(tmp_path):
    """Write an SSP of a structure, two units (a.fmu, b.fmu) and further members."""

    def written(ssd, units=(("", ""), ("", "")), **members):
        path = tmp_path / "made.ssp"
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("SystemStructure.ssd", ssd)
            for name, (u_unit, y_unit) in zip("ab", units, strict=True):
                unit = lag_unit(tmp_path / f"{name}.fmu", u_unit, y_unit, gain="gain")
                archive.write(unit, f"resources/{name}.fmu")
            for name, text in members.items():
                archive.writestr(name.replace("__", "/").replace("_dot_", "."), text)
        return path

    return written


def run(path, **changes):
    with read_system(path, {"coupling.macro_step": 0.01, **changes}) as specification:
        done = run_system(specification)
    assert done.result.status == "complete", done.result.reason
    return done


CHAIN = connection("a.y", "b.u")
BOTH = component("a", "a.fmu", values(real("u", 3.0))) + component("b", "b.fmu")


def ramps(done):
    """a.y and b.y of y_a' = 3, and of b summing the end values of a."""
    time = done.result.time
    return 3.0 * time, np.concatenate([[0.0], np.cumsum(0.01 * 3.0 * time[1:])])


PLAIN = component("a", "a.fmu") + component("b", "b.fmu")
IN_A_ROW = structure(system(BOTH, CHAIN))
SAID = {
    "as in version 1": IN_A_ROW,
    "with the types of version 2": structure(system(BOTH, CHAIN), version="2.0")
    .replace("ssc:Real", "ssc:Float64")
    .replace("ssv:Real", "ssv:Float64"),
    "the sink first": structure(system(BOTH, connection("b.u", "a.y"))),
    "a prefix before all names": structure(
        system(PLAIN, CHAIN, values(real("u", 3.0), ' prefix="a."'))
    ),
}


@pytest.mark.parametrize("way", SAID)
def test_two_units_in_a_row(write, way):
    done = run(write(SAID[way]))
    first, second = ramps(done)
    np.testing.assert_allclose(done.result["a.y"], first, rtol=0, atol=1e-13)
    np.testing.assert_allclose(done.result["b.y"], second, rtol=0, atol=1e-13)
    assert done.result.time[-1] == 0.5


def test_a_folder_of_the_same_contents(write, tmp_path):
    path = write(IN_A_ROW)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(tmp_path / "open")
    for place in (tmp_path / "open", tmp_path / "open" / "SystemStructure.ssd"):
        np.testing.assert_array_equal(run(place).result["b.y"], run(path).result["b.y"])


def test_connectors_of_nested_systems_pass_on(write):
    """a within two systems, b in another; a.y goes out of two borders and into one."""
    deep = system(
        component("a", "a.fmu", values(real("u", 3.0))), connection("a.y", "out"),
        connectors(out=("output", "")), "deep",
    )  # fmt: skip
    left = system(deep, connection("deep.out", "out"), connectors(out=("output", "")), "left")
    right = system(
        component("b", "b.fmu"), connection("in", "b.u"), connectors(**{"in": ("input", "")}),
        "right",
    )  # fmt: skip
    done = run(write(structure(system(left + right, connection("left.out", "right.in")))))
    assert set(done.assembly.system.participants) == {"left_deep_a", "right_b"}
    np.testing.assert_allclose(done.result["right_b.y"], ramps(done)[1], rtol=0, atol=1e-13)


def test_transformations_are_made_border_by_border(write):
    """u_b = 2 (3 y_a + 1) + 10 through two borders."""
    linear = '<ssc:LinearTransformation factor="{}" offset="{}"/>'.format
    left = system(
        component("a", "a.fmu", values(real("u", 3.0))), connection("a.y", "out", linear(3, 1)),
        connectors(out=("output", "")), "left",
    )  # fmt: skip
    to_b = connection("left.out", "b.u", linear(2, 10))
    done = run(write(structure(system(left + component("b", "b.fmu"), to_b))))
    result = done.result
    np.testing.assert_allclose(result["b.u"][1:], 6.0 * result["left_a.y"][1:] + 12.0, rtol=1e-13)


def test_units_are_converted_unless_that_is_suppressed(write):
    units = (("", "degC"), ("K", ""))
    converted = run(write(IN_A_ROW, units)).result
    np.testing.assert_allclose(converted["b.u"][1:], converted["a.y"][1:] + 273.15, rtol=1e-14)
    plain = connection("a.y", "b.u", suppressUnitConversion="true")
    result = run(write(structure(system(BOTH, plain)), units)).result
    np.testing.assert_array_equal(result["b.u"][1:], result["a.y"][1:])


def test_units_of_the_file_count_where_the_fmus_have_none(write):
    ssd = structure(system(BOTH, CHAIN), defined("km", 'm="1" factor="1000"'))
    ssd = ssd.replace(
        "</ssd:Units>", '<ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssd:Units>'
    )
    a, b = ssd.split('<ssd:Component name="b"')
    a = a.replace('"y" kind="output"><ssc:Real/>', '"y" kind="output"><ssc:Real unit="km"/>')
    b = b.replace('"u" kind="input"><ssc:Real/>', '"u" kind="input"><ssc:Real unit="m"/>')
    result = run(write(f'{a}<ssd:Component name="b"{b}')).result
    np.testing.assert_allclose(result["b.u"][1:], 1000.0 * result["a.y"][1:], rtol=1e-13)


def test_values_of_outer_bindings_count_more(write):
    """SSP: of the same level the later, of two levels the outer one."""
    inner = component("a", "a.fmu", values(real("u", 1.0) + real("gain", 5.0)))
    outer = values(real("a.u", 3.0))
    done = run(write(structure(system(inner + component("b", "b.fmu"), CHAIN, outer))))
    assert done.result["a.y"][-1] == pytest.approx(15.0 * 0.5, rel=1e-12)


MAPPING = f"""<ssm:ParameterMapping {SPACES} version="1.0">
  <ssm:MappingEntry source="strength" target="a.u"><ssc:LinearTransformation factor="2" offset="1"/>
  </ssm:MappingEntry>
  <ssm:MappingEntry source="strength" target="b.gain"/>
</ssm:ParameterMapping>"""


@pytest.mark.parametrize("inline", [True, False])
def test_a_mapping_gives_one_value_to_several(write, inline):
    """In files of the package as OMSimulator writes them, and inside the structure."""
    if inline:
        mapping = f"<ssd:ParameterMapping>{MAPPING}</ssd:ParameterMapping>"
        bound, members = values(real("strength", 4.0), "", mapping), {}
    else:
        bound = (
            '<ssd:ParameterBindings><ssd:ParameterBinding source="resources/set.ssv">'
            '<ssd:ParameterMapping source="resources/map.ssm"/></ssd:ParameterBinding>'
            "</ssd:ParameterBindings>"
        )
        members = {
            "resources__set_dot_ssv": parameter_set(real("strength", 4.0)),
            "resources__map_dot_ssm": MAPPING,
        }
    result = run(write(structure(system(PLAIN, CHAIN, bound)), **members)).result
    assert result["a.y"][-1] == pytest.approx(9.0 * 0.5, rel=1e-12)
    assert result["b.y"][-1] == pytest.approx(4.0 * 0.01 * result["b.u"][1:].sum(), rel=1e-12)


def test_a_value_is_converted_to_the_unit_of_its_variable(write):
    a = component("a", "a.fmu", values(real("u", 3000.0, "mm")))
    ssd = structure(system(a + component("b", "b.fmu")), defined("mm", 'm="1" factor="0.001"'))
    entry = '<ssm:MappingEntry source="u" target="u" suppressUnitConversion="true"/>'
    mapping = f'<ssm:ParameterMapping {SPACES} version="1.0">{entry}</ssm:ParameterMapping>'
    mapped = f"</ssd:ParameterValues><ssd:ParameterMapping>{mapping}</ssd:ParameterMapping>"
    for text, end in ((ssd, 1.5), (ssd.replace("</ssd:ParameterValues>", mapped), 1500.0)):
        done = run(write(text, (("m", ""), ("", ""))))
        assert done.result["a.y"][-1] == pytest.approx(end, rel=1e-12)


def test_a_value_that_is_none_in_the_unit_of_its_variable_is_refused(write):
    a = component("a", "a.fmu", values(real("u", 1e308, "km")))
    path = write(
        structure(system(a), defined("km", 'm="1" factor="1000"', "")), (("m", ""), ("", ""))
    )
    with pytest.raises(SystemFault, match=r"a\.u: 1e\+308 km is not a finite number in m$"):
        run(path)


def test_values_of_a_systems_connectors_go_to_what_they_feed(write):
    """An input and a parameter of the system, as OMSimulator has them."""
    before = connectors(strength=("input", ""), k=("parameter", "")) + values(
        real("strength", 3.0) + real("k", 2.0)
    )
    ends = connection("strength", "a.u") + connection("k", "a.gain") + CHAIN
    done = run(write(structure(system(PLAIN, ends, before))))
    assert done.result["a.y"][-1] == pytest.approx(3.0, rel=1e-12)


def test_states_enumerations_and_numbers_can_be_set(write):
    inner = real("y", 7.0) + (
        '<ssv:Parameter name="mode"><ssv:Enumeration value="on"/></ssv:Parameter>'
    )
    ssd = structure(system(component("a", "a.fmu", values(inner)) + component("b", "b.fmu")))
    assert run(write(ssd)).result["a.y"][0] == 7.0
    with pytest.raises(SystemFault, match="a.mode: no item is named 'of'; nearest: 'o"):
        run(write(ssd.replace('value="on"', 'value="of"')))


@pytest.mark.parametrize(
    "annotation",
    [
        '<oms:SimulationInformation xmlns:oms="https://raw.githubusercontent.com/OpenModelica/'
        'OMSimulator/master/schema/oms.xsd"><oms:FixedStepMaster stepSize="0.05"/>'
        "</oms:SimulationInformation>",
        '<osp:Algorithm><osp:FixedStepAlgorithm baseStepSize="0.05"/></osp:Algorithm>',
    ],
)
def test_the_step_of_other_masters_is_taken(write, annotation):
    """OMSimulator's; and that of the OSP tools, which declare no such prefix."""
    after = (
        '<ssd:DefaultExperiment stopTime="0.5"><ssd:Annotations><ssc:Annotation type="t">'
        f"{annotation}</ssc:Annotation></ssd:Annotations></ssd:DefaultExperiment>"
    )
    with read_system(write(structure(system(BOTH, CHAIN), after))) as specification:
        assert specification.coupling.macro_step == 0.05
        assert bool(specification.remarks) is ("osp" in annotation)


def only(*place, inner="", **attributes):
    return structure(system(component(*place, inner, **attributes)))


def gain(value):
    return only("a", "a.fmu", inner=values(real("gain", value)))


def linked(*ends):
    return structure(system(BOTH, "".join(ends)))


ENTITIES = '<?xml version="1.0"?><!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]>'
OUTPUT = '"y" kind="output">'
#: What is written, and words of what is said.
REFUSED = [
    (only("a", "a.fmu", implementation="ModelExchange"),
     "component 'a' asks for ModelExchange, which is not done here; allowed is CoSimulation"),
    (only("a", "a.fmu", type="application/x-ssp-package"),
     "component 'a' is of type application/x-ssp-package, allowed is"),
    (structure(system('<ssd:SignalDictionaryReference name="bus" dictionary="d"/>')),
     "SignalDictionaryReference 'bus' in system 'root' is not done here"),
    (only("a", "c.fmu"), "has no resources/c.fmu, which its structure names"),
    (only("a", "a.fmu", inner=values(real("gian", 1.0))),
     "no variable of a is named 'gian'; nearest: 'gain'"),
    (only("a", "a.fmu", inner=values(real("taken", 1.0))),
     "a.taken: what it starts from cannot be set, of variables that are no parameter"),
    (gain("much"), "'gain' of the set 'set' is 'much', allowed is a finite number"),
    # of more digits than a number of a computer has
    (only("a", "a.fmu", inner=values(INTEGER.format("1" + 400 * "0"))),
     "000', allowed is a finite number"),
    (gain("00").replace("ssv:Real", "ssv:Binary"),
     "'gain' of the set 'set' is a Binary, which is not set here"),
    (structure(system(component("a", "a.fmu") + component("a", "b.fmu"))),
     "system 'root' has two elements named 'a'"),
    (structure(system("")), "has no component"),
    (linked(connection("c.y", "b.u")), "connection c.y -> b.u: no element is named 'c'"),
    (linked(connection("a.yy", "b.u")), "no connector is named 'yy'; nearest: 'y'"),
    (linked(connection("a.y", "b.y")), "connection a.y -> b.y: both ends give"),
    (linked(CHAIN, CHAIN), "connection a.y -> b.u: b.u is fed twice"),
    (linked(connection("a.y", "b.u", "<ssc:IntegerMappingTransformation/>")),
     "connection a.y -> b.u: IntegerMappingTransformation is not done here"),
    (linked(connection("a.y", "b.gain")),
     "connection a.y -> b.gain: a parameter that another unit computes is not done here"),
    (structure(system(BOTH, CHAIN), defined("km", 'm="1" factor="0"', "")),
     "unit 'km' has factor = 0"),
    (structure(system(BOTH, CHAIN), defined("km", 'm="one"', "")),
     "BaseUnit has m = 'one', allowed is a finite number"),
    (IN_A_ROW.replace(f"{OUTPUT}<ssc:Real/>", f"{OUTPUT}<ssc:String/>"),
     "connector a.y is a String, which is not coupled here"),
    (IN_A_ROW.replace(f"{OUTPUT}<ssc:Real/>", f'{OUTPUT}<ssc:Real/><ssc:Dimension size="3"/>'),
     "connector a.y is an array, which is not coupled here"),
    (ENTITIES + IN_A_ROW.replace('name="made"', 'name="&e;"'), "SystemStructure.ssd"),
    (ENTITIES + IN_A_ROW, "has a document type"),
    (IN_A_ROW.replace("resources/a.fmu", "../a.fmu"), "points outside"),
    (IN_A_ROW.replace("resources/a.fmu", "http://a/b.fmu"), "is not in the pack"),
]  # fmt: skip


@pytest.mark.parametrize(("ssd", "says"), REFUSED, ids=[says for _, says in REFUSED])
def test_what_is_not_done_is_refused_by_name(write, ssd, says, capsys):
    path = write(ssd)
    with pytest.raises((SystemFault, FmuError, CouplingError)) as refused:
        run(path)
    assert says in str(refused.value)
    refusal(capsys, "couple", path)


@pytest.mark.parametrize("content", [b"", b"PK", b"no archive", b"PK\x03\x04" + bytes(50)])
def test_what_is_no_package_is_refused(tmp_path, content, capsys):
    path = tmp_path / "broken.ssp"
    path.write_bytes(content)
    assert "is no SSP, or truncated" in refusal(capsys, "couple", path)


def test_what_is_unpacked_is_removed(write):
    with read_system(write(IN_A_ROW)) as specification:
        files = [unit.file for unit in specification.units]
        assert all(file.is_file() for file in files)
    assert not any(file.exists() for file in files)
