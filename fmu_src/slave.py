"""StickSlip3DOF as an FMI 2.0 co-simulation slave: a thin FMI wrapper over the kernel.

It runs inside any host with a Python, so it imports the standard library and nothing else. The
recipe that builds the FMU renames this module and the package `stickslip` after their content, and
adds `stickslip.variables` (the parameters and what is known of each).

pythonfmu's library turns an exception into fmi2Fatal and leaves the instance with dangling
pointers, so nothing may be raised from here. A call that is refused is logged as an error, the
instance counts as failed from then on, and every further step returns an error that says why,
until the host resets the instance or sets a state taken before. Setters and the end of
initialisation have no way to return an error; theirs is in the log and at the next step.
"""

import functools
import json
import sys
from math import isfinite, ulp

from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Slave, Fmi2Variability, Integer, Real
from pythonfmu.enums import Fmi2Status
from stickslip.contradictions import contradiction
from stickslip.kernel.advance import advance, initialise
from stickslip.kernel.layout import (
    DONE,
    E_FIRST,
    O_SIZE,
    P_MU_K,
    P_MU_S,
    P_NORMAL_FORCE,
    P_PRESLIDING,
    P_TABLE_POINTS,
    U_SIZE,
    U_SPEED,
    W_SIZE,
    Z_SIZE,
)
from stickslip.kernel.outputs import show
from stickslip.kernel.terms import has_dry_law
from stickslip.packing import pack
from stickslip.status import WHY_NOT
from stickslip.variables import BUILD, GUID, INPUTS, OUTPUTS, PARAMETERS

# A host computes its communication points in one way or another and may miss the end of the last
# step by rounding; a gap of more than this part of a step is not rounding.
GAP = 1e-6
FINEST_TOLERANCE = next(e["min"] for e in PARAMETERS if e["name"] == "solver.tolerance")


class Refused(Exception):
    """A call that cannot be carried out; the message goes to the host's log."""


def shielded(result=None):
    """Keep every exception inside: log it, count the instance as failed, return `result`.

    That holds for a Ctrl-C too, which Python delivers into whatever runs, hence BaseException.
    """

    def wrap(call):
        @functools.wraps(call)
        def shield(self, *arguments):
            try:
                return call(self, *arguments)
            except BaseException as error:
                reason = str(error) if isinstance(error, Refused) else repr(error)
                self.fail(f"{call.__name__}: {reason}")
                return result(*arguments) if callable(result) else result

        return shield

    return wrap


def _nans(references):
    return [float("nan")] * len(references)


