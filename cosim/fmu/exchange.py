"""What model exchange adds to the variables of StickSlip3DOF: continuous states and their rates.

They are local variables behind all others, so that no value reference moves. A state that is an
output has no second variable.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from stickslip.catalogue import CATALOGUE, Catalogue
from stickslip.kernel import layout, tables
from stickslip.units import UNITS

from cosim.fmu.variables import DECLARED, Variable
from cosim.fmu.variables import variables as variables_without

#: Event indicators of the kernel.
INDICATORS = layout.INDICATORS
#: Slot of a state -> what the unit calls it.
BRISTLES: Mapping[str, str] = DECLARED["bristles"]
RATE_UNITS = {"m/s": "m/s2", "rad/s": "rad/s2", "J": "W", "s": "1"}


def states(catalogue: Catalogue = CATALOGUE) -> list[Variable]:
    """The continuous states in the order of the kernel, which is that of FMI's vector of states."""
    outputs = {
        variable.slot.removeprefix("O_"): variable
        for variable in variables_without(catalogue)
        if variable.causality == "output"
    }
    found = []
    for slot in _slots(catalogue):
        if slot in outputs:
            found.append(replace(outputs[slot], is_state=True))
        elif slot in BRISTLES:
            name = f"bristles.{slot.lower()}"
            found.append(Variable(name, "local", BRISTLES[slot], "m", 1e-4, is_state=True))
        else:
            found.append(_memory(slot, catalogue))
    return found


def variables(catalogue: Catalogue = CATALOGUE) -> list[Variable]:
    """All of the native unit: those of every unit, then states that are no outputs, then rates."""
    every = states(catalogue)
    outputs = {state.name: state for state in every if state.causality == "output"}
    return [
        *(outputs.get(variable.name, variable) for variable in variables_without(catalogue)),
        *(state for state in every if state.causality == "local"),
        *(_rate(state) for state in every),
    ]


def local_slots(declared: Sequence[Variable], catalogue: Catalogue) -> list[int]:
    """Where each local variable is in the kernel's states followed by their rates."""
    names = [state.name for state in states(catalogue)]
    places = {name: place for place, name in enumerate([*names, *(f"der({n})" for n in names)])}
    return [places[each.name] for each in declared if each.causality == "local"]


def state_references(declared: Sequence[Variable], catalogue: Catalogue) -> list[int]:
    """Value reference of each continuous state."""
    names = [variable.name for variable in declared]
    return [names.index(state.name) for state in states(catalogue)]


def _slots(catalogue: Catalogue) -> list[str]:
    """Names of the states in an instant of the kernel, in order; time stands before them."""
    names = [name for name, _ in tables.instant(catalogue.effects)]
    return [*names[1 : catalogue.kernel.STATES + 1], "SLIP_TIME"]


def _memory(slot: str, catalogue: Catalogue) -> Variable:
    """What an effect remembers."""
    for effect in catalogue.effects:
        for state in effect.states:
            if slot == f"{effect.id}_{state.name}".upper():
                name, of = f"{effect.id}.{state.name}", state.name.replace("_", " ")
                said = f"What {effect.id} remembers: {of}"
                return Variable(name, "local", said, state.unit, 1.0, is_state=True)
    raise ValueError(f"the kernel's state {slot} has no variable")


def _rate(state: Variable) -> Variable:
    of_state = state.unit or "1"
    unit = RATE_UNITS.get(of_state, f"{of_state}/s")
    if unit not in UNITS:
        raise ValueError(f"the rate of {state.name} is in {unit!r}, a unit that UNITS lacks")
    name = f"der({state.name})"
    return Variable(name, "local", f"Rate of {state.name}", unit, derivative_of=state.name)
