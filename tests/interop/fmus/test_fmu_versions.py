"""Units of FMI 2.0 and 3.0 behind one front: types, arrays, inputs with a slope, events, states."""

import pytest
from c_units import made

from cosim import coupling
from cosim.coupling import FmuError, FmuParticipant, Waveform
from cosim.coupling.fmu.errors import FmuCallError


def started(path, **settings):
    unit = FmuParticipant(path, "unit", **settings)
    unit.enter_initialisation(0.0, 10.0)
    unit.exit_initialisation()
    return unit


@pytest.fixture
def old(tmp_path):
    return made("faulty", tmp_path)


@pytest.fixture
def new(tmp_path):
    return made("events", tmp_path)


def test_ports_say_what_their_units_are_made_of_and_how_large_they_are(old, new):
    ports = FmuParticipant(old).ports
    assert ports["u"].definition == coupling.UnitDefinition((1, 2, -3, -1, 0, 0, 0, 0), 0.001)
    assert ports["u"].nominal == 50.0  # declared as -50: a size
    heat = coupling.UnitDefinition((0, 0, 0, 0, 1, 0, 0, 0), offset=273.15)
    assert (ports["x"].unit, ports["x"].nominal, ports["x"].definition) == ("degC", 300.0, heat)
    assert (ports["k"].unit, ports["k"].nominal, ports["k"].definition) == ("1", 1.0, None)
    ports = FmuParticipant(new).ports
    assert list(ports) == [
        "u[1]", "u[2]", "f", "n", "b", "e", "y[1]", "y[2]", "x", "events", "seen", "high",
    ]  # fmt: skip
    metres = coupling.UnitDefinition((0, 1, 0, 0, 0, 0, 0, 0), 1000.0)
    assert ports["u[2]"].definition == metres and ports["u[2]"].nominal == 3.0


def test_capabilities_are_those_that_the_unit_declares(old, new, tmp_path):
    every = coupling.Capabilities(waveforms=True, restores=True, saves=True, input_order=1)
    assert FmuParticipant(old).capabilities == every
    assert FmuParticipant(new).capabilities == coupling.Capabilities(
        restores=True, saves=True, ends_early=True
    )
    assert not FmuParticipant(new, early_return=False).capabilities.ends_early
    no = {f'{key}="true"': "" for key in ("canInterpolateInputs", "canGetAndSetFMUstate")}
    assert FmuParticipant(made("faulty", tmp_path, **no)).capabilities == coupling.Capabilities()


@pytest.mark.parametrize("settings, message", [
    ({"inputs": {"u[3]": 1.0}}, r"no input of events is named 'u\[3\]'; nearest: 'u\["),
    ({"inputs": {"u": 1.0}}, "no input of events is named 'u'"),
    ({"inputs": {"n": 1.5}}, "events.n = 1.5: must be a whole number"),
    ({"inputs": {"b": 1.0}}, "events.b = 1.0: must be true or false"),
    ({"parameters": {"p[1,2]": "a"}}, r"events.p\[1,2\] = 'a': must be a finite number"),
])  # fmt: skip
def test_a_setting_of_fmi_3_that_does_not_fit_is_refused(new, settings, message):
    with pytest.raises(FmuError, match=message):
        FmuParticipant(new, **settings)


def test_a_variable_that_may_be_set_before_initialisation_starts_from_there(old, tmp_path):
    for name, said in {"n": "^faulty.n: what it starts from cannot", "xx": "named 'xx'"}.items():
        with pytest.raises(FmuError, match=said):
            FmuParticipant(old, starts={name: 1})
    exact = {
        'causality="output" variability="continuous"': 'causality="output" initial="exact"',
        '<Real declaredType="Heat"/>': '<Real declaredType="Heat" start="1"/>',
    }
    path = made("faulty", tmp_path, **exact)
    with started(path, starts={"x": 20.0}) as unit:
        assert unit.read()["x"] == 20.0
    with pytest.raises(FmuError, match=r"faulty.x = -300: must lie in \[-273.15, inf\]"):
        FmuParticipant(path, starts={"x": -300.0})


