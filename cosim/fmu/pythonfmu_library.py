"""Four corrections to pythonfmu's native library, each a matter of a few constants.

A refused step (src/pythonfmu/fmi2.cpp, `fmi2DoStep`). A slave that answers False to `do_step` ends
in these two statements, and no answer at all gives fmi2Error:

    component->wantsToTerminate = true;
    return fmi2Discard;

fmi2Discard means that a part of the step was made, and that the slave wants to end the simulation:
a host may stop there without calling it a failure, and fmpy does. An exception instead gives
fmi2Fatal and destroys the instance. So the constants become `false` and `fmi2Error`.

A refused end of initialisation (src/pythonfmu/fmi2.cpp, `fmi2ExitInitializationMode`). An exception
of the slave ends in the first of two handlers,

    } catch (const pythonfmu::fatal_error& e) { logger->log(fmi2Fatal, e.what()); return fmi2Fatal;
    } catch (const std::exception& e) { logger->log(fmi2Error, e.what()); return fmi2Error; }

and is made to leave by the end of the second, without a message: the slave has logged its own, and
keeps the instance that the library lets go of (`unit_slave`).

The end of the process (src/pythonfmu/PySlaveInstance.cpp, `finalizePythonInterpreter`, Linux). The
function sets the static pointer `pyState` to null when the library goes. Where the library stays
loaded until the process ends, the pointer has been destroyed by then, and freed memory is written
to; now and then the process ends with "corrupted double-linked list" and status 134. As the
pointer's own destructor does all that is needed, the function returns at once.

Logging (src/pythonfmu/fmi2.cpp, `fmi2Instantiate` and `fmi2SetDebugLogging`). Where a host has not
switched logging on, the library drops every message, also the error that says why a call was
refused, why there is no instance, or that it could not return as a status. What is kept as the
host's wish, `loggingOn != 0`, becomes `true`; the unit says little that is no error.
"""

import warnings
from typing import Any

from stickslip.packaged import packaged_tables

#: First bytes of a library of Linux, of Windows.
ELF, DLL = b"\x7fELF", b"MZ"
SYSTEMS = {"linux": ELF, "windows": DLL, "": b""}


def corrections() -> list[dict[str, Any]]:
    """Those of `pythonfmu.toml`, in its order: machine code (x86-64) that occurs once in the
    libraries it is meant for, and its successor, in hex."""
    found: list[dict[str, Any]] = packaged_tables(__package__, "pythonfmu.toml")["correction"]
    return found


def corrected(library: bytes) -> bytes:
    """The library with all corrections.

    Code that is not found exactly once is left as it is, with a warning that says what is lost.
    """
    for each in corrections():
        if not library.startswith(SYSTEMS[each.get("system", "")]):
            continue
        found, put = bytes.fromhex(each["found"]), bytes.fromhex(each["put"])
        if library.count(found) == 1:
            library = library.replace(found, put)
        else:
            warnings.warn(
                f"this version of pythonfmu is not known: the FMU {each['loss']}", stacklevel=2
            )
    return library
