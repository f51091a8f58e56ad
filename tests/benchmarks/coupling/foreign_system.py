"""A system that others wrote, run by `couple` and by other masters: how far they are apart.

    python tests/benchmarks foreign_system SYSTEM --stop T [--step H] [--with MASTER ...]

SYSTEM: an SSP file, or a folder with a SystemStructure.ssd, of co-simulation units of FMI 2.0. Each
master runs in a process of its own: what crashes is that. `jacobi`, as libcosim and ecos step: with
held inputs, and outputs read before new inputs are set. `refreshed`: the same with outputs that
follow their inputs at once, as `couple` does where nobody says otherwise. `fmpy`: a loop over
fmpy's own calls, here, with the connections as `couple` has read them.

Of every output: the largest difference to `jacobi`, as a part of its range there. Nothing is
asserted; exit status 1 where a master did not come to the end.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import fmpy
import numpy as np
from fmpy.fmi2 import FMU2Slave

MASTERS = ("jacobi", "refreshed", "gauss_seidel", "fmpy", "libcosim", "ecos")


def by_couple(system, stop, step, kind):
    """Of `couple`: times (n,), `unit.port` -> (n,)."""
    from cosim.coupling import GaussSeidel, Jacobi, run
    from cosim.systems import read_system
    from cosim.systems.assembly import assemble

    with read_system(system, {"run.stop": stop, "coupling.macro_step": step}) as specification:
        assembly = assemble(specification)
        order = assembly.order
        scheme = (
            GaussSeidel(order)
            if kind == "gauss_seidel"
            else Jacobi(order, refresh=kind == "refreshed")
        )
        with assembly.system as coupled:
            result = run(coupled, scheme, macro_step=step, start=specification.run.start, stop=stop)
            kept = {
                f"{name}.{port.name}": result[f"{name}.{port.name}"].tolist()
                for name, participant in coupled.participants.items()
                for port in participant.ports.values()
                if port.causality == "output"
            }
    if result.status != "complete":
        raise SystemExit(result.reason)
    return result.time.tolist(), kept


class Bare:
    """A unit of FMI 2.0 by fmpy's calls, one variable at a time."""

    def __init__(self, unit, start):
        self.description = fmpy.read_model_description(str(unit.file), validate=False)
        self.variables = {each.name: each for each in self.description.modelVariables}
        self.fmu = FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=fmpy.extract(str(unit.file)),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=unit.name,
        )
        self.fmu.instantiate()
        self.fmu.setupExperiment(startTime=start)
        for name, given in unit.given.items():
            self.put(name, given.value)
        self.fmu.enterInitializationMode()

    def put(self, name, value):
        """Set a variable."""
        variable = self.variables[name]
        kind = "Integer" if variable.type == "Enumeration" else variable.type
        value = float(value) if kind == "Real" else int(value)
        getattr(self.fmu, f"set{kind}")([variable.valueReference], [value])

    def got(self, name):
        """The value of a variable."""
        variable = self.variables[name]
        kind = "Integer" if variable.type == "Enumeration" else variable.type
        return float(getattr(self.fmu, f"get{kind}")([variable.valueReference])[0])


def by_fmpy(system, stop, step, kind):
    """Jacobi with held inputs, by a loop of its own."""
    from cosim.systems import read_system
    from cosim.systems.assembly import assemble

    with read_system(system, {"run.stop": stop, "coupling.macro_step": step}) as specification:
        assembly = assemble(specification)
        start = specification.run.start
        with assembly.system as coupled:
            links = [(each, coupled.conversions[each]) for each in coupled.connections]
            ports = [
                (name, port.name)
                for name, participant in coupled.participants.items()
                for port in participant.ports.values()
                if port.causality == "output"
            ]
        units = {unit.name: Bare(unit, start) for unit in specification.units}

        def exchange():
            values = [units[c.source.participant].got(c.source.port) for c, _ in links]
            for (link, convert), value in zip(links, values, strict=True):
                units[link.sink.participant].put(link.sink.port, convert(value))

        for _ in range(len(units) + 1):
            exchange()
        for unit in units.values():
            unit.fmu.exitInitializationMode()
        times, found = [], {f"{name}.{port}": [] for name, port in ports}
        for number in range(round((stop - start) / step)):
            exchange()
            for unit in units.values():
                unit.fmu.doStep(start + number * step, step)
            times.append(start + (number + 1) * step)
            for name, port in ports:
                found[f"{name}.{port}"].append(units[name].got(port))
    return times, found


