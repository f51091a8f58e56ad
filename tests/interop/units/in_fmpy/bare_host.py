"""A host with nothing but ctypes, and with numpy out of reach: what an FMU sees in a foreign tool.

    python bare_host.py EXTRACTED_FMU LIBRARY GUID REFERENCE STEP COUNT

Runs COUNT communication steps with the belt at 0.15 m/s and prints the variable of that value
reference, the statuses, and whether numpy was imported.
"""

import sys
from ctypes import (
    CDLL,
    CFUNCTYPE,
    POINTER,
    Structure,
    byref,
    c_char_p,
    c_double,
    c_int,
    c_size_t,
    c_uint,
    c_void_p,
)
from importlib.abc import MetaPathFinder
from pathlib import Path

LOGGER = CFUNCTYPE(None, c_void_p, c_char_p, c_int, c_char_p, c_char_p)


class Callbacks(Structure):
    _fields_ = [
        ("logger", LOGGER),
        ("allocate", c_void_p),
        ("free", c_void_p),
        ("step_finished", c_void_p),
        ("environment", c_void_p),
    ]


class NoNumpy(MetaPathFinder):
    """Any import of numpy fails, as where it is not installed."""

    def find_spec(self, name, path=None, target=None):
        if name.partition(".")[0] == "numpy":
            raise ModuleNotFoundError(f"no module named {name!r}", name=name)
        return None


def say(environment, instance, status, category, message):
    print(f"status {status}: {message.decode()}", file=sys.stderr)


def main(folder, library, guid, reference, step, count):
    sys.meta_path.insert(0, NoNumpy())
    fmi = CDLL(library)
    fmi.fmi2Instantiate.restype = c_void_p
    callbacks = Callbacks(logger=LOGGER(say))
    resources = (Path(folder) / "resources").as_uri().encode()
    slave = c_void_p(
        fmi.fmi2Instantiate(b"bare", 1, guid.encode(), resources, byref(callbacks), 0, 1)
    )
    fmi.fmi2SetupExperiment.argtypes = [c_void_p, c_int, c_double, c_double, c_int, c_double]
    fmi.fmi2DoStep.argtypes = [c_void_p, c_double, c_double, c_int]
    fmi.fmi2SetReal.argtypes = [c_void_p, POINTER(c_uint), c_size_t, POINTER(c_double)]
    fmi.fmi2GetReal.argtypes = fmi.fmi2SetReal.argtypes
    speed, x, value = c_uint(0), c_uint(reference), c_double(0.15)
    statuses = [
        fmi.fmi2SetupExperiment(slave, 0, 0.0, 0.0, 0, 0.0),
        fmi.fmi2EnterInitializationMode(slave),
        fmi.fmi2SetReal(slave, byref(speed), 1, byref(value)),
        fmi.fmi2ExitInitializationMode(slave),
    ]
    statuses += [fmi.fmi2DoStep(slave, n * step, step, 1) for n in range(count)]
    statuses.append(fmi.fmi2GetReal(slave, byref(x), 1, byref(value)))
    statuses.append(fmi.fmi2Terminate(slave))
    fmi.fmi2FreeInstance(slave)
    print(repr(value.value), set(statuses), "numpy" in sys.modules)


if __name__ == "__main__":
    main(*sys.argv[1:4], int(sys.argv[4]), float(sys.argv[5]), int(sys.argv[6]))
