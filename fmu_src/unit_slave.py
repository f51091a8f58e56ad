"""An FMI 2.0 co-simulation slave, whatever its model: calls, phases, values and states.

It runs inside any host with a Python, so it imports the standard library and nothing else. The
recipe that builds an FMU lays this module and the model's slave into one package, which it renames
after its content.

pythonfmu's library turns an exception into fmi2Fatal and leaves the instance with dangling
pointers, so nothing may be raised from here, but at the end of initialisation, where the recipe
has seen to it that it comes out as fmi2Error. A call that is refused is logged as an error, the
instance counts as failed from then on, and the end of initialisation and every further step return
an error that says why, until the host resets the instance or sets a state taken before.

What only another library could do, and the native unit does:

- Of all calls only a step and the end of initialisation can return an error. What is refused in a
  setter is in the log and comes back there; until then a getter gives NaN for an output, and 0 for
  a whole number.
- A host that asks for some categories of messages gets those, errors or not. Where it switches
  logging off, it gets all: the few there are are to be known.
- A host cannot say with what rate an input goes on; `input.hold` = 1 estimates it.
- To free a state, and to write one into fewer bytes than it takes, is not asked of this code; what
  comes of such bytes is refused when it is read.
- A step cannot be interrupted, but by Ctrl-C in a host that is a Python.
- The unit must be unpacked under a path that a URL writes as it is, but for spaces: of the escapes
  of its resources' URL the library reads %20 only, and it ends the process where it finds none.
"""

import ctypes
import functools
import json
import sys
from abc import abstractmethod
from math import inf, isfinite, nan, ulp

from pythonfmu import Boolean, Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.enums import Fmi2Status

# A host computes its communication points in one way or another and may miss the end of the last
# step by rounding; a gap of more than this part of a step is not rounding.
GAP = 1e-6
# s. A step cannot be interrupted by most hosts: nobody shall wait for one for ever.
LONGEST_STEP = 1000.0

INSTANTIATED, INITIALISING, STEPPING = "instantiated", "initialising", "stepping"
TERMINATED, FAILED = "terminated", "failed"
BEFORE_THE_RUN = (INSTANTIATED, INITIALISING)
SETTABLE = (*BEFORE_THE_RUN, STEPPING)
READABLE = (INITIALISING, STEPPING, TERMINATED, FAILED)
ANY_PHASE = (*SETTABLE, TERMINATED, FAILED)


KINDS = {"Real": Real, "Integer": Integer, "Boolean": Boolean}
SAID = {Real: "a real number", Integer: "an integer", Boolean: "a Boolean"}


class Refused(Exception):
    """A call that cannot be carried out; the message goes to the host's log."""


class Unread(Refused):
    """A value is asked for that there is not: nothing has changed, and the instance goes on."""


def guarded(call, phases, result=None):
    """Make a method serve a call of FMI in these phases; of one that is refused: `result`.

    Every exception is kept inside: it is logged, and the instance counts as failed. That holds for
    a Ctrl-C too, which Python delivers into whatever runs, hence BaseException.
    """

    def wrap(method):
        @functools.wraps(method)
        def guard(self, *arguments):
            try:
                self._allow(call, phases)
                return method(self, *arguments)
            except Unread as error:
                self.log(str(error).replace("%", "%%"), Fmi2Status.error)
                return result(*arguments)
            except Refused as error:
                reason = str(error)
            except BaseException as error:
                reason = f"{call}: {error!r}"
            self._fail(reason, returns_an_error=result is False)
            return result(*arguments) if callable(result) else result

        return guard

    return wrap


def _each(value):
    """What is returned of a refused call for each of its references."""
    return lambda references: [value] * len(references)


