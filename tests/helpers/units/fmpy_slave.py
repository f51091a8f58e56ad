"""A unit for co-simulation as fmpy has it: unpacked, instantiated, and freed at the end."""

from contextlib import contextmanager

import fmpy
from fmpy.fmi2 import FMU2Slave

from cosim.coupling.fmu.log import FmuLog


@contextmanager
def fmpy_slave(fmu, directory, logging=True):
    """Model description, slave and log of an instance of FMI 2.0."""
    description = fmpy.read_model_description(fmu)
    folder = fmpy.extract(fmu, unzipdir=directory)
    log = FmuLog()
    slave = FMU2Slave(
        guid=description.guid,
        unzipDirectory=str(folder),
        modelIdentifier=description.coSimulation.modelIdentifier,
    )
    slave.instantiate(callbacks=log.callbacks, loggingOn=logging)
    try:
        yield description, slave, log
    finally:
        slave.freeInstance()
        log.close()
