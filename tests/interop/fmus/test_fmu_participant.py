"""FmuParticipant on the real units: what it declares, what it refuses, failures and teardown."""

import zipfile

import pytest

from cosim import coupling
from cosim.coupling import FmuError, FmuParticipant
from cosim.coupling.fmu.errors import FmuCallError

HELD = {"surface_speed": 0.15}


def alone(participant, **arguments):
    with coupling.CoupledSystem([participant], []) as system:
        return coupling.run(
            system,
            coupling.GaussSeidel((participant.name,)),
            **{"stop": 1.0, "macro_step": 0.01} | arguments,
        )


@pytest.mark.parametrize("settings, message", [
    ({"parameters": {"rig.mas": 1.0}},
     r"no parameter of block is named 'rig.mas'; nearest: 'rig.mass'"),
    ({"parameters": {"x": 1.0}}, "block.x is a output, not a parameter"),
    ({"parameters": {"rig.mass": float("nan")}}, "block.rig.mass = nan: must be a finite"),
    ({"parameters": {"rig.mass": True}}, "must be a finite number"),
    ({"parameters": {"rig.mass": -1.0}}, r"block.rig.mass = -1: must lie in \[0, inf\]"),
    ({"inputs": {"surface_sped": 1.0}}, "nearest: 'surface_speed'"),
    ({"inputs": {"interface_temperature": -300.0}}, r"must lie in \[-273.15, inf\]"),
])  # fmt: skip
def test_a_setting_that_does_not_fit_is_refused(fmu, settings, message):
    with pytest.raises(FmuError, match=message):
        FmuParticipant(fmu, "block", **settings)


def test_a_file_that_is_no_fmu_is_refused_in_one_line(fmu, tmp_path):
    whole, broken = fmu.read_bytes(), tmp_path / "broken.fmu"
    with pytest.raises(FmuError, match=r"broken.fmu: no such file"):
        FmuParticipant(broken)
    for content in (whole[: len(whole) // 2], b"", b"text"):
        broken.write_bytes(content)
        with pytest.raises(FmuError, match=r"broken.fmu: not an FMU, or truncated \(.*\)$"):
            FmuParticipant(broken)
    with zipfile.ZipFile(broken, "w") as archive:
        archive.writestr("readme.txt", "hello")
    with pytest.raises(FmuError, match="holds no modelDescription.xml"):
        FmuParticipant(broken)
    with zipfile.ZipFile(broken, "w") as archive:
        archive.writestr("modelDescription.xml", "<fmiModelDescription")
    with pytest.raises(FmuError, match="modelDescription.xml is not valid"):
        FmuParticipant(broken)


def test_what_the_fmu_logs_reaches_the_exception(unit):
    """mass = 0 lies on the declared limit; the FMU itself knows that it is excluded."""
    block = FmuParticipant(unit, "block", inputs=HELD, parameters={"rig.mass": 0.0})
    says = r"^block: failed during .*rig.mass = 0: must lie in \(0, inf\]"
    with pytest.raises(coupling.ParticipantError, match=says) as caught:
        alone(block)
    assert "\n" not in str(caught.value) and str(caught.value).count("rig.mass") == 1


def test_an_input_that_is_refused_in_the_run_says_so(unit):
    block = FmuParticipant(unit, "block", inputs=HELD)
    with block:
        block.enter_initialisation(0.0, 1.0)
        block.exit_initialisation()
        block.step(0.0, 0.1)
        with pytest.raises(FmuCallError, match="^surface_speed = nan: must be a finite number"):
            block.write({"surface_speed": float("nan")})
