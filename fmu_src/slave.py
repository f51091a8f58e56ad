"""StickSlip3DOF as an FMI 2.0 co-simulation slave: a thin FMI wrapper over the kernel.

It runs inside any host with a Python, so it imports the standard library and nothing else. The
recipe that builds the FMU lays this module into the package `stickslip`, which it renames after its
content, and adds `stickslip.variables` (the variables and what is known of each).

pythonfmu's library turns an exception into fmi2Fatal and leaves the instance with dangling
pointers, so nothing may be raised from here. A call that is refused is logged as an error, the
instance counts as failed from then on, and every further step returns an error that says why,
until the host resets the instance or sets a state taken before.

What only another library could do, and the native unit does:

- Of all calls only a step can return an error. One that is refused in a setter or at the end of
  initialisation is in the log and comes back at the next step; until then a getter gives NaN for an
  output, and 0 for a whole number.
- A host that asks for some categories of messages gets those, errors or not. Where it switches
  logging off, it gets all: the few there are are to be known.
- A host cannot say with what rate an input goes on; `input.hold` = 1 estimates it.
- To free a state, and to write one into fewer bytes than it takes, is not asked of this code; what
  comes of such bytes is refused when it is read.
- A step cannot be interrupted, but by Ctrl-C in a host that is a Python.
- The unit must be unpacked under a path that a URL writes as it is, but for spaces: of the escapes
  of its resources' URL the library reads %20 only, and it ends the process where it finds none.
"""

import functools
import json
import sys
from math import inf, isfinite, nan, ulp

from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.enums import Fmi2Status
from stickslip.contradictions import contradiction
from stickslip.kernel.advance import advance, initialise
from stickslip.kernel.layout import (
    DONE,
    E_FIRST,
    G_BEFORE,
    G_FIRST,
    G_SIZE,
    G_VALUE,
    GIVEN_INPUTS,
    MODE,
    O_SIZE,
    P_MU_K,
    P_MU_S,
    P_NORMAL_FORCE,
    P_PRESLIDING,
    SHOWN,
    STICK,
    TIME,
    U_SIZE,
    U_SPEED,
    W_SIZE,
    Z_ENERGY,
    Z_INPUTS,
    Z_SIZE,
)
from stickslip.kernel.motion import block_energy
from stickslip.kernel.outputs import show
from stickslip.kernel.rig.drive import lead_inputs
from stickslip.packing import pack
from stickslip.status import WHY_NOT
from stickslip.variables import BUILD, GUID, INPUTS, OUTPUTS, PARAMETERS, TUNABLE

# A host computes its communication points in one way or another and may miss the end of the last
# step by rounding; a gap of more than this part of a step is not rounding.
GAP = 1e-6
# s. A step cannot be interrupted by most hosts: nobody shall wait for one for ever.
LONGEST_STEP = 1000.0
FINEST_TOLERANCE = next(e["min"] for e in PARAMETERS if e["name"] == "solver.tolerance")

INSTANTIATED, INITIALISING, STEPPING = "instantiated", "initialising", "stepping"
TERMINATED, FAILED = "terminated", "failed"
BEFORE_THE_RUN = (INSTANTIATED, INITIALISING)
SETTABLE = (*BEFORE_THE_RUN, STEPPING)
READABLE = (INITIALISING, STEPPING, TERMINATED, FAILED)
ANY_PHASE = (*SETTABLE, TERMINATED, FAILED)


class Refused(Exception):
    """A call that cannot be carried out; the message goes to the host's log."""


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
            except Refused as error:
                reason = str(error)
            except BaseException as error:
                reason = f"{call}: {error!r}"
            self._fail(reason, returns_an_error=result is False)
            return result(*arguments) if callable(result) else result

        return guard

    return wrap


def _nans(references):
    return [nan] * len(references)


def _zeros(references):
    return [0] * len(references)


def _empties(references):
    return [""] * len(references)


