"""What of a system's table [coupling] can be refused before a unit's library is loaded, by key."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from cosim.coupling import CoupledSystem, CouplingError, FmuError
from cosim.coupling.methods import control_of, scheme_of
from cosim.coupling.tolerance import Tolerance
from cosim.systems.faults import SystemFault
from cosim.systems.specification import SystemSpecification


@contextmanager
def naming(source: str, key: str = "") -> Iterator[None]:
    """Let a fault of a system say file and key, where it does not yet."""
    try:
        yield
    except (SystemFault, CouplingError, FmuError) as fault:
        said = str(fault)
        if said.startswith(source):
            raise
        raise type(fault)(f"{source}: {key}: {said}" if key else f"{source}: {said}") from None


def check_coupling(
    specification: SystemSpecification,
    system: CoupledSystem,
    order: tuple[str, ...],
    macro_step: float,
) -> None:
    """Refuse an order, a tolerance, a bond or a step that cannot be; macro_step: s."""
    source, settings, run = specification.source, specification.coupling, specification.run
    with naming(source, "coupling.order"):
        system.check_order(order)
    with naming(source, "coupling.absolute_tolerances"):
        Tolerance(absolute=settings.absolute_tolerances).check(system)
    with naming(source, "coupling"):
        scheme = scheme_of(settings, order)
        scheme.check(system)
    is_energy = settings.step_control == "energy"
    with naming(source, "coupling.power_bonds" if is_energy else "coupling"):
        control = control_of(settings, macro_step, settings.power_bonds)
        control.begin(run.start, run.stop, scheme)
        control.check(system)
