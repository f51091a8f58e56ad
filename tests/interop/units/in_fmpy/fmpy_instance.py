"""A unit in fmpy, its variables addressed by their names."""

from contextlib import contextmanager

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error
from fmpy_slave import fmpy_slave
from plain_start import PLAIN

SPEED = 0.15
SLIDING = {"surface_speed": SPEED, **PLAIN}


class Instance:
    """One FMU instance, addressed by variable names."""

    def __init__(self, description, slave, log):
        self.description, self.slave, self.log = description, slave, log
        self.variables = {v.name: v for v in description.modelVariables}
        self.is_python = "pythonfmu" in description.generationTool

    def get(self, name):
        variable = self.variables[name]
        get = getattr(self.slave, f"get{variable.type}")
        return get([variable.valueReference])[0]

    def set(self, name, value):
        variable = self.variables[name]
        call = getattr(self.slave, f"set{variable.type}")
        call([variable.valueReference], [value])

    def initialise(self, start=0.0, tolerance=None, **values):
        for name, value in {**SLIDING, **values}.items():
            self.set(name, value)
        self.slave.setupExperiment(startTime=start, tolerance=tolerance)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def march(self, first, steps, size):
        for n in range(first, first + steps):
            self.slave.doStep(n * size, size)

    def everything(self):
        return [float(self.get(name)).hex() for name in self.variables]

    def refuses(self, call, *arguments, **values):
        """The call is refused; the reason, from the log.

        Of the Python unit's calls only a step and the end of initialisation return an error, also
        where another one failed before.
        """
        ends = (self.slave.exitInitializationMode, self.initialise)
        if self.is_python and call not in (self.slave.doStep, *ends):
            call(*arguments, **values)
        else:
            refused(call, *arguments, **values)
        return self.log.take_errors()


@contextmanager
def instance(fmu, directory, logging=True):
    directory.mkdir(exist_ok=True)
    with fmpy_slave(fmu, directory, logging) as made:
        yield Instance(*made)


def refused(call, *arguments, **values):
    """The call must return fmi2Error."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments, **values)
    assert caught.value.status == fmi2Error
