"""`stickslip plot`: figures of a result, as PNG files."""

from argparse import Namespace
from pathlib import Path

from cosim.cli import DONE, BadInput
from cosim.files import writable
from cosim.manifest import list_further, require_own
from cosim.report.compare.one_result import read_result
from cosim.report.figures import plates_of
from cosim.report.results import write_figures


def execute(arguments: Namespace) -> int:
    """Draw into the folder of the result; say which files."""
    folder = Path(arguments.folder)
    result = read_result(folder)
    if not result.scenario:
        raise BadInput(
            f"{folder}: the result of a system, whose figures stickslip couple --figures draws; "
            "allowed is a folder of stickslip run or simulate"
        )
    names = arguments.figures or [plate.name for plate in plates_of(result.dataset)]
    files = [f"{name}.png" for name in names]
    require_own(writable(folder), files, arguments.force)
    try:
        for path in write_figures(result.dataset, folder, names):
            print(path)
    except ValueError as error:
        raise BadInput(str(error)) from error
    list_further(folder, files)
    return DONE
