"""The study's column: every number stands in the study's text, in the section that is named."""

import re

import pytest

from cosim.studies.reproduction.claim import STUDY, Printed

SECTION = re.compile(r"§(\d+(?:\.\d+)+)")
HEADING = re.compile(r"^(\d+(?:\.\d+)+)\.?\s", re.MULTILINE)


@pytest.fixture(scope="module")
def study_text(shared) -> str:
    return shared("thesis.txt").read_text(encoding="utf-8")


def numbers(one: Printed) -> list[str]:
    """The digits to look for, without sign: of a range both of its ends."""
    if isinstance(one.value, float):
        return [f"{abs(one.value):.10g}"]
    return re.findall(r"\d+", one.value) or [one.value]


def section(text: str, name: str) -> str:
    """The text from a section's heading to the next one that is not within it."""
    if name == "executive summary":
        return text[text.index("Executive Summary") : text.index("Chapter 1")]
    headings = [(m.group(1), m.start()) for m in HEADING.finditer(text)]
    begin = next(start for number, start in headings if number == name)
    after = (
        start
        for number, start in headings
        if start > begin and not number.startswith(name) and number[0] == name[0]
    )
    return text[begin : next(after, len(text))]


@pytest.mark.parametrize("one", STUDY.values(), ids=STUDY)
def test_the_number_is_printed_where_it_is_said_to_be(one, study_text):
    assert SECTION.search(one.place) or one.place == "executive summary"
    for name in SECTION.findall(one.place) or [one.place]:
        inside = section(study_text, name)
        for number in numbers(one):
            # 0.0698 may stand there as 0.06980, but not as part of another number
            assert re.search(rf"(?<![\d.]){re.escape(number)}0*(?![\d])", inside), (number, name)
