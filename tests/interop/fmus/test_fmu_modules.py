"""Two units whose Python modules have one name do not run each other's code without a word."""

import importlib
import sys

import pytest
from fmpy import simulate_fmu
from pythonfmu import FmuBuilder

from cosim.coupling import FmuError, FmuParticipant, IsolatedParticipant
from cosim.coupling.fmu import module_conflicts

UNIT = """
from pythonfmu import Fmi2Causality, Fmi2Slave, Real
{imports}

class {name}(Fmi2Slave):
    def __init__(self, **given):
        super().__init__(**given)
        self.x = 0.0
        self.register_variable(Real("x", causality=Fmi2Causality.output))

    def do_step(self, time, size):
        self.x = {value}
        return True
"""


def forgotten(name):
    """pythonfmu imports what it builds."""
    for each in (name.lower(), "sizes_of_it"):
        sys.modules.pop(each, None)


def made(folder, name, value, helper=None):
    """A unit of pythonfmu in the module `name`, whose x is a value after a step."""
    folder.mkdir()
    files = []
    if helper is not None:
        files.append(folder / "sizes_of_it.py")
        files[0].write_text(f"SIZE = {helper}\n")
    script = folder / f"{name.lower()}.py"
    imports = "" if helper is None else "from sizes_of_it import SIZE"
    script.write_text(UNIT.format(name=name, value=value, imports=imports))
    forgotten(name)
    before = sys.path[:]
    built = FmuBuilder.build_FMU(script, dest=folder, project_files=files)
    sys.path[:] = before
    forgotten(name)
    return built


@pytest.fixture(autouse=True)
def nothing_loaded(monkeypatch):
    monkeypatch.setattr(module_conflicts, "_modules", {})


def x_of(unit):
    unit.enter_initialisation(0.0, 1.0)
    unit.exit_initialisation()
    unit.step(0.0, 0.1)
    return unit.read()["x"]


def test_a_module_of_the_same_name_is_refused_and_isolation_is_the_way_out(tmp_path):
    first = made(tmp_path / "a", "TwinA", 1.0)
    second = made(tmp_path / "b", "TwinA", 2.0)
    with FmuParticipant(first) as one, FmuParticipant(second) as two:
        assert x_of(one) == 1.0
        said = (
            f"^{second}: brings a Python module named 'twina', as {first} does, .*isolate = true$"
        )
        with pytest.raises(FmuError, match=said):
            two.enter_initialisation(0.0, 1.0)
        with FmuParticipant(first) as again:
            assert x_of(again) == 1.0
        with IsolatedParticipant(FmuParticipant, second) as elsewhere:
            assert x_of(elsewhere) == 2.0


def test_a_helper_module_of_the_same_name_is_refused(tmp_path):
    first = made(tmp_path / "a", "TwinB", "SIZE", helper=3.0)
    second = made(tmp_path / "b", "TwinC", "SIZE", helper=4.0)
    with FmuParticipant(first) as one, FmuParticipant(second) as two:
        assert x_of(one) == 3.0
        with pytest.raises(FmuError, match="brings a Python module named 'sizes_of_it'"):
            two.enter_initialisation(0.0, 1.0)


def test_a_helper_that_the_host_has_of_its_own_is_refused(tmp_path, monkeypatch):
    unit = made(tmp_path / "a", "TwinD", "SIZE", helper=5.0)
    (tmp_path / "sizes_of_it.py").write_text("SIZE = 6.0\n")
    monkeypatch.syspath_prepend(tmp_path)
    importlib.import_module("sizes_of_it")
    with FmuParticipant(unit) as one:
        with pytest.raises(FmuError, match="'sizes_of_it', and there is another one of that name"):
            one.enter_initialisation(0.0, 1.0)


def test_a_unit_that_was_built_in_this_process_runs_in_it(tmp_path, monkeypatch):
    unit = made(tmp_path / "a", "TwinE", 7.0)
    monkeypatch.syspath_prepend(tmp_path / "a")
    importlib.import_module("twine")
    with FmuParticipant(unit) as one:
        assert x_of(one) == 7.0


def test_a_unit_that_another_host_ran_in_this_process_runs_in_it(python_fmu):
    """Its files are gone by then; the names of its modules are hashes of their contents."""
    simulate_fmu(str(python_fmu), stop_time=0.1)
    with FmuParticipant(python_fmu) as one:
        one.enter_initialisation(0.0, 1.0)
        one.exit_initialisation()


def test_units_that_may_be_there_once_are(tmp_path):
    from c_units import made as made_of_c

    once = {'canInterpolateInputs="true"': 'canBeInstantiatedOnlyOncePerProcess="true"'}
    path = made_of_c("faulty", tmp_path, **once)
    with FmuParticipant(path, "one") as one, FmuParticipant(path, "two") as two:
        for _ in range(2):
            one.enter_initialisation(0.0, 1.0)
            with pytest.raises(FmuError, match="only once in a process, so .*isolate = true"):
                two.enter_initialisation(0.0, 1.0)
            two.close()
        one.close()
        two.enter_initialisation(0.0, 1.0)
