"""What a result file holds, from the tables that it is written by."""

from cosim.report.dataset import COUPLING, MECHANICAL, THERMAL
from cosim.report.figures import PLATES
from cosim.report.results import OWN_FILES

from .markdown import code, heading, table

PARTS = {
    "Of the block": MECHANICAL,
    "Of belt and ice (coupled runs)": THERMAL,
    "Of the coupling (coupled runs)": COUPLING,
}


def variables() -> str:
    """Variables of `result.nc` over time, which are the columns of `result.csv`."""
    return "".join(
        heading(3, title) + table(("variable", "unit", "is"), map(_row, part.items()))
        for title, part in PARTS.items()
    )


def _row(entry: tuple[str, tuple[str, str]]) -> tuple[str, str, str]:
    name, (unit, said) = entry
    return code(name), "" if unit == "1" else unit, said


def figures() -> str:
    """Files of data, and figures with their captions."""
    files = [(code(name), said) for name, said in OWN_FILES.items()]
    plates = [(code(f"{plate.name}.png"), plate.caption) for plate in PLATES]
    return table(("file", "holds"), [*files, *plates])
