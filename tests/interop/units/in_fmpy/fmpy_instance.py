"""A unit in fmpy, its variables addressed by their names."""

import pytest
from fmpy.fmi1 import FMICallException
from fmpy.fmi2 import fmi2Error
from fmpy_slave import Slave, fmpy_slave
from plain_start import PLAIN

SPEED = 0.15
SLIDING = {"surface_speed": SPEED, **PLAIN}


class Instance(Slave):
    """One of the block's units."""

    @property
    def is_python(self):
        return "pythonfmu" in self.description.generationTool

    def initialise(self, start=0.0, tolerance=None, **values):
        self.begin(start, tolerance, **{**SLIDING, **values})

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


def instance(fmu, directory, logging=True):
    directory.mkdir(exist_ok=True)
    return fmpy_slave(fmu, directory, logging, Instance)


def refused(call, *arguments, **values):
    """The call must return fmi2Error."""
    with pytest.raises(FMICallException) as caught:
        call(*arguments, **values)
    assert caught.value.status == fmi2Error