class StickSlip3DOF(Fmi2Slave):
    """Block on four springs on a moving surface, with dry friction, in x, y and phi."""

    description = (
        "Stick-slip of a block on four springs on a moving surface: three degrees of freedom, "
        "dry friction, friction heat handed over as energy"
    )
    version = BUILD

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.guid = GUID
        # value reference -> value, of all variables
        self.cells = []
        # value reference -> lowest and highest value, and whether the lowest itself is excluded
        self.bounds = {}
        self.input_slots, self.output_slots, self.parameter_names = {}, {}, {}
        self.g = [0.0] * G_SIZE  # inputs as the host gives them
        self.u = [0.0] * U_SIZE  # inputs as the kernel has them
        self._register_ports()
        self._register_parameters()
        self.phase, self.failure = INSTANTIATED, ""
        self.said_to_creep = False
        self.has_experiment = False
        self.tolerance = 0.0
        self.start = self.time = 0.0
        self.stepped = False  # before the first step all follows from parameters and inputs
        self.stale = True
        self.retuned = False  # tunable parameters have changed since the last step
        self.p = []
        self.z = [0.0] * Z_SIZE
        self.w = [0.0] * W_SIZE
        self.e = [0.0] * E_FIRST  # no room for events: they are not logged here
        self.o = [0.0] * O_SIZE

    def _register_ports(self):
        for name, slot, start, low, high in INPUTS:
            reference = self._register(Real, name, start, causality=Fmi2Causality.input)
            self._bound(reference, low, high)
            self.input_slots[reference] = slot
            self.g[G_VALUE + slot] = start
        for name, slot, integer in OUTPUTS:
            more = {"variability": Fmi2Variability.discrete} if integer else {}
            more |= {"causality": Fmi2Causality.output, "initial": Fmi2Initial.calculated}
            reference = self._register(Integer if integer else Real, name, 0, **more)
            self.output_slots[reference] = slot

    def _register_parameters(self):
        for entry in PARAMETERS:
            tunable = entry["name"] in TUNABLE
            reference = self._register(
                Integer if entry["unit"] is None else Real,
                entry["name"],
                entry["start"],
                causality=Fmi2Causality.parameter,
                initial=Fmi2Initial.exact,
                variability=Fmi2Variability.tunable if tunable else Fmi2Variability.fixed,
            )
            self._bound(reference, entry["min"], entry["max"], entry["above_min"])
            self.parameter_names[reference] = entry["name"]

    def _register(self, kind, name, start, **more):
        reference = len(self.cells)
        self.cells.append(start)
        getter = functools.partial(self.cells.__getitem__, reference)
        self.register_variable(kind(name, getter=getter, **more), nested=False)
        return reference

    def _bound(self, reference, low, high, above_low=False):
        self.bounds[reference] = (
            -inf if low is None else low,
            inf if high is None else high,
            above_low,
        )

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

    # --- initialisation ---

    @guarded("fmi2SetupExperiment", (INSTANTIATED,))
    def setup_experiment(self, start_time, stop_time, tolerance):
        """The host's tolerance can tighten the parameter solver.tolerance, not loosen it."""
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
        self.tolerance = tolerance
        # pythonfmu's library leaves the extracted FMU at the head of the process's path for good.
        sys.path[:] = [entry for entry in sys.path if entry != self.resources]
        self.stale = True

    @guarded("fmi2EnterInitializationMode", (INSTANTIATED,))
    def enter_initialization_mode(self):
        self.phase = INITIALISING

    @guarded("fmi2ExitInitializationMode", (INITIALISING,))
    def exit_initialization_mode(self):
        self.phase = STEPPING
        self._refresh()

    def _refresh(self):
        """Lay out the run afresh from parameters and inputs, as long as no step was made."""
        if self.stepped or not self.stale:
            return
        if self.phase == FAILED:
            raise Refused(self.failure)
        values = self._values_by_name()
        self.p[:] = self._packed(values)
        self.g[G_BEFORE:] = [0.0] * (G_SIZE - G_BEFORE)
        self.g[G_FIRST] = values["input.hold"]
        self.u[:] = [0.0] * U_SIZE
        self.u[:GIVEN_INPUTS] = self.g[G_VALUE : G_VALUE + GIVEN_INPUTS]
        initialise(self.p, self.z, 0.0)
        self._advance(0.0)
        self.stale = self.retuned = False

    def _values_by_name(self):
        return {name: float(self.cells[ref]) for ref, name in self.parameter_names.items()}

    def _packed(self, values):
        refusal = contradiction(values)
        if refusal:
            raise Refused(refusal)
        if self.tolerance > 0.0:
            tighter = max(self.tolerance, FINEST_TOLERANCE)
            values["solver.tolerance"] = min(values["solver.tolerance"], tighter)
        return pack(values)

    # --- stepping ---

    @guarded("fmi2DoStep", (STEPPING,), result=False)
    def do_step(self, current_time, step_size):
        self._check_step(current_time, step_size)
        self._refresh()
        kept = self.p, self.g, self.u, self.z, self.o, self.cells
        before = [each.copy() for each in kept]
        try:
            if self.retuned:
                self._tune()
            now, end = self.z[SHOWN + TIME], current_time + step_size - self.start
            lead_inputs(self.g, self.u, self.z[SHOWN + MODE] == STICK, now, end - now)
            self._advance(end)
        except BaseException:
            for each, was in zip(kept, before, strict=True):
                each[:] = was
            raise
        self.time = current_time + step_size
        self.stepped, self.retuned = True, False
        self._say_if_creeping()
        return True

    def _tune(self):
        """Go on with parameters that have changed in the run."""
        before = block_energy(self.p, self.z, SHOWN)
        self.p[:] = self._packed(self._values_by_name())
        # A contact that is stiffer from now on holds more: whoever tunes it has put that in.
        self.z[Z_ENERGY] += block_energy(self.p, self.z, SHOWN) - before
        self.z[Z_INPUTS] = nan  # the kernel starts afresh from here, as after a change of inputs

    def _say_if_creeping(self):
        """Warn, once, of a surface that a stick's creep keeps up with: it would stick for ever."""
        creep, speed = self.p[P_PRESLIDING], abs(self.g[G_VALUE + U_SPEED])
        creep *= max(self.p[P_MU_S], self.p[P_MU_K]) * self.p[P_NORMAL_FORCE]
        if not self.said_to_creep and 0.0 < speed <= creep:
            self.said_to_creep = True
            self.log(
                f"surface_speed = {speed:g} m/s is not above friction.stick_creep = {creep:g} m/s: "
                "the contact creeps as fast as the surface and never breaks away; its mode stays 0",
                Fmi2Status.warning,
            )

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

    def _advance(self, end):
        """On to a time after the start of the experiment, s."""
        status = advance(self.p, self.u, self.z, self.w, self.e, end)
        if status != DONE:
            raise Refused(f"no way to {end:g} s after the start: {WHY_NOT[status]}")
        show(self.p, self.u, self.z, self.w, self.o, 0)
        for reference, slot in self.output_slots.items():
            self.cells[reference] = self.o[slot]

    @guarded("fmi2Terminate", (STEPPING,))
    def terminate(self):
        self.phase = TERMINATED

    # --- values ---

    @guarded("fmi2GetReal", ANY_PHASE, result=_nans)
    def get_real(self, references):
        return [float(value) for value in self._values("fmi2GetReal", references, Real)]

    @guarded("fmi2GetInteger", ANY_PHASE, result=_zeros)
    def get_integer(self, references):
        return [int(value) for value in self._values("fmi2GetInteger", references, Integer)]

    def _values(self, call, references, kind):
        for reference in references:
            self._check_reference(reference, kind)
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
            self._check_value(reference, value)
            self._set(reference, value)

    def _check_reference(self, reference, kind):
        variable = self.vars.get(reference)
        if variable is None:
            # The library hands unsigned references over as signed.
            reference %= 1 << 32
            raise Refused(f"value reference {reference}: there is no such variable")
        if not isinstance(variable, kind):
            both = ["a real number", "an integer"]
            was, asked = both if kind is Integer else reversed(both)
            raise Refused(f"{variable.name} is {was}, not {asked}")

    def _check_settable(self, reference):
        name = self.vars[reference].name
        if reference in self.output_slots:
            raise Refused(f"{name} is an output and cannot be set")
        is_fixed = reference in self.parameter_names and name not in TUNABLE
        if is_fixed and self.phase not in BEFORE_THE_RUN:
            raise Refused(f"{name} is fixed and cannot be set after initialisation")

    def _check_value(self, reference, value):
        name, (low, high, above_low) = self.vars[reference].name, self.bounds[reference]
        if not isfinite(value):
            raise Refused(f"{name} = {value:g}: must be a finite number")
        if value < low or value > high or (above_low and value == low):
            bracket = "(" if above_low else "["
            raise Refused(f"{name} = {value:g}: must lie in {bracket}{low:g}, {high:g}]")

    def _set(self, reference, value):
        if self.cells[reference] != value:
            self.stale = True
            self.retuned = self.retuned or reference in self.parameter_names
        self.cells[reference] = value
        if reference in self.input_slots:
            self.g[G_VALUE + self.input_slots[reference]] = value

    # No variable is of these types.

    @guarded("fmi2GetBoolean", ANY_PHASE, result=_zeros)
    def get_boolean(self, references):
        return self._of_none("fmi2GetBoolean", references)

    @guarded("fmi2GetString", ANY_PHASE, result=_empties)
    def get_string(self, references):
        return self._of_none("fmi2GetString", references)

    @guarded("fmi2SetBoolean", SETTABLE)
    def set_boolean(self, references, values):
        self._of_none("fmi2SetBoolean", references)

    @guarded("fmi2SetString", SETTABLE)
    def set_string(self, references, values):
        self._of_none("fmi2SetString", references)

    def _of_none(self, call, references):
        if references:
            raise Refused(f"{call}: all variables are real or integer")
        return []

    # --- state ---

    STATE = tuple(
        "cells phase failure said_to_creep has_experiment tolerance start time stepped stale "
        "retuned p g u z o".split()
    )

    @guarded("fmi2GetFMUstate", ANY_PHASE, result=dict)
    def _get_fmu_state(self):
        state = {key: getattr(self, key) for key in self.STATE}
        return {"build": BUILD} | {
            key: value.copy() if isinstance(value, list) else value for key, value in state.items()
        }

    @guarded("fmi2SetFMUstate", ANY_PHASE)
    def _set_fmu_state(self, state):
        if state.get("build") != BUILD:
            raise Refused("the state is damaged, or was taken from another build of this unit")
        for key in self.STATE:
            value = state[key]
            if isinstance(value, list):
                getattr(self, key)[:] = value
            else:
                setattr(self, key, value)

    @staticmethod
    def _fmu_state_from_bytes(state):
        # Cannot refuse: an exception here would be fatal. What is not a state has no build.
        try:
            loaded = json.loads(state.decode("utf-8"))
        except ValueError:
            loaded = None
        return loaded if isinstance(loaded, dict) else {}
