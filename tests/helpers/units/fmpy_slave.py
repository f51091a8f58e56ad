"""A unit for co-simulation as fmpy has it: unpacked, instantiated, and freed at the end."""

from contextlib import contextmanager

import fmpy
from fmpy.fmi2 import FMU2Slave

from cosim.coupling.fmu.instance import FmuLog


class Slave:
    """An instance of FMI 2.0, its variables by their names; what it logs is in `log`."""

    def __init__(self, description, slave, log):
        self.description, self.slave, self.log = description, slave, log
        self.variables = {each.name: each for each in description.modelVariables}

    def get(self, name):
        variable = self.variables[name]
        return getattr(self.slave, f"get{variable.type}")([variable.valueReference])[0]

    def set(self, name, value):
        variable = self.variables[name]
        exact = int(value) if variable.type == "Integer" else value
        getattr(self.slave, f"set{variable.type}")([variable.valueReference], [exact])

    def begin(self, start=0.0, tolerance=None, **values):
        """With start values, as far as the first step."""
        for name, value in values.items():
            self.set(name, value)
        self.slave.setupExperiment(startTime=start, tolerance=tolerance)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def march(self, first, steps, size):
        for n in range(first, first + steps):
            self.slave.doStep(n * size, size)


@contextmanager
def fmpy_slave(fmu, directory, logging=True, kind=Slave):
    """An instance in a folder."""
    description = fmpy.read_model_description(fmu)
    folder = fmpy.extract(fmu, unzipdir=directory)
    log = FmuLog()
    name = description.coSimulation.modelIdentifier
    slave = FMU2Slave(guid=description.guid, unzipDirectory=str(folder), modelIdentifier=name)
    slave.instantiate(callbacks=log.callbacks, loggingOn=logging)
    try:
        yield kind(description, slave, log)
    finally:
        slave.freeInstance()
        log.close()
