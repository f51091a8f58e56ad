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
    ends = zip(("start", "end"), (start, end), strict=True)
    text = ""
    for side, place in ends:
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
        component("a", "a.fmu", values(real("u", 3.0))),
        connection("a.y", "out"),
        connectors(out=("output", "")),
        "deep",
    )
    left = system(deep, connection("deep.out", "out"), connectors(out=("output", "")), "left")
    right = system(
        component("b", "b.fmu"),
        connection("in", "b.u"),
        connectors(**{"in": ("input", "")}),
        "right",
    )
    done = run(write(structure(system(left + right, connection("left.out", "right.in")))))
    assert set(done.assembly.system.participants) == {"left_deep_a", "right_b"}
    np.testing.assert_allclose(done.result["right_b.y"], ramps(done)[1], rtol=0, atol=1e-13)


def test_transformations_are_made_border_by_border(write):
    """u_b = 2 (3 y_a + 1) + 10 through two borders."""
    linear = '<ssc:LinearTransformation factor="{}" offset="{}"/>'.format
    left = system(
        component("a", "a.fmu", values(real("u", 3.0))),
        connection("a.y", "out", linear(3, 1)),
        connectors(out=("output", "")),
        "left",
    )
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
    units = """<ssd:Units><ssc:Unit name="km"><ssc:BaseUnit m="1" factor="1000"/></ssc:Unit>
      <ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit></ssd:Units>"""
    ssd = structure(system(BOTH, CHAIN), units + '<ssd:DefaultExperiment stopTime="0.5"/>')
    before, after = ssd.split('<ssd:Component name="b"')
    before = before.replace(
        '"y" kind="output"><ssc:Real/>', '"y" kind="output"><ssc:Real unit="km"/>'
    )
    after = after.replace('"u" kind="input"><ssc:Real/>', '"u" kind="input"><ssc:Real unit="m"/>')
    result = run(write(f'{before}<ssd:Component name="b"{after}')).result
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
    units = (
        '<ssd:Units><ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit></ssd:Units>'
    )
    ssd = structure(
        system(component("a", "a.fmu", values(real("u", 3000.0, "mm"))) + component("b", "b.fmu")),
        units + '<ssd:DefaultExperiment stopTime="0.5"/>',
    )
    done = run(write(ssd, (("m", ""), ("", ""))))
    assert done.result["a.y"][-1] == pytest.approx(1.5, rel=1e-12)
    entry = '<ssm:MappingEntry source="u" target="u" suppressUnitConversion="true"/>'
    mapping = f'<ssm:ParameterMapping {SPACES} version="1.0">{entry}</ssm:ParameterMapping>'
    mapped = f"</ssd:ParameterValues><ssd:ParameterMapping>{mapping}</ssd:ParameterMapping>"
    done = run(write(ssd.replace("</ssd:ParameterValues>", mapped), (("m", ""), ("", ""))))
    assert done.result["a.y"][-1] == pytest.approx(1500.0, rel=1e-12)


def test_a_value_that_is_none_in_the_unit_of_its_variable_is_refused(write):
    units = (
        '<ssd:Units><ssc:Unit name="km"><ssc:BaseUnit m="1" factor="1000"/></ssc:Unit></ssd:Units>'
    )
    a = component("a", "a.fmu", values(real("u", 1e308, "km")))
    path = write(structure(system(a), units), (("m", ""), ("", "")))
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


