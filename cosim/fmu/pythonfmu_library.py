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
from dataclasses import dataclass

#: First bytes of a library of Linux, of Windows.
ELF, DLL = b"\x7fELF", b"MZ"


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
FATAL_END = "returns fmi2Fatal, not fmi2Error, where the end of initialisation is refused"
REFUSED_END = (
    Correction(  # mov %rsp, %r12; mov 0x18(%rbx), %rbp; mov %rax, %rdi; call what
        found=bytes.fromhex("4989e4488b 6b184889c7 e848f7ffff"),
        put=bytes.fromhex("e99c000000 6b184889c7 e848f7ffff"),  # jmp to the end of the second
        loss=FATAL_END,
        start=ELF,
    ),
    Correction(  # the first handler's entry in the table: type, frame, code, where to go on
        found=bytes.fromhex("1712 a8d10300 50 10b90100 4c"),
        put=bytes.fromhex("1712 a8d10300 50 10b90100 7a"),
        loss=FATAL_END,
        start=DLL,
    ),
    Correction(  # mov $4, %edx; mov %rdi, %rcx; call log
        found=bytes.fromhex("ba04000000 488bcf e83102ffff"),
        put=bytes.fromhex("ba04000000 488bcf 0f1f440000"),  # nop
        loss="repeats in other words why the end of initialisation is refused",
        start=DLL,
    ),
)
PROCESS_END = Correction(
    # endbr64; push %rbp; pxor %xmm0, %xmm0; push %rbx; sub $8, %rsp; mov pyState+8, %rbp;
    # movaps %xmm0, pyState; test %rbp, %rbp
    found=bytes.fromhex("f30f1efa 55 660fefc0 53 4883ec08 488b2d73640100 0f290564640100 4885ed"),
    put=bytes.fromhex("f30f1efa c3 660fefc0 53 4883ec08 488b2d73640100 0f290564640100 4885ed"),
    loss="may abort at the end of its host's process",
    start=ELF,
)
UNHEARD = "says nothing of its errors to a host that has not switched logging on"
LOGGING = (
    Correction(  # test %eax, %eax; setne 8(%r12); call
        found=bytes.fromhex("85c0 410f95442408 e8"),
        put=bytes.fromhex("85c0 41c644240801 e8"),  # movb $1, 8(%r12)
        loss=UNHEARD,
        start=ELF,
    ),
    Correction(  # test %eax, %eax; setne 8(%rdi); add $0x30, %rdi
        found=bytes.fromhex("85c0 0f954708 4883c730"),
        put=bytes.fromhex("85c0 c6470801 4883c730"),  # movb $1, 8(%rdi)
        loss=UNHEARD,
        start=ELF,
    ),
    Correction(  # setne %al; mov 0x30(%rsp), %rbx; mov %al, 8(%rbx)
        found=bytes.fromhex("0f95c0 488b5c2430 884308"),
        put=bytes.fromhex("b00190 488b5c2430 884308"),  # mov $1, %al; nop
        loss=UNHEARD,
        start=DLL,
    ),
    Correction(  # test %r12d, %r12d; setne %al; mov %al, 8(%rcx)
        found=bytes.fromhex("4585e4 0f95c0 884108"),
        put=bytes.fromhex("4585e4 b00190 884108"),
        loss=UNHEARD,
        start=DLL,
    ),
)


def corrected(library: bytes) -> bytes:
    """The library with all corrections.

    Code that is not found exactly once is left as it is, with a warning that says what is lost.
    """
    for correction in (REFUSED_STEP, *REFUSED_END, PROCESS_END, *LOGGING):
        if not library.startswith(correction.start):
            continue
        if library.count(correction.found) == 1:
            library = library.replace(correction.found, correction.put)
        else:
            warnings.warn(
                f"this version of pythonfmu is not known: the FMU {correction.loss}", stacklevel=2
            )
    return library
