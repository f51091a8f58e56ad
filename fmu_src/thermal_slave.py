"""BeltIceThermal as an FMI 2.0 co-simulation slave: the finite-element model of belt and ice.

It needs the package `thermal` in the host's Python. The recipe that builds the FMU lays this module
and `unit_slave` into a package, with `variables` (the variables and what is known of each).

Inputs are held over a step: the heat is heat_flow times the step or, as soon as the running total
heat has ever changed, what that has risen by; and the belt runs on below the block by surface_speed
times the step less what x has changed since the last one.
"""

import json

from beltice.unit_slave import Refused, UnitSlave
from beltice.variables import BUILD, GUID, VARIABLES

from thermal import BeltIceModel, ThermalParameters

# A change of a total that is rounding, as a part of the total.
ROUNDING = 1e-12
# Most internal steps that melting may make of one.
MOST_PARTS = 1e5


class BeltIceThermal(UnitSlave):
    """Temperature of a belt and of the ice that stands on it."""

    description = "Temperature of a belt and of a block of ice that stands on it"
    version = BUILD
    build, guid_of_build = BUILD, GUID
    begins_with_inputs = False  # x of the beginning is that from which the block moves
    slack = 1e-6

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.declare(VARIABLES)
        self.model = self.fresh = self.made_of = None
        # heat (J), travel of the belt (m) and x (m): in all, and as far as the model has them
        self.now = self.taken = [0.0, 0.0, 0.0]
        # the input `heat` as it was last, and whether it counts in place of heat_flow
        self.total, self.follows_total = 0.0, False

    def begin(self):
        """Belt and ice at the temperature of the air, the block where the host has put it."""
        values = self.parameters()
        if values != self.made_of:
            self.model = self._model_of(values)
            self.fresh, self.made_of = self.model.state(), values
        self.model.restore(self.fresh)
        self.now = self.taken = [0.0, 0.0, self.given()["x"]]
        self.total, self.follows_total = self.given()["heat"], False
        self.show(self._outputs())

    def _outputs(self):
        """Those of the model, and the balance of the heat."""
        ledger = self.model.ledger
        return self.model.outputs() | {"heat_stored": ledger.stored, "heat_to_air": ledger.lost}

    def _model_of(self, values):
        tables = {}
        for name, value in values.items():
            table, _, key = name.partition(".")
            tables.setdefault(table, {})[key] = value
        try:
            return BeltIceModel(ThermalParameters.checked(tables))
        except (ValueError, ArithmeticError) as error:
            raise Refused(str(error)) from None

    def go_on(self, end, size):
        """By `size`, s: the model knows no time."""
        given = self.given()
        heat, travel, _ = self.now
        railed = given["surface_speed"] * size
        now = [heat + self._brought(given, size), travel + railed, given["x"]]
        added = now[0] - self.taken[0]
        if added < -ROUNDING * abs(now[0]):
            raise Refused(
                f"heat = {self.total:.15g} J: has fallen by {-added:g} J; must not fall, as it is "
                "the running total of what friction produces"
            )
        added = max(added, 0.0)
        if not self.model.meltwater.ablation.parts(min(added, 1e300)) <= MOST_PARTS:
            raise Refused(
                f"heat or heat_flow gives {added:g} J in one step, more than melts the block many "
                "times over: take shorter steps"
            )
        slid = (now[1] - self.taken[1]) - (now[2] - self.taken[2])
        sticks = abs(slid) <= ROUNDING * (abs(now[1]) + abs(now[2]))
        try:
            # in stick as it is, the sign of rounding would tell the belt to run backwards
            self.model.step(size, added, 0.0 if sticks else slid, railed)
        except (ValueError, ArithmeticError, RuntimeError) as error:
            raise Refused(str(error)) from None
        taken = [max(now[0], self.taken[0]), *now[1:]]
        if sticks:
            taken[1:] = self.taken[1:]
        self.now, self.taken = now, taken
        self.show(self._outputs())

    def _brought(self, given, size):
        """Heat that a step of the host brings, J."""
        before, self.total = self.total, given["heat"]
        self.follows_total = self.follows_total or self.total != before
        return self.total - before if self.follows_total else given["heat_flow"] * size

    def keep(self):
        """The model's state, and what has crossed the ports."""
        state = None if self.model is None else self.model.state()
        return [state, self.now, self.taken, self.total, self.follows_total, self.made_of]

    def put(self, kept):
        """Into a model of the same parameters, made anew where it was of others."""
        state, self.now, self.taken, self.total, self.follows_total, made_of = kept
        if made_of is None:
            self.made_of = None  # to be made before it is asked
            return
        if made_of != self.made_of:
            self.model = self._model_of(made_of)
            self.fresh, self.made_of = self.model.state(), made_of
        self.model.restore(state)

    @staticmethod
    def _fmu_state_to_bytes(state):
        return json.dumps(state, default=lambda array: array.tolist()).encode("utf-8")
