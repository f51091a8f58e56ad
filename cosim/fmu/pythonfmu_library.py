"""Two corrections to pythonfmu's native library, each a matter of one or two constants.

A refused step (src/pythonfmu/fmi2.cpp, `fmi2DoStep`). A slave that answers False to `do_step` ends
in these two statements, and no answer at all gives fmi2Error:

    component->wantsToTerminate = true;
    return fmi2Discard;

fmi2Discard means that a part of the step was made, and that the slave wants to end the simulation:
a host may stop there without calling it a failure, and fmpy does. An exception instead gives
fmi2Fatal and destroys the instance. So the constants become `false` and `fmi2Error`.

The end of the process (src/pythonfmu/PySlaveInstance.cpp, `finalizePythonInterpreter`, Linux). The
function sets the static pointer `pyState` to null when the library goes. Where the library stays
loaded until the process ends, the pointer has been destroyed by then, and freed memory is written
to; now and then the process ends with "corrupted double-linked list" and status 134. As the
pointer's own destructor does all that is needed, the function returns at once.
"""

import warnings
from dataclasses import dataclass


@dataclass(frozen=True)
class Correction:
    """Machine code (x86-64) that occurs once in the libraries it is meant for, and its successor.

    loss: what the FMU does without it. start: first bytes of the libraries it is meant for.
    """

    found: bytes
    put: bytes
    loss: str
    start: bytes = b""


REFUSED_STEP = Correction(
    found=bytes.fromhex("c6430801 b802000000"),  # movb $1, 8(%rbx); movl $2, %eax
    put=bytes.fromhex("c6430800 b803000000"),
    loss="returns fmi2Discard, not fmi2Error, where a step is refused",
)
PROCESS_END = Correction(
    # endbr64; push %rbp; pxor %xmm0, %xmm0; push %rbx; sub $8, %rsp; mov pyState+8, %rbp;
    # movaps %xmm0, pyState; test %rbp, %rbp
    found=bytes.fromhex("f30f1efa 55 660fefc0 53 4883ec08 488b2d73640100 0f290564640100 4885ed"),
    put=bytes.fromhex("f30f1efa c3 660fefc0 53 4883ec08 488b2d73640100 0f290564640100 4885ed"),
    loss="may abort at the end of its host's process",
    start=b"\x7fELF",
)


def corrected(library: bytes) -> bytes:
    """The library with both corrections.

    Code that is not found exactly once is left as it is, with a warning that says what is lost.
    """
    for correction in (REFUSED_STEP, PROCESS_END):
        if not library.startswith(correction.start):
            continue
        if library.count(correction.found) == 1:
            library = library.replace(correction.found, correction.put)
        else:
            warnings.warn(
                f"this version of pythonfmu is not known: the FMU {correction.loss}", stacklevel=2
            )
    return library
