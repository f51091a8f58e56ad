"""What the C of the mechanical unit looks up: its variables, and its words for what is refused."""

import math
from collections.abc import Iterable, Mapping, Sequence
from string import Formatter

from stickslip.catalogue import Catalogue
from stickslip.contradictions import COMPUTABLE
from stickslip.words import WHY_NOT

from cosim.fmu.exchange import INDICATORS, local_slots, state_references, states
from cosim.fmu.variables import OWN, WATCHED, Variable, by_array, names

#: What the kernel knows nothing of.
UNIT_ALONE = [each.name for each in (*WATCHED, *OWN)]
MADE = "/* Made by the build from the declarations in Python. */\n"


def count_lines(variables: Sequence[Variable], guid: str, can: Mapping[str, bool]) -> list[str]:
    """How many variables there are, where each kind begins, the unit's GUID, and what it can.

    can: HAS_EXCHANGE: model exchange; TAKES_RATES: of inputs; BEGINS_WITH_INPUTS: those that are
    set behind the initialisation, before the first step, count as if they had been there before.
    """
    first, lines = 0, []
    for causality in ("input", "output", "parameter", "local"):
        count = len(names(variables, causality))
        lines.append(f"#define FIRST_{causality.upper()} {first}")
        lines.append(f"#define {causality.upper()}_COUNT {count}")
        first += count
    lines += [f"#define VARIABLE_COUNT {first}", f'#define UNIT_GUID "{guid}"']
    return [*lines, *(f"#define {name} {int(value)}" for name, value in can.items()), ""]


def table_lines(variables: Sequence[Variable]) -> list[str]:
    """The table of the variables, as unit.h declares it."""
    rows = [
        f"    {_row(variable, 0 if place else len(elements))},"
        for elements in by_array(variables)
        for place, variable in enumerate(elements)
    ]
    includes = ["#include <math.h>", "", '#include "unit.h"', ""]
    nominals = [_number(each.nominal or 1.0) for each in variables if each.causality == "input"]
    return [
        *includes,
        *("const Variable VARIABLES[VARIABLE_COUNT] = {", *rows, "};"),
        *(f"const double INPUT_NOMINALS[] = {{{', '.join(nominals)}}};", ""),
    ]


def guarded(name: str, lines: Iterable[str]) -> str:
    """A header with these lines."""
    header = [MADE, f"#ifndef {name}", f"#define {name}", "", *lines, "", "#endif", ""]
    return hidden("\n".join(header))


def hidden(header: str) -> str:
    """A header of whose names a library shows none, however it is compiled: see instance.h."""
    pragma = "#if defined(__GNUC__)\n#pragma GCC visibility {}\n#endif\n"
    return f"{pragma.format('push(hidden)')}\n{header}\n{pragma.format('pop')}"


def variables_header(variables: Sequence[Variable], guid: str, catalogue: Catalogue) -> str:
    """How many variables there are, where each kind begins, and the unit's GUID."""
    can = dict.fromkeys(("HAS_EXCHANGE", "TAKES_RATES", "BEGINS_WITH_INPUTS"), True)
    places = {each.name: place for place, each in enumerate(variables)}
    lines = [
        *count_lines(variables, guid, can),
        *(f"#define {_constant(each)} {places[each]}" for each in UNIT_ALONE),
        f"#define WATCHED_COUNT {len(WATCHED)}",
        f"#define STATE_COUNT {len(states(catalogue))}",
        f"#define INDICATOR_COUNT {INDICATORS}",
    ]
    return guarded("VARIABLES_H", lines)


def variables_source(variables: Sequence[Variable], catalogue: Catalogue) -> str:
    """The table of the variables, and where the kernel keeps what they show."""
    kernel = catalogue.kernel
    slots = [
        str(getattr(kernel, each.slot))
        for each in variables
        if each.causality == "output" and each.slot
    ]
    return "\n".join(
        [
            MADE,
            *table_lines(variables),
            _whole_numbers("OUTPUT_SLOTS", slots),
            _whole_numbers("LOCAL_SLOTS", map(str, local_slots(variables, catalogue))),
            _whole_numbers("STATE_REFERENCES", map(str, state_references(variables, catalogue))),
            _whole_numbers("DRAW_SEED", (f"{seed:g}" for seed in kernel.DRAW_SEED)),
            _whole_numbers("DRAW_UNIFORM", (f"{kind:g}" for kind in kernel.DRAW_UNIFORM)),
            "",
        ]
    )


def _constant(name: str) -> str:
    """As C has a constant: ``BELT_WIDTH`` of ``belt.width``."""
    return name.replace(".", "_").upper()


def _whole_numbers(name: str, numbers: Iterable[str]) -> str:
    return f"const int {name}[] = {{{', '.join(numbers)}}};"


def _row(variable: Variable, elements: int) -> str:
    low = -math.inf if variable.min is None else variable.min
    high = math.inf if variable.max is None else variable.max
    said = f"{variable.type.upper()}_TYPE, {str(variable.is_tunable).lower()}"
    numbers = ", ".join(_number(value) for value in (variable.start or 0.0, low, high))
    above = str(variable.above_min).lower()
    kind = variable.causality.upper()
    return f"{{{quoted(variable.name)}, {kind}, {said}, {numbers}, {above}, {elements}}}"


def _number(value: float) -> str:
    if math.isinf(value):
        return "INFINITY" if value > 0 else "-INFINITY"
    return repr(float(value))


def sentences_source(contradictions: Mapping[int, str], places: Mapping[str, int]) -> str:
    """Sentences for what is refused, as words.h declares them.

    contradictions : code -> sentence, in which ``{table.parameter:g}`` stands for a value
    places : where in ``v`` each parameter is
    """
    why = (f"    [{status}] = {quoted(text)}," for status, text in WHY_NOT.items())
    said = (f"    [{code}] = {_sentence(text, places)}," for code, text in contradictions.items())
    return "\n".join(
        [
            *(MADE, '#include "words.h"', ""),
            *("const char *const WHY_NOT[] = {", *why, "};"),
            *("const Sentence CONTRADICTIONS[] = {", *said, "};"),
            *(f"const char COMPUTABLE[] = {quoted(COMPUTABLE)};", ""),
        ]
    )


def _sentence(text: str, places: Mapping[str, int]) -> str:
    """A sentence with places for values, as printf takes it, and where the values are."""
    form, values = "", []
    for literal, field, _, _ in Formatter().parse(text):
        form += literal.replace("%", "%%") + ("" if field is None else "%g")
        values += [] if field is None else [str(places[field])]
    return f"{{{quoted(form)}, {{{', '.join(values or '0')}}}}}"


def quoted(text: str) -> str:
    """A text as C has it, ASCII."""
    escaped = text.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return '"' + escaped.encode("ascii").decode() + '"'