def _zeros(references):
    return [0] * len(references)


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
        self.input_slots, self.output_slots, self.parameter_names = {}, {}, {}
        self.u = [0.0] * U_SIZE
        self._register_ports()
        self._register_parameters()
        self.phase = "instantiated"  # then "initialising", "stepping", "terminated"
        self.failure = ""
        self.said_to_creep = False
        self.tolerance = None
        self.start = self.time = 0.0
        self.stepped = False  # before the first step all follows from parameters and inputs
        self.stale = True
        self.p = []
        self.z = [0.0] * Z_SIZE
        self.w = [0.0] * W_SIZE
        self.e = [0.0] * E_FIRST  # no room for events: they are not logged here
        self.o = [0.0] * O_SIZE

    def _register_ports(self):
        for name, slot, start in INPUTS:
            reference = self._register(Real, name, start, causality=Fmi2Causality.input)
            self.input_slots[reference] = slot
            self.u[self.input_slots[reference]] = start
        for name, slot, integer in OUTPUTS:
            more = {"variability": Fmi2Variability.discrete} if integer else {}
            more |= {"causality": Fmi2Causality.output, "initial": Fmi2Initial.calculated}
            reference = self._register(Integer if integer else Real, name, 0, **more)
            self.output_slots[reference] = slot

    def _register_parameters(self):
        fixed = {
            "causality": Fmi2Causality.parameter,
            "initial": Fmi2Initial.exact,
            "variability": Fmi2Variability.fixed,
        }
        for entry in PARAMETERS:
            kind = Integer if entry["unit"] is None else Real
            reference = self._register(kind, entry["name"], entry["start"], **fixed)
            self.parameter_names[reference] = entry["name"]

    def _register(self, kind, name, start, **more):
        reference = len(self.cells)
        self.cells.append(start)
        getter = functools.partial(self.cells.__getitem__, reference)
        self.register_variable(kind(name, getter=getter, **more), nested=False)
        return reference

    def fail(self, reason):
        """Log an error; from now on steps are refused. The first failure is the one that stays."""
        # FMI hands the message to the host as a printf format.
        self.log(reason.replace("%", "%%"), Fmi2Status.error)
        self.failure = self.failure or reason

    # --- initialisation ---

    @shielded()
    def setup_experiment(self, start_time, stop_time, tolerance):
        """The host's tolerance can tighten the parameter solver.tolerance, not loosen it."""
        if not isfinite(start_time):
            raise Refused(f"start time is {start_time}; must be a finite number of seconds")
        self.start = self.time = start_time
        self.tolerance = tolerance
        # pythonfmu's library leaves the extracted FMU at the head of the process's path for good.
        sys.path[:] = [entry for entry in sys.path if entry != self.resources]
        self.stale = True

    @shielded()
    def enter_initialization_mode(self):
        self.phase = "initialising"

    @shielded()
    def exit_initialization_mode(self):
        self.phase = "stepping"
        self._refresh()

    def _refresh(self):
        """Lay out the run afresh from parameters and inputs, as long as no step was made."""
        if self.stepped or not self.stale:
            return
        values = {name: float(self.cells[ref]) for ref, name in self.parameter_names.items()}
        self._check(values)
        if self.tolerance is not None and self.tolerance > 0.0:
            tighter = max(self.tolerance, FINEST_TOLERANCE)
            values["solver.tolerance"] = min(values["solver.tolerance"], tighter)
        self.p[:] = pack(values)
        if self.p[P_TABLE_POINTS] and has_dry_law(self.p):
            raise Refused(
                "friction.table_speed beside an effect with another law of the sliding speed; "
                "give one of the two"
            )
        initialise(self.p, self.z, self.start)
        self._advance(self.start)
        self.stale = False

    def _check(self, values):
        for entry in PARAMETERS:
            value = values[entry["name"]]
            low, high = entry["min"], entry["max"]
            inside = (low is None or value >= low) and (high is None or value <= high)
            if not inside or (entry["above_min"] and value == low):
                bracket = "(" if entry["above_min"] else "["
                raise Refused(
                    f"{entry['name']} = {value:g}: must lie in {bracket}"
                    f"{'-inf' if low is None else low}, {'inf' if high is None else high}]"
                )
        refusal = contradiction(values)
        if refusal:
            raise Refused(refusal)

    # --- stepping ---

    @shielded(result=False)
    def do_step(self, current_time, step_size):
        if self.failure:
            raise Refused(f"failed before ({self.failure}); reset it or set an earlier state")
        if self.phase != "stepping":
            raise Refused(f"a step while the instance is {self.phase}")
        self._check_step(current_time, step_size)
        self._refresh()
        before = self.z.copy(), self.o.copy(), self.cells.copy()
        try:
            self._advance(current_time + step_size)
        except BaseException:
            self.z[:], self.o[:], self.cells[:] = before
            raise
        self.time = current_time + step_size
        self.stepped = True
        self._say_if_creeping()
        return True

    def _say_if_creeping(self):
        """Warn, once, of a surface that a stick's creep keeps up with: it would stick for ever."""
        creep, speed = self.p[P_PRESLIDING], abs(self.u[U_SPEED])
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
            raise Refused(f"step from t = {time} of size {size}: must be finite numbers")
        if size <= 0.0:
            raise Refused(f"step size is {size:g} s; must be greater than 0")
        if abs(time - self.time) > GAP * size + 4.0 * ulp(self.time):
            raise Refused(
                f"step begins at t = {time!r} s, the last one ended at t = {self.time!r} s"
            )

    def _advance(self, end):
        status = advance(self.p, self.u, self.z, self.w, self.e, end)
        if status != DONE:
            raise Refused(f"no way from t = {self.time:g} s to {end:g} s: {WHY_NOT[status]}")
        show(self.p, self.u, self.z, self.w, self.o, 0)
        for reference, slot in self.output_slots.items():
            self.cells[reference] = self.o[slot]

    @shielded()
    def terminate(self):
        self.phase = "terminated"

    # --- values ---

    @shielded(result=_nans)
    def get_real(self, references):
        return [float(value) for value in self._values(references)]

    @shielded(result=_zeros)
    def get_integer(self, references):
        return [int(value) for value in self._values(references)]

    def _values(self, references):
        if self.stale and not self.stepped and any(r in self.output_slots for r in references):
            self._refresh()
        return [self.cells[reference] for reference in references]

    @shielded()
    def set_real(self, references, values):
        for reference, value in zip(references, values, strict=True):
            self._set(reference, value)

    @shielded()
    def set_integer(self, references, values):
        self.set_real(references, values)

    def _set(self, reference, value):
        name = self.vars[reference].name
        if not isfinite(value):
            raise Refused(f"{name} = {value}: must be a finite number")
        if reference in self.input_slots:
            self.u[self.input_slots[reference]] = value
        elif reference not in self.parameter_names:
            raise Refused(f"{name} is an output and cannot be set")
        elif self.phase not in ("instantiated", "initialising"):
            raise Refused(f"{name} is fixed and cannot be set after initialisation")
        self.cells[reference] = value
        self.stale = True

    # --- state ---

    STATE = tuple("cells phase failure tolerance start time stepped stale p u z o".split())

    @shielded(result=dict)
    def _get_fmu_state(self):
        state = {key: getattr(self, key) for key in self.STATE}
        return {"build": BUILD} | {
            key: value.copy() if isinstance(value, list) else value for key, value in state.items()
        }

    @shielded()
    def _set_fmu_state(self, state):
        if state.get("build") != BUILD:
            raise Refused("the state is damaged or was taken from another build of this FMU")
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
