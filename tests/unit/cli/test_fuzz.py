"""Scenarios that nobody would write, the same ones each time.

Whatever is given, the command ends in time with exit status 0, 1 or 2; it shows no traceback and no
library's inside; a status other than 0 has said why in one line. Status 0 means that what came out
is made of numbers. `STICKSLIP_FUZZ=50 pytest FILE` draws fifty times as many, other ones each time.
"""

import contextlib
import json
import math
import operator
import os
import re
import shutil
import warnings
from unittest import mock

import numpy as np
import pandas as pd
import pytest
import tomli_w
from command_line import stickslip_here
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from cosim.scenario import Scenario
from cosim.scenario.validation import known_keys

MORE = int(os.environ.get("STICKSLIP_FUZZ", 1))
#: What only a library says.
INSIDE = re.compile(
    r"Traceback|ndarray|numpy|scipy|pydantic|pandas|array with|broadcast|ufunc|dtype|unhashable"
    r"|NoneType|object has no|object is not|index \d+ is out|out of bounds for|not enough values"
    r"|unpack|list index|KeyError|float division|math domain|cannot convert|convert float"
    r"|singular matrix|Matrix is singular|SVD did not|infs or NaNs|positional argument"
    r"|positive definite|setting an array|Unable to allocate|MemoryError|zero-size"
    r"|must be real number|Result too large|Numerical result|overflow|Input should be"
    r"|validation error|Errno",
    re.IGNORECASE,
)
#: Words of refusals that name the remedy in place of what is allowed.
SAYS_HOW = (
    r"allowed|no such key|not TOML|must|give one|leave|unknown|take a|take s|cuts the belt"
    r"|too short|needed is|expected an|known (are|is)|known: |nearest: |is shorter|already sets"
    r"|beside|both given"
)
EXTREME = [
    0, -1, 1, 2, 1e-300, 5e-324, 1e-30, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 3.0, 10.0, 1e3, 1e6, 1e9, 1e12,
    1e30, 1e154, 1e300, -1e-9, -0.5, -1e300, math.inf, -math.inf, math.nan, 2**31, 2**63, 10**400,
]  # fmt: skip
NUMBERS = st.one_of(st.sampled_from(EXTREME), st.floats(1e-4, 1e4), st.floats(0.0, 1.0))
WORDS = st.sampled_from(["", "disc", "ring", "slab", "belt", "nan", "\x00", "../x", "a" * 300])
RUBBISH = st.recursive(
    st.one_of(NUMBERS, WORDS, st.booleans(), st.text(max_size=8), st.dates()),
    lambda inner: st.one_of(
        st.lists(inner, max_size=5), st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=8,
)
BOUNDS = {"gt": operator.gt, "ge": operator.ge, "lt": operator.lt, "le": operator.le}
KEYS = known_keys(Scenario)


def is_within(value, field):
    """Whether a number keeps the bounds that a field states."""
    stated = (
        (holds, getattr(bound, name, None))
        for bound in field.metadata
        for name, holds in BOUNDS.items()
    )
    return abs(value) < math.inf and all(
        holds(value, limit) for holds, limit in stated if limit is not None
    )


def values(field, wild):
    """What the key is made for; if wild, numbers at the ends of its range, beyond, or rubbish."""
    default = field.get_default()
    near = [list(default) if isinstance(default, tuple) else default]
    if isinstance(default, float) and math.isfinite(default):
        near += [0.5 * default, 2.0 * default]
    elif isinstance(default, int) and not isinstance(default, bool):
        near.append(default + 1)
    sensible = st.sampled_from(near)
    if not wild:
        return sensible
    within = [value for value in EXTREME if is_within(value, field)]
    edge = st.sampled_from(within) if within and isinstance(default, float) else sensible
    return st.one_of(edge, edge, edge, NUMBERS, RUBBISH)


@st.composite
def scenarios(draw):
    """Tables of a file: nothing is wild in some, one thing in most, much in a few; short runs."""
    chance = draw(st.sampled_from((0, 1, 1, 2, 4)))

    def wild():
        return draw(st.integers(0, 9)) < chance

    tables = {}
    dotted = sorted(key for key in KEYS if "." in key)
    for key in draw(st.lists(st.sampled_from(dotted), max_size=5, unique=True)):
        table, _, entry = key.partition(".")
        value = draw(values(KEYS[key], wild()))
        if not hasattr(value, "model_dump") and not isinstance(value, list | tuple | str):
            tables.setdefault(table, {})[entry] = value
        elif wild():
            tables.setdefault(table, {})[entry] = draw(RUBBISH)
    if wild() and wild():
        tables[draw(st.sampled_from(["rig", "run", "nix", "run.x", "name"]))] = draw(RUBBISH)
    run = tables.setdefault("run", {})
    if isinstance(run, dict):
        run.setdefault("duration", 0.05)
        run.setdefault("patience", 4.0)
    return tables


def answer_of(*argv):
    """What a command says in this process; without figures, which take ten times as long."""
    with contextlib.ExitStack() as stack:
        stack.enter_context(warnings.catch_warnings())
        # whether a motion is stable is another question, which takes seconds
        stack.enter_context(mock.patch("cosim.cli.runs.running.MOST_STEPS", 2e4))
        stack.enter_context(mock.patch("cosim.report.figures.plates_of", return_value=()))
        stack.enter_context(mock.patch("cosim.report.style.png", return_value=b""))
        return stickslip_here(".", *argv)


def check(done, folder):
    assert done.returncode in (0, 1, 2)
    # what the user gave is shown between quotes
    assert not INSIDE.search(re.sub(r'"[^"\n]*"', '""', done.stderr)), done.stderr
    assert "(--debug shows where)" not in done.stderr
    errors = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
    if done.returncode:
        assert len(errors) == 1, done.stderr
        assert done.returncode == 1 or re.search(SAYS_HOW, errors[0]), errors
        return
    motion = pd.read_csv(folder / "result.csv")
    for name in ("time", "x", "y", "phi", "vx", "friction_force_x"):
        assert np.isfinite(motion[name]).all(), f"{name} is not finite in a complete run"
    strange = []
    text = (folder / "summary.json").read_text(encoding="utf-8")
    json.loads(text, parse_constant=strange.append)
    assert not strange


@pytest.fixture(scope="module")
def place(tmp_path_factory):
    return tmp_path_factory.mktemp("fuzz")


@settings(
    max_examples=20 * MORE,
    derandomize=MORE == 1,
    database=None,
    deadline=None,
    suppress_health_check=list(HealthCheck),
)
@given(tables=scenarios())
def test_any_scenario_gets_a_sensible_answer(place, tables):
    try:
        text = tomli_w.dumps(tables)
    except (TypeError, ValueError, AttributeError):  # what TOML cannot hold
        return
    (place / "case.toml").write_text(text, encoding="utf-8", errors="replace")
    shutil.rmtree(place / "out", ignore_errors=True)
    check(answer_of("simulate", place / "case.toml", "-o", place / "out"), place / "out")
