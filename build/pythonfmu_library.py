"""pythonfmu's native library, made to return fmi2Error where it returns fmi2Discard.

In pythonfmu's `fmi2DoStep` (src/pythonfmu/fmi2.cpp) a slave that answers False to `do_step` ends
in these two statements, and no other answer gives fmi2Error:

    component->wantsToTerminate = true;
    return fmi2Discard;

fmi2Discard means that a part of the step was made, and that the slave wants to end the simulation:
a host may stop there without calling it a failure, and fmpy does. An exception instead gives
fmi2Fatal and destroys the instance. A slave that refuses a step needs fmi2Error, so these two
statements are given other constants: `false`, and `fmi2Error`. Nothing else is touched.
"""

import warnings

# x86-64: movb $1, 8(%rbx) ; movl $2, %eax. It occurs once in the libraries for Linux and Windows
# of pythonfmu 0.7.0, in fmi2DoStep.
DISCARD = bytes.fromhex("c6430801b802000000")
ERROR = bytes.fromhex("c6430800b803000000")


def returning_errors(library: bytes) -> bytes:
    """The library with a refused step reported as fmi2Error.

    A library in which the statements are not found exactly once is left as it is, with a warning:
    refused steps then return fmi2Discard, the message in the log is the same.
    """
    if library.count(DISCARD) != 1:
        warnings.warn(
            "this version of pythonfmu is not known: the FMU returns fmi2Discard where a step is "
            "refused, in place of fmi2Error",
            stacklevel=2,
        )
        return library
    return library.replace(DISCARD, ERROR)