def test_an_array_without_start_values_is_set_as_a_whole(tmp_path):
    path = made("events", tmp_path, **{'start="1 2 3 4"': 'start="1 2 3"'})
    with pytest.raises(FmuError, match=r"p\[1,1\] has no start value: the whole array"):
        started(path, parameters={"p[1,2]": 7.0})
    every = {f"p[{i},{j}]": 2.0 for i in (1, 2) for j in (1, 2)}
    with started(path, parameters=every, inputs={"u[1]": 1.0}) as unit:
        assert unit.read()["y[2]"] == 2.0


def test_types_are_those_of_the_unit(old, new):
    with started(new) as unit:
        unit.write({"n": 254.7, "e": 1.6, "f": 0.1})
        assert (unit.read()["seen"], unit.read()["high"]) == (255, True)
        unit.step(0.0, 1.0)
        assert unit.read()["x"] == pytest.approx(0.1, rel=2**-23)  # of single precision
        for value in (256.0, -1.0):
            with pytest.raises(FmuError, match="is given to an integer from 0 to 255"):
                unit.write({"n": value})
    with started(old) as unit:
        unit.write({"k": 1.6, "c": 1.0})
        assert (unit.read()["n"], unit.read()["b"]) == (2, 1)


# --- inputs over a step ---


def test_a_slope_is_followed_exactly_and_then_forgotten(old):
    with started(old) as unit:
        unit.write_waveforms({"u": Waveform((1.0, 2.0), 0.5), "k": Waveform((1.0, 4.0), 0.5)})
        unit.step(0.0, 0.5)
        assert unit.read()["x"] == 0.75 and unit.read()["n"] == 2  # of k the mean
        unit.write({"u": 3.0})
        unit.step(0.5, 0.5)
        assert unit.read()["x"] == 2.25


def test_a_derivative_that_the_unit_does_not_take_is_a_failure(old, new):
    with started(old, input_order=2) as unit:
        with pytest.raises(FmuCallError, match="only u, order 1"):
            unit.write_waveforms({"u": Waveform((1.0, 0.0, 4.0), 0.5)})
    with started(new) as unit, pytest.raises(FmuError, match="takes no derivatives of inputs"):
        unit.write_waveforms({"f": Waveform((1.0, 0.0), 0.5)})


# --- events ---


def times(unit, size, stop):
    """(time reached, whether early) of each step."""
    time, found = 0.0, []
    while time < stop - 1e-9:
        reached = unit.step(time, size)
        time = time + size if reached is None else reached
        found.append((pytest.approx(time, abs=1e-12), reached is not None))
    return found


@pytest.mark.parametrize("announces", [False, True])
def test_an_event_ends_the_step_and_is_handled(new, announces):
    with started(new, parameters={"period": 0.25, "announces": announces}) as unit:
        unit.write({"f": 1.0})
        found = times(unit, 0.2, 0.7)
        assert found == [(0.2, False), (0.25, True), (0.45, False), (0.5, True), (0.7, False)]
        assert unit.read()["events"] == 2
        assert unit.read()["x"] == pytest.approx(0.7, rel=1e-12)


@pytest.mark.parametrize("announces", [False, True])
def test_an_event_at_the_end_of_a_step_does_not_end_it_early(new, announces):
    with started(new, parameters={"period": 0.25, "announces": announces}) as unit:
        assert unit.step(0.0, 0.25) is None and unit.read()["events"] == 1


def test_without_early_return_the_unit_passes_its_events(new):
    with started(new, parameters={"period": 0.25}, early_return=False) as unit:
        assert unit.step(0.0, 0.3) is None and unit.read()["events"] == 1


def test_a_unit_that_declares_an_event_mode_and_has_none_runs_without(new):
    with FmuParticipant(new, "without events", parameters={"period": 0.25}) as unit:
        unit.enter_initialisation(0.0, 1.0)
        unit.exit_initialisation()
        assert unit.step(0.0, 0.3) == 0.25 and unit.read()["events"] == 1
        assert [message.text for message in unit.messages] == ["there is no event mode"]


def test_a_discrete_input_changes_at_an_event(new):
    """The unit refuses it between two."""
    with started(new, inputs={"n": 3}) as unit:
        assert unit.read()["seen"] == 3
        unit.step(0.0, 0.1)
        unit.write({"n": 4.0, "e": 2.0, "b": 1.0})
        assert unit.read()["seen"] == 4 and unit.read()["high"]


# --- states ---