class UnitSlave(Fmi2Slave):
    """What a model's slave is made of.

    It says of itself, as attributes of its class, `build` and `guid_of_build`, what it is a build
    of; it declares its variables by `declare`; and it has the methods here.
    """

    build, guid_of_build = "", ""
    #: Whether inputs that are set after initialisation and before the first step count as if they
    #: had been there from the beginning; else only steps know of them.
    begins_with_inputs = True
    #: An input beyond a bound, by at most this part of its nominal, is one that a host varies for a
    #: difference, or rounding: it is taken for the bound.
    slack = 0.02

    @abstractmethod
    def begin(self):
        """Begin a run from what is `given` and the `parameters`; `show` the outputs."""

    @abstractmethod
    def go_on(self, end, size):
        """Step to a time after the start of the experiment, by the host's size, s; `show` the
        outputs."""

    @abstractmethod
    def keep(self):
        """A copy of what a continuation needs, beside what is kept here."""

    @abstractmethod
    def put(self, kept):
        """Take back what `keep` gave, or what JSON made of it."""

    def warn(self):
        """Tell what the user should know, though it is no failure; called after each step."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.guid = self.guid_of_build
        # value reference -> value, of all variables
        self.cells = []
        # value reference -> lowest and highest value, and whether the lowest itself is excluded
        self.bounds = {}
        # value reference of an input -> how far beyond its bounds it is taken for them
        self.slacks = {}
        # value reference -> where the model has it
        self.input_slots, self.output_slots, self.parameter_names = {}, {}, {}
        self.tunable = set()  # names of parameters that may change in the run
        self.phase, self.failure = INSTANTIATED, ""
        self.has_experiment = False
        self.tolerance = 0.0
        self.start = self.time = 0.0
        self.stop = inf  # time past which no step may go, s
        self.stepped = False  # before the first step all follows from parameters and inputs
        self.stale = True
        self.retuned = False  # tunable parameters have changed since the last step

    def declare(self, variables):
        """All variables, in the order of their references, as the recipe tells them."""
        for each in variables:
            reference, name, causality = len(self.cells), each["name"], each["causality"]
            low, high = each["min"], each["max"]
            how = {"causality": Fmi2Causality[causality]}
            if causality == "input":
                self.input_slots[reference] = each["place"]
                self.slacks[reference] = self.slack * each["nominal"]
            elif causality == "output":
                self.output_slots[reference] = each["place"]
                how["initial"] = Fmi2Initial.calculated
                how |= {} if each["type"] == "Real" else {"variability": Fmi2Variability.discrete}
            else:
                self.parameter_names[reference] = name
                self.tunable |= {name} if each["is_tunable"] else set()
                kind = "tunable" if each["is_tunable"] else "fixed"
                how |= {"initial": Fmi2Initial.exact, "variability": Fmi2Variability[kind]}
            low, high = -inf if low is None else low, inf if high is None else high
            self.bounds[reference] = low, high, each["above_min"]
            self.cells.append(0 if each["start"] is None else each["start"])
            getter = functools.partial(self.cells.__getitem__, reference)
            variable = KINDS[each["type"]](name, getter=getter, **how)
            self.register_variable(variable, nested=False)

    def _allow(self, call, phases):
        if self.phase in phases:
            return
        if self.phase == FAILED:
            raise Refused(
                f"{call}: the instance has failed before ({self.failure}); reset it or set an "
                "earlier state"
            )
        raise Refused(f"{call}: not allowed while the instance is {self.phase}")

    def _fail(self, reason, returns_an_error):
        """The instance has failed; the first reason is the one that stays.

        What follows from it is told by the calls that return an error, not by every setter.
        """
        if self.phase != FAILED or returns_an_error:
            # FMI hands the message to the host as a printf format.
            self.log(reason.replace("%", "%%"), Fmi2Status.error)
        self.failure = self.failure or reason
        self.phase = FAILED

    def given(self):
        """Inputs that the host has given, by their slots."""
        return {slot: self.cells[reference] for reference, slot in self.input_slots.items()}

    def parameters(self):
        """Values of the parameters by their names."""
        return {name: self.cells[ref] for ref, name in self.parameter_names.items()}

    def show(self, values):
        """Fill in the outputs from what has them at their slots."""
        for reference, slot in self.output_slots.items():
            self.cells[reference] = values[slot]

    # --- initialisation ---

    @guarded("fmi2SetupExperiment", (INSTANTIATED,))
    def setup_experiment(self, start_time, stop_time, tolerance):
        tolerance = 0.0 if tolerance is None else tolerance
        if self.has_experiment:
            raise Refused("the experiment has been set up before")
        if not isfinite(start_time):
            raise Refused(f"start time is {start_time:g}; must be a finite number of seconds")
        if stop_time is not None and not stop_time >= start_time:
            raise Refused(
                f"stop time is {stop_time:g} s; must not be before the start time, {start_time:g} s"
            )
        if not (tolerance >= 0.0 and isfinite(tolerance)):
            raise Refused(f"tolerance is {tolerance:g}; must be a finite number of at least 0")
        self.has_experiment = True
        self.start = self.time = start_time
        self.stop = inf if stop_time is None else stop_time
        self.tolerance = tolerance
        # pythonfmu's library leaves the extracted FMU at the head of the process's path for good.
        sys.path[:] = [entry for entry in sys.path if entry != self.resources]
        self.stale = True

    @guarded("fmi2EnterInitializationMode", (INSTANTIATED,))
    def enter_initialization_mode(self):
        self.phase = INITIALISING

    def exit_initialization_mode(self):
        if not self._end_initialisation():
            # The library lets go of what it holds, as of a dead instance, and uses it all the same.
            for held in (type(self), self, self.log_queue):
                ctypes.pythonapi.Py_IncRef(ctypes.py_object(held))
            raise Refused

    @guarded("fmi2ExitInitializationMode", (INITIALISING,), result=False)
    def _end_initialisation(self):
        self.phase = STEPPING
        self._refresh()
        return True

    def _refresh(self):
        """Lay out the run afresh from parameters and inputs, as long as no step was made."""
        if self.stepped or not self.stale:
            return
        if self.phase == FAILED:
            raise Refused(self.failure)
        self.begin()
        self.stale = self.retuned = False

    # --- stepping ---

    @guarded("fmi2DoStep", (STEPPING,), result=False)
    def do_step(self, current_time, step_size):
        self._check_step(current_time, step_size)
        self._refresh()
        cells, kept = self.cells.copy(), self.keep()
        try:
            self.go_on(current_time + step_size - self.start, step_size)
        except BaseException:
            self.cells[:] = cells
            self.put(kept)
            raise
        self.time = current_time + step_size
        self.stepped, self.retuned = True, False
        self.warn()
        return True

    def _check_step(self, time, size):
        if not (isfinite(time) and isfinite(size)):
            raise Refused(f"step from t = {time:g} of size {size:g}: must be finite numbers")
        if size <= 0.0:
            raise Refused(f"step size is {size:g} s; must be greater than 0")
        if size > LONGEST_STEP:
            raise Refused(
                f"step size is {size:g} s; must be at most {LONGEST_STEP:g} s, as a step cannot be "
                "interrupted: take several"
            )
        if abs(time - self.time) > GAP * size + 4.0 * ulp(self.time):
            raise Refused(
                f"step begins at t = {time:.15g} s, the last one ended at t = {self.time:.15g} s"
            )
        end = time + size
        if not end - self.start > self.time - self.start:
            raise Refused(
                f"step size is {size:g} s, lost in the rounding of the time, {self.time:.15g} s, "
                "and of that since the start"
            )
        if end > self.stop and end - self.stop > GAP * size + 4.0 * ulp(self.stop):
            raise Refused(
                f"step to t = {end:.15g} s goes past the stop time that was set up, "
                f"{self.stop:.15g} s"
            )

    @guarded("fmi2Terminate", (STEPPING,))
    def terminate(self):
        self.phase = TERMINATED

    # --- values ---

    @guarded("fmi2GetReal", ANY_PHASE, result=_each(nan))
    def get_real(self, references):
        # References are unique: some hosts read all variables by this function.
        return [float(value) for value in self._values("fmi2GetReal", references, *SAID)]

    @guarded("fmi2GetInteger", ANY_PHASE, result=_each(0))
    def get_integer(self, references):
        return [int(value) for value in self._values("fmi2GetInteger", references, Integer)]

    @guarded("fmi2GetBoolean", ANY_PHASE, result=_each(0))
    def get_boolean(self, references):
        return [bool(value) for value in self._values("fmi2GetBoolean", references, Boolean)]

    def _values(self, call, references, *kinds):
        try:
            for reference in references:
                self._check_reference(reference, *kinds)
        except Refused as error:
            raise Unread(str(error)) from None
        if any(reference in self.output_slots for reference in references):
            self._allow(call, READABLE)
            self._refresh()
        return [self.cells[reference] for reference in references]

    @guarded("fmi2SetReal", SETTABLE)
    def set_real(self, references, values):
        self._set_all(references, values, Real)

    @guarded("fmi2SetInteger", SETTABLE)
    def set_integer(self, references, values):
        self._set_all(references, values, Integer)

    def _set_all(self, references, values, kind):
        for reference, value in zip(references, values, strict=True):
            self._check_reference(reference, kind)
            self._check_settable(reference)
            value = self._clipped(reference, value)
            self._check_value(reference, value)
            self._set(reference, value)

    def _check_reference(self, reference, *kinds):
        variable = self.vars.get(reference)
        if variable is None:
            # The library hands unsigned references over as signed.
            reference %= 1 << 32
            raise Refused(f"value reference {reference}: there is no such variable")
        if type(variable) not in kinds:
            was, asked = SAID[type(variable)], SAID[kinds[0]]
            raise Refused(f"{variable.name} is {was}, not {asked}")

    def _check_settable(self, reference):
        name = self.vars[reference].name
        if reference in self.output_slots:
            raise Refused(f"{name} is an output and cannot be set")
        is_fixed = reference in self.parameter_names and name not in self.tunable
        if is_fixed and self.phase not in BEFORE_THE_RUN:
            raise Refused(f"{name} is fixed and cannot be set after initialisation")

    def _clipped(self, reference, value):
        low, high, _ = self.bounds[reference]
        nearest = min(max(value, low), high)
        return nearest if abs(value - nearest) <= self.slacks.get(reference, 0.0) else value

    def _check_value(self, reference, value):
        name, (low, high, above_low) = self.vars[reference].name, self.bounds[reference]
        if not isfinite(value):
            raise Refused(f"{name} = {value:g}: must be a finite number")
        if value < low or value > high or (above_low and value == low):
            bracket = "(" if above_low else "["
            raise Refused(f"{name} = {value:g}: must lie in {bracket}{low:g}, {high:g}]")

    def _set(self, reference, value):
        if self.cells[reference] != value:
            leads = self.begins_with_inputs or self.phase != STEPPING
            self.stale = self.stale or leads or reference not in self.input_slots
            self.retuned = self.retuned or reference in self.parameter_names
        self.cells[reference] = value

    @guarded("fmi2SetBoolean", SETTABLE)
    def set_boolean(self, references, values):
        self._set_all(references, values, Boolean)

    # No variable is a text.

    @guarded("fmi2GetString", ANY_PHASE, result=_each(""))
    def get_string(self, references):
        if references:
            raise Unread("fmi2GetString: no variable is a text")
        return []

    @guarded("fmi2SetString", SETTABLE)
    def set_string(self, references, values):
        if references:
            raise Refused("fmi2SetString: no variable is a text")

    # --- state ---

    OWN = tuple("phase failure has_experiment tolerance start stop time".split())
    OWN += tuple("stepped stale retuned".split())

    @guarded("fmi2GetFMUstate", ANY_PHASE, result=dict)
    def _get_fmu_state(self):
        own = {key: getattr(self, key) for key in self.OWN}
        return own | {"build": self.build, "cells": self.cells.copy(), "kept": self.keep()}

    @guarded("fmi2SetFMUstate", ANY_PHASE)
    def _set_fmu_state(self, state):
        if state.get("build") != self.build:
            raise Refused("the state is damaged, or was taken from another build of this unit")
        for key in self.OWN:
            setattr(self, key, state[key])
        self.cells[:] = state["cells"]
        self.put(state["kept"])

    @staticmethod
    def _fmu_state_from_bytes(state):
        # Cannot refuse: an exception here would be fatal. What is not a state has no build.
        try:
            loaded = json.loads(state.decode("utf-8"))
        except ValueError:
            loaded = None
        return loaded if isinstance(loaded, dict) else {}
