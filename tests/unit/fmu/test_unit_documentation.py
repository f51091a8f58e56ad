"""The page inside a unit: all of its variables, and the words of its version of FMI."""

import re
import zipfile
from html import unescape

import pytest
from stickslip import EFFECTS

from cosim.fmu import exchange
from cosim.fmu.description.documentation import allowed, starts
from cosim.fmu.variables import Variable

SHOWN = ("input", "output", "parameter")


@pytest.fixture(scope="module", params=["fmu", "fmu3"])
def page(request):
    """Version of FMI, and the page of that unit as text."""
    with zipfile.ZipFile(request.getfixturevalue(request.param)) as archive:
        text = archive.read("documentation/index.html").decode()
    return (3 if request.param == "fmu3" else 2), unescape(text)


def rows(page):
    """First cells of the tables of variables, as they are read."""
    cells = re.findall(r"<tr><td>(.*?)</td>", page[page.index("<h2>Inputs</h2>") :], re.DOTALL)
    return [re.sub(r"<[^>]+>", "", cell) for cell in cells]


def test_every_variable_has_a_row_and_an_array_one(page):
    fmi, text = page
    expected = {each.array or each.name for each in exchange.variables() if each.causality in SHOWN}
    found = [re.split(r"[ \[]", row.strip())[0] for row in rows(text)]
    assert sorted(found) == sorted(expected)
    table = next(row for row in rows(text) if "table_mu" in row)
    assert table == ("friction.table_mu array of 96" if fmi == 3 else "friction.table_mu[1] … [96]")


def test_the_page_speaks_of_its_own_version_of_fmi(page):
    fmi, text = page
    named = set(re.findall(r"fmi([23])[A-Z]\w+", text))
    assert named == {str(fmi)}
    assert ("event mode" in text) == (fmi == 3)


def test_every_effect_is_there_with_its_law(page):
    for effect in EFFECTS:
        assert effect.sentence in page[1] and all(said in page[1] for said in effect.law)
        assert not any("kernel" in said for said in effect.law), effect.id
    assert sum(bool(effect.law) for effect in EFFECTS) > 0.9 * len(EFFECTS)


def test_ranges_and_starts_in_words():
    def of(low, high, above=False, start=1.0):
        return Variable("a", "parameter", "m", 1.0, "", low, high, above, start)

    said = [allowed(of(*each)) for each in ((None, None), (0, None), (0, None, True), (None, 2))]
    assert said == ["", "at least 0", "above 0", "at most 2"]
    assert [allowed(of(0, 2)), allowed(of(0, 2, True))] == ["0 to 2", "above 0 to 2"]
    assert starts([of(0, 1)] * 3) == "1" and starts([of(0, 1, start=None)]) == ""
    assert starts([of(0, 1), of(0, 1, start=2.5)]) == "1, 2.5"
