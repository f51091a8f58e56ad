"""One master on the pair; ``python host.py TOOL FOLDER STEP COUNT`` prints what came of it (JSON).

Without anything of this product, so that a tool can have an environment of its own. Seconds of
the processor are those of the steps alone; x of both follows after each step of another run.
"""

import json
import sys
import time
from pathlib import Path

SHORT, COARSE = 100, 0.01  # the run whose values are kept: 1 s


def timed(work):
    """Seconds of the processor, of all threads."""
    began = time.process_time()
    work()
    return time.process_time() - began


def in_fmpy(folder, step, count):
    from fmpy.ssp.simulation import simulate_ssp

    where = str(folder / "oscillators.ssp")
    # what is not the steps, a step apart
    once = timed(lambda: simulate_ssp(where, stop_time=0.5 * step, step_size=step))
    seconds = timed(lambda: simulate_ssp(where, stop_time=(count - 0.5) * step, step_size=step))
    rows = simulate_ssp(where, stop_time=(SHORT - 0.5) * COARSE, step_size=COARSE)
    return seconds - once, [list(rows[f"{name}.x"]) for name in ("first", "second")]


def in_libcosimpy(folder, step, count):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimObserver import CosimObserver

    def begun(size):
        return CosimExecution.from_ssp_file(str(folder / "oscillators.ssp"), round(size * 1e9))

    execution = begun(step)
    execution.step()
    seconds = timed(lambda: execution.step(count))
    execution = begun(COARSE)
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    index = {each.name.decode(): each.index for each in execution.slave_infos()}
    rows = []
    for _ in range(SHORT):
        assert execution.step()
        rows.append([observer.last_real_values(index[n], [1])[0] for n in ("first", "second")])
    return seconds, list(map(list, zip(*rows, strict=True)))


def in_ecospy(folder, step, count):
    from ecospy import EcosSimulation

    where = str(folder / "oscillators.ssp")
    with EcosSimulation(ssp_path=where, step_size=step) as simulation:
        simulation.init()
        seconds = timed(lambda: simulation.step(count))
    rows = []
    with EcosSimulation(ssp_path=where, step_size=COARSE) as simulation:
        simulation.init()
        for _ in range(SHORT):
            simulation.step()
            rows.append([simulation.get_real(f"{name}::x") for name in ("first", "second")])
    return seconds, list(map(list, zip(*rows, strict=True)))


def in_cofmupy(folder, step, count, method="gauss_seidel", iterative=False):
    from cofmupy.coordinator import Coordinator

    def end(name, variable):
        return {"type": "fmu", "id": name, "variable": variable, "unit": ""}

    config = folder / f"cofmupy_{method}_{iterative}.json"
    links = [("first", "second"), ("second", "first")]
    names = ("first", "second")
    text = {
        "fmus": [{"id": n, "name": n, "path": str(folder / f"{n}.fmu")} for n in names],
        "connections": [{"source": end(a, "x"), "target": end(b, "other")} for a, b in links],
        "cosim_method": method,
        "iterative": iterative,
        "edge_sep": " -> ",
        "root": str(folder),
    }
    config.write_text(json.dumps(text))

    def begun():
        coordinator = Coordinator()
        coordinator.start(str(config))
        return coordinator

    coordinator = begun()
    coordinator.do_step(step)

    def steps():
        for _ in range(count):
            coordinator.do_step(step)

    seconds = timed(steps)
    coordinator = begun()
    rows = []
    for _ in range(SHORT):
        coordinator.do_step(COARSE)
        rows.append([coordinator.get_variable((n, "x"))[-1] for n in names])
    return seconds, list(map(list, zip(*rows, strict=True)))


def in_cofmupy_jacobi(folder, step, count):
    return in_cofmupy(folder, step, count, "jacobi")


def in_cofmupy_iterated(folder, step, count):
    return in_cofmupy(folder, step, count, "jacobi", True)


def main():
    tool, folder, step, count = sys.argv[1:]
    count = int(count)
    seconds, values = globals()[f"in_{tool}"](Path(folder), float(step), count)
    first, second = ([float(x) for x in each] for each in values)
    print("found", json.dumps({"us": 1e6 * seconds / count, "first": first, "second": second}))


if __name__ == "__main__":
    main()
