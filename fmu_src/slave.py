"""StickSlip3DOF as an FMI 2.0 co-simulation slave: a thin FMI wrapper over the kernel.

What it shares with other slaves is in `unit_slave`. The recipe that builds the FMU lays both into
the package `stickslip`, and adds `stickslip.variables` (the variables and what is known of each).
"""

from math import nan

from pythonfmu.enums import Fmi2Status
from stickslip.contradictions import contradiction
from stickslip.kernel import layout
from stickslip.kernel.advance import advance, initialise
from stickslip.kernel.motion import block_energy
from stickslip.kernel.outputs import show
from stickslip.kernel.rig.drive import lead_inputs
from stickslip.kernel.rig.springs import spring_length
from stickslip.packing import pack
from stickslip.unit_slave import Refused, UnitSlave
from stickslip.variables import BUILD, GUID, VARIABLES
from stickslip.words import WHY_NOT

#: Parameters that say what a rig bears.
LIMITS = ("turning_surface.curvature", "belt.width", "springs.longest")
FINEST_TOLERANCE = next(e["min"] for e in VARIABLES if e["name"] == "solver.tolerance")


class StickSlip3DOF(UnitSlave):
    """Block on four springs on a moving surface, with dry friction, in x, y and phi."""

    description = (
        "Stick-slip of a block on four springs on a moving surface: three degrees of freedom, "
        "dry friction, friction heat handed over as energy"
    )
    version = BUILD
    build, guid_of_build = BUILD, GUID
    KEPT = ("p", "g", "u", "z", "o")

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.declare(VARIABLES)
        by_name = {name: reference for reference, name in self.parameter_names.items()}
        self.limits = [by_name[name] for name in LIMITS]
        self.said = []  # of what the user has been warned
        self.g = [0.0] * layout.G_SIZE  # inputs as the host gives them
        self.u = [0.0] * layout.U_SIZE  # inputs as the kernel has them
        self.p = []
        self.z = [0.0] * layout.Z_SIZE
        self.w = [0.0] * layout.W_SIZE
        self.e = [0.0] * layout.E_FIRST  # no room for events: they are not logged here
        self.o = [0.0] * (layout.O_SIZE + 2)  # and behind them what no rig bears

    def begin(self):
        """From the parameters, with the inputs as they are."""
        values = self._values_by_name()
        self.p[:] = self._packed(values)
        self._take_inputs()
        self.g[layout.G_BEFORE :] = [0.0] * (layout.G_SIZE - layout.G_BEFORE)
        self.g[layout.G_FIRST] = values["input.hold"]
        self.u[:] = [0.0] * layout.U_SIZE
        self.u[: layout.GIVEN_INPUTS] = self.g[layout.G_VALUE :][: layout.GIVEN_INPUTS]
        initialise(self.p, self.z, 0.0)
        self._advance(0.0)

    def _take_inputs(self):
        for slot, value in self.given().items():
            self.g[layout.G_VALUE + slot] = value

    def _values_by_name(self):
        return {name: float(value) for name, value in self.parameters().items()}

    def _packed(self, values):
        refusal = contradiction(values)
        if refusal:
            raise Refused(refusal)
        # the host's tolerance can tighten the parameter, not loosen it
        if self.tolerance > 0.0:
            tighter = max(self.tolerance, FINEST_TOLERANCE)
            values["solver.tolerance"] = min(values["solver.tolerance"], tighter)
        return pack(values)

    def go_on(self, end, _size):
        """To a time after the start of the experiment, s."""
        self._take_inputs()
        if self.retuned:
            self._tune()
        now = self.z[layout.SHOWN + layout.TIME]
        sticks = self.z[layout.SHOWN + layout.MODE] == layout.STICK
        lead_inputs(self.g, self.u, sticks, now, end - now)
        self._advance(end)

    def _tune(self):
        """Go on with parameters that have changed in the run."""
        before = block_energy(self.p, self.z, layout.SHOWN)
        self.p[:] = self._packed(self._values_by_name())
        # A contact that is stiffer from now on holds more: whoever tunes it has put that in.
        self.z[layout.Z_ENERGY] += block_energy(self.p, self.z, layout.SHOWN) - before
        # the kernel starts afresh from here, as after a change of inputs
        self.z[layout.Z_INPUTS] = nan

    def warn(self):
        """Warn, once of each, of a surface that a stick's creep keeps up with: it would stick for
        ever; and of what no rig bears."""
        creep, speed = self.p[layout.P_PRESLIDING], abs(self.g[layout.G_VALUE + layout.U_SPEED])
        creep *= max(self.p[layout.P_MU_S], self.p[layout.P_MU_K]) * self.p[layout.P_NORMAL_FORCE]
        time = self.z[layout.SHOWN + layout.TIME]
        _, width, most = self._limits()
        if 0.0 < speed <= creep:
            self._say(
                "creep",
                f"surface_speed = {speed:g} m/s is not above friction.stick_creep = {creep:g} m/s: "
                "the contact creeps as fast as the surface and never breaks away; its mode stays 0",
            )
        if self.o[layout.O_SIZE]:
            self._say(
                "off_belt",
                f"off_belt: the block has left the belt {time:g} s after the start: its centre is "
                f"{abs(self.z[layout.SHOWN + layout.Y]):g} m aside, the edge of belt.width = "
                f"{width:g} m is at {0.5 * width:g} m; the motion from here on is none of a rig",
            )
        if self.o[layout.O_SIZE + 1]:
            self._say(
                "spring_overstretched",
                f"spring_overstretched: a spring is {self._longest_spring():g} m long {time:g} s "
                f"after the start, more than springs.longest = {most:g} times its "
                f"{self.p[layout.P_NATURAL_LENGTH]:g} m without load",
            )

    def _say(self, what, text):
        if what not in self.said:
            self.said.append(what)
            self.log(text, Fmi2Status.warning)

    def _limits(self):
        """Curvature of the surface's way, 1/m, width of the belt, m, and longest spring."""
        return (self.cells[reference] for reference in self.limits)

    def _longest_spring(self):
        return max(spring_length(self.p, self.z, layout.SHOWN, i) for i in range(4))

    def _watch(self):
        """Look whether the block is on the belt, and the springs as long as they bear."""
        curvature, width, most = self._limits()
        is_belt = curvature == 0.0 and width > 0.0
        too_long = most * self.p[layout.P_NATURAL_LENGTH]
        aside = abs(self.z[layout.SHOWN + layout.Y])
        self.o[layout.O_SIZE] = float(is_belt and aside > 0.5 * width)
        self.o[layout.O_SIZE + 1] = float(most > 0.0 and self._longest_spring() > too_long)

    def _advance(self, end):
        """On to a time after the start of the experiment, s."""
        status = advance(self.p, self.u, self.z, self.w, self.e, end)
        if status != layout.DONE:
            raise Refused(f"no way to {end:g} s after the start: {WHY_NOT[status]}")
        show(self.p, self.u, self.z, self.w, self.o, 0)
        self._watch()
        self.show(self.o)

    def keep(self):
        """Copies of the kernel's arrays, and which warnings have been given."""
        return [self.said.copy(), *(getattr(self, name).copy() for name in self.KEPT)]

    def put(self, kept):
        """Into the arrays that there are."""
        said, *arrays = kept
        self.said = list(said)
        for name, array in zip(self.KEPT, arrays, strict=True):
            getattr(self, name)[:] = array