@pytest.mark.parametrize("announces", [False, True])
def test_what_the_host_knows_goes_back_with_the_state(new, announces):
    """The event that was announced, elements of arrays, discrete inputs."""
    settings = {"parameters": {"period": 0.25, "announces": announces}}
    with started(new, **settings) as unit:
        unit.step(0.0, 0.2)
        state = unit.get_state()
        unit.write({"n": 5, "u[1]": 1.0})
        ahead = times(unit, 0.2, 0.6), unit.read()
        unit.set_state(state)
        unit.write({"u[2]": 1.0})
        assert unit.read()["y[1]"] == 2.0  # u[1] is 0 again
        unit.set_state(state)
        unit.write({"n": 5, "u[1]": 1.0})
        assert (times(unit, 0.2, 0.6), unit.read()) == ahead
        unit.free_state(state)


@pytest.mark.parametrize("name", ["faulty", "events"])
def test_a_saved_state_goes_on_in_another_instance(tmp_path, name):
    path = made(name, tmp_path)
    free = "u" if name == "faulty" else "u[1]"
    with started(path, inputs={free: 1.0}) as unit:
        unit.step(0.0, 0.1)
        saved = unit.save_state()
        unit.step(0.1, 0.1)
        expected = unit.read()
    with started(path) as unit:
        unit.load_state(saved)
        unit.step(0.1, 0.1)
        assert unit.read() == expected
        with pytest.raises(FmuError, match="what is to be its state is none, or damaged"):
            unit.load_state(b"xyz")
        with pytest.raises(FmuError, match="the state is that of other, not of"):
            unit.load_state(b'{"unit": "other", "known": {}, "memory": {}}\nxyz')


def test_c_is_not_given_a_state_that_is_not_its_own(old):
    with started(old) as unit:
        state = unit.get_state()
        unit.free_state(state)
        for call in (unit.set_state, unit.free_state):
            with pytest.raises(FmuCallError, match="a state that is not its own, or not any more"):
                call(state)
        state = unit.get_state()
        unit.enter_initialisation(0.0, 1.0)
        with pytest.raises(FmuCallError, match="not its own"):
            unit.set_state(state)


def test_a_restore_that_is_not_exact_is_found(old, tmp_path):
    with started(old, inputs={"u": 1.0}) as unit:
        assert coupling.restores_exactly(unit, 0.0, 0.1)
        assert unit.read()["x"] == 0.0
    with started(old, parameters={"fault": 5}) as unit:
        assert not coupling.restores_exactly(unit, 0.0, 0.1)
    with started(old, parameters={"fault": 8}) as unit:
        with pytest.raises(FmuCallError, match="too hot"):  # which has nothing to do with states
            coupling.restores_exactly(unit, 0.0, 0.1)
    path = made("faulty", tmp_path, **{'canGetAndSetFMUstate="true"': ""})
    with started(path) as unit:
        assert not coupling.restores_exactly(unit, 0.0, 0.1)
        unit.step(0.0, 0.1)


# --- what they log ---


def test_what_a_unit_says_is_kept_with_its_time(old):
    with FmuParticipant(old, "unit", parameters={"fault": 7, "at": 0.1, "text": "häl\nlo"}) as unit:
        heard = []
        unit.messages.listeners.append(heard.append)
        unit.enter_initialisation(0.0, 1.0)
        unit.exit_initialisation()
        unit.step(0.0, 0.1)
        unit.step(0.1, 0.1)
        assert [str(message) for message in unit.messages] == [
            "unit: initialisation: warning [texts]: häl lo",
            "unit: t = 0.1 s: warning [heat]: warm",
        ]
        assert heard == list(unit.messages)


def test_a_step_that_is_not_made_whole_says_how_far_it_came(old):
    with started(old, parameters={"fault": 9}) as unit:
        with pytest.raises(FmuCallError, match="cannot make the whole step; it came to t = 0.05 s"):
            unit.step(0.0, 0.1)


def test_after_a_fatal_error_nothing_is_called(old):
    with started(old, parameters={"fault": 10}) as unit:
        state = unit.get_state()
        for said in ("broken for good", "has reported a fatal error and cannot be called any more"):
            with pytest.raises(FmuCallError, match=said):
                unit.step(0.0, 0.1)
        unit.free_state(state)  # silently: the step has said what is wrong