def by_libcosim(system, stop, step, kind):
    """Of libcosim, by its co-simulation algorithm of fixed steps."""
    from libcosimpy.CosimEnums import CosimVariableCausality, CosimVariableType
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    execution = CosimExecution.from_ssp_file(ssp_path=str(system), step_size=round(step * 1e9))
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer=observer)
    ports = {}
    for info in execution.slave_infos():
        for variable in execution.slave_variables(info.index):
            is_real = variable.type == CosimVariableType.REAL.value
            if is_real and variable.causality == CosimVariableCausality.OUTPUT.value:
                name = f"{info.name.decode()}.{variable.name.decode()}"
                ports[name] = (info.index, variable.reference)
    times, found = [], {name: [] for name in ports}
    for number in range(1, round(stop / step) + 1):
        if not execution.step():
            raise SystemExit(f"libcosim: step {number} failed")
        times.append(number * step)
        for name, (slave, reference) in ports.items():
            found[name].append(observer.last_real_values(slave, [reference])[0])
    return times, found


def by_ecos(system, stop, step, kind):
    """Of ecos; outputs by the names that `couple` has for them."""
    from ecospy import EcosSimulation

    from cosim.systems import read_system
    from cosim.systems.assembly import assemble

    with read_system(system, {"run.stop": stop, "coupling.macro_step": step}) as specification:
        assembly = assemble(specification)
        with assembly.system as coupled:
            ports = [
                (name, port.name)
                for name, participant in coupled.participants.items()
                for port in participant.ports.values()
                if port.causality == "output"
            ]
    times, found = [], {f"{name}.{port}": [] for name, port in ports}
    with EcosSimulation(ssp_path=str(system), step_size=step) as simulation:
        simulation.init()
        for number in range(1, round(stop / step) + 1):
            simulation.step()
            times.append(number * step)
            for name, port in ports:
                found[f"{name}.{port}"].append(simulation.get_real(f"{name}::{port}"))
    return times, found


RUN = {"fmpy": by_fmpy, "libcosim": by_libcosim, "ecos": by_ecos}


def in_a_process(master, arguments):
    """What a master computes; None, and why, where it does not come to its end."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out.json"
        command = [sys.executable, __file__, str(Path(arguments.system).resolve())]
        command += ["--stop", str(arguments.stop), "--step", str(arguments.step)]
        command += ["--alone", master, "--out", str(out)]
        done = subprocess.run(command, capture_output=True, text=True, cwd=folder)
        if not out.exists():
            said = (done.stderr.strip() or f"exit status {done.returncode}").splitlines()[-1]
            print(f"{master}: {said[:200]}")
            return None
        times, found = json.loads(out.read_text())
    return np.array(times), {name: np.array(values) for name, values in found.items()}


def apart(reference, other):
    """Output -> largest difference at common times, as a part of the range of the reference."""
    times, values = reference
    where = np.searchsorted(times, other[0] - 1e-9 * times[-1])
    found = {}
    for name in sorted(values.keys() & other[1].keys()):
        mine, theirs = values[name][where], other[1][name]
        size = np.ptp(values[name]) or np.max(np.abs(values[name])) or 1.0
        found[name] = float(np.max(np.abs(mine - theirs)) / size)
    return found


def main():
    """Run all, print how far they are apart; the exit status."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("system")
    parser.add_argument("--stop", type=float, required=True)
    parser.add_argument("--step", type=float, default=1e-3)
    parser.add_argument("--with", nargs="*", default=MASTERS[1:], choices=MASTERS, dest="others")
    parser.add_argument("--alone", choices=MASTERS, help=argparse.SUPPRESS)
    parser.add_argument("--out", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.alone:
        run = RUN.get(arguments.alone, by_couple)
        found = run(arguments.system, arguments.stop, arguments.step, arguments.alone)
        Path(arguments.out).write_text(json.dumps(found))
        return 0
    reference = in_a_process("jacobi", arguments)
    if reference is None:
        return 1
    others = {master: in_a_process(master, arguments) for master in arguments.others}
    tables = {master: apart(reference, done) for master, done in others.items() if done}
    width = max(map(len, reference[1]), default=0)
    print(" " * width, *(f"{master:>13}" for master in tables))
    for name in sorted(reference[1]):
        row = [
            f"{table[name]:13.2e}" if name in table else f"{'-':>13}" for table in tables.values()
        ]
        print(f"{name:{width}}", *row)
    return 0 if len(tables) == len(others) else 1


if __name__ == "__main__":
    sys.exit(main())
