"""The command `stickslip`: arguments, calls, and what becomes of their errors.

Exit status: 0 done; 2 bad input, refused in one line before anything is computed; 1 a run that
failed or was interrupted, of which everything computed is on disk. What a command computes with is
imported when its arguments are known, so that help is quick; Ctrl-C waits for the end of imports,
which do not survive it.
"""

import os
import sys
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from errno import EBADF, EIO, ENAMETOOLONG, ENOSPC
from typing import TextIO

from cosim.files import OutputError
from cosim.interrupts import held_interrupts, interruptible

DONE, FAILED, BAD_INPUT = 0, 1, 2

#: What BLAS reads once, when numpy is imported.
_BLAS_THREADS = ("OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")


#: Standard output that takes nothing: a full disk or device, one that is broken, or not for this.
_REFUSED = (ENOSPC, EIO, EBADF)
#: Characters of an error that are shown, half of them from its end, which says what is allowed.
_SHOWN = 2000
_CLOSED = "standard output: is closed, allowed is a file, a pipe, or >/dev/null for none"


class BadInput(ValueError):
    """What was given cannot be used; one line: file, key, what is wrong, what is allowed."""


class Failed(RuntimeError):
    """A run that failed before its first step; one line: who, why."""


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line; the exit status.

    argv: sys.argv when left out, in a process that ends with this command.
    """
    _one_blas_thread()
    with interruptible(ending=argv is None):
        return _guarded(sys.argv[1:] if argv is None else argv)


def _one_blas_thread() -> None:
    """BLAS computes in the thread that calls it, unless the environment says otherwise.

    The matrices here gain nothing from more, and its threads wait for each other without sleeping:
    two runs at once on the same cores would take fifty times as long as one.
    """
    for name in _BLAS_THREADS:
        os.environ.setdefault(name, "1")


def _guarded(argv: Sequence[str]) -> int:
    """The exit status, whatever happens."""
    debug = "--debug" in argv
    if sys.stdout is None:
        return _give_up(BadInput(_CLOSED), BAD_INPUT, debug)
    try:
        with held_interrupts():
            from cosim.cli.arguments import command_module, parser
            from cosim.cli.console import saying

            arguments = parser(argv).parse_args(argv)
            command = command_module(arguments.command)
        with saying(arguments.quiet, arguments.verbose), warnings_in_one_line():
            done: int = command.execute(arguments)
        sys.stdout.flush()
        return done
    except KeyboardInterrupt as error:
        return _give_up(error, FAILED, debug, "interrupted before there was a result")
    except BrokenPipeError:
        _silence(sys.stdout)  # whoever read our output has gone
        return FAILED
    except (OutputError, Failed) as error:
        return _give_up(error, FAILED, debug)
    except Exception as error:
        said = " ".join(str(error).split()) or type(error).__name__
        if is_bad_input(error) or _lacks_something(error):
            return _give_up(error, BAD_INPUT, debug, said)
        if isinstance(error, OSError) and error.errno == ENAMETOOLONG:  # of whoever gave the name
            text = f"{error.filename}: is too long for a file's name, allowed is a shorter one"
            return _give_up(error, BAD_INPUT, debug, text)
        if isinstance(error, OSError) and error.filename is None and error.errno in _REFUSED:
            text = f"standard output: {error.strerror}; files that were written are whole"
            _silence(sys.stdout)
            return _give_up(error, FAILED, debug, text)
        return _give_up(error, FAILED, debug, f"{said} (--debug shows where)")


def is_bad_input(error: BaseException | None) -> bool:
    """Whether an error is about what was given: those are the product's own kinds of ValueError."""
    own = type(error).__module__.startswith(("cosim.", "stickslip.", "thermal."))
    return own and isinstance(error, ValueError) and not isinstance(error, OutputError)


def _lacks_something(error: Exception) -> bool:
    """Whether an effect's file is none, or there is no compiler for what has to be compiled:
    nothing was computed."""
    from stickslip.generation.compiler import CompilerError
    from stickslip.plugins.errors import PluginError

    return isinstance(error.__cause__, (CompilerError, PluginError))


def _silence(stream: TextIO) -> None:
    """What is still to be written goes nowhere: Python would complain while it shuts down."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _give_up(error: BaseException, status: int, debug: bool, message: str = "") -> int:
    if debug:
        import traceback

        traceback.print_exception(error)
    text = message or str(error)
    if len(text) > _SHOWN:  # a name in a file can be megabytes
        text = f"{text[: _SHOWN // 2]} ... {text[-_SHOWN // 2 :]}"
    print(f"error: {text}", file=sys.stderr)
    return status


@contextmanager
def warnings_in_one_line() -> Iterator[None]:
    """Show each of our warnings once, as `warning: ...` on stderr; leave the libraries' out."""
    shown = set()

    def show(
        message: Warning | str,
        category: type[Warning],
        filename: str,
        lineno: int,
        file: TextIO | None = None,
        line: str | None = None,
    ) -> None:
        text = " ".join(str(message).split())
        if category is UserWarning and text not in shown:
            shown.add(text)
            print(f"warning: {text}", file=sys.stderr)

    with warnings.catch_warnings():
        warnings.simplefilter("always", UserWarning)
        warnings.showwarning = show
        yield