REFUSED = {
    "model exchange": (
        component("a", "a.fmu", implementation="ModelExchange"),
        "component 'a' asks for ModelExchange, which is not done here; allowed is CoSimulation",
    ),
    "a type": (
        component("a", "a.fmu", type="application/x-ssp-package"),
        "component 'a' is of type application/x-ssp-package, allowed is",
    ),
    "a dictionary": (
        '<ssd:SignalDictionaryReference name="bus" dictionary="d"/>',
        "SignalDictionaryReference 'bus' in system 'root' is not done here",
    ),
    "no such file": (component("a", "c.fmu"), "has no resources/c.fmu, which its structure names"),
    "no such variable": (
        component("a", "a.fmu", values(real("gian", 1.0))),
        "no variable of a is named 'gian'; nearest: 'gain'",
    ),
    "a computed one": (
        component("a", "a.fmu", values(real("taken", 1.0))),
        "a.taken: what it starts from cannot be set, of variables that are no parameter",
    ),
    "no number": (
        component("a", "a.fmu", values(real("gain", "much"))),
        "'gain' of the set 'set' is 'much', allowed is a finite number",
    ),
    "no number of a computer": (
        component("a", "a.fmu", values(INTEGER.format("1" + 400 * "0"))),
        "000', allowed is a finite number",
    ),
    "binary": (
        component(
            "a",
            "a.fmu",
            values('<ssv:Parameter name="gain"><ssv:Binary value="00"/></ssv:Parameter>'),
        ),
        "'gain' of the set 'set' is a Binary, which is not set here",
    ),
    "twice": (
        component("a", "a.fmu") + component("a", "b.fmu"),
        "system 'root' has two elements named 'a'",
    ),
    "no components": ("", "has no component"),
}


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_not_done_is_refused_by_name(write, case, capsys):
    elements, message = REFUSED[case]
    path = write(structure(system(elements)))
    with pytest.raises((SystemFault, FmuError)) as refused:
        run(path)
    assert message in str(refused.value)
    refusal(capsys, "couple", path)


LINKS = {
    "no element": (connection("c.y", "b.u"), "connection c.y -> b.u: no element is named 'c'"),
    "no connector": (connection("a.yy", "b.u"), "no connector is named 'yy'; nearest: 'y'"),
    "both give": (connection("a.y", "b.y"), "connection a.y -> b.y: both ends give"),
    "twice": (CHAIN + CHAIN, "connection a.y -> b.u: b.u is fed twice"),
    "a mapping": (
        connection("a.y", "b.u", "<ssc:IntegerMappingTransformation/>"),
        "connection a.y -> b.u: IntegerMappingTransformation is not done here",
    ),
    "a parameter": (
        connection("a.y", "b.gain"),
        "connection a.y -> b.gain: a parameter that another unit computes is not done here",
    ),
}


@pytest.mark.parametrize("case", LINKS)
def test_a_connection_that_cannot_be_is_refused_by_name(write, case):
    ends, message = LINKS[case]
    with pytest.raises((SystemFault, CouplingError)) as refusal:
        run(write(structure(system(BOTH, ends))))
    assert message in str(refusal.value)


@pytest.mark.parametrize(
    "base, message",
    [
        ('m="1" factor="0"', "unit 'km' has factor = 0"),
        ('m="one"', "BaseUnit has m = 'one', allowed is a finite number"),
    ],
)
def test_a_unit_that_makes_no_sense_is_refused(write, base, message):
    units = f'<ssd:Units><ssc:Unit name="km"><ssc:BaseUnit {base}/></ssc:Unit></ssd:Units>'
    with pytest.raises(SystemFault, match=message):
        run(write(structure(system(BOTH, CHAIN), units)))


@pytest.mark.parametrize(
    ("what", "said"),
    [
        ("<ssc:String/>", "is a String, which"),
        ('<ssc:Real/><ssc:Dimension size="3"/>', "is an array, which"),
    ],
)
def test_strings_and_arrays_are_not_coupled(write, what, said):
    text = IN_A_ROW.replace('"y" kind="output"><ssc:Real/>', f'"y" kind="output">{what}')
    with pytest.raises(SystemFault, match=f"connector a.y {said} is not coupled here"):
        run(write(text))


ENTITIES = '<?xml version="1.0"?><!DOCTYPE x [<!ENTITY e SYSTEM "file:///etc/passwd">]>'


def test_entities_are_refused(write):
    text = IN_A_ROW.replace('name="made"', 'name="&e;"')
    with pytest.raises(SystemFault, match="SystemStructure.ssd"):
        run(write(ENTITIES + text))
    with pytest.raises(SystemFault, match="has a document type"):
        run(write(ENTITIES + IN_A_ROW))


def test_references_that_point_outside_are_refused(write):
    text = IN_A_ROW
    for source, said in (("../a.fmu", "points outside"), ("http://a/b.fmu", "is not in the pack")):
        with pytest.raises(SystemFault, match=said):
            run(write(text.replace("resources/a.fmu", source)))


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
