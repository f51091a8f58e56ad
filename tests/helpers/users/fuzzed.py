"""Scenarios and campaigns that nobody would write, and what must hold of each answer.

Whatever is given, the command ends in time with exit status 0, 1 or 2; it shows no traceback and no
library's inside; a status other than 0 has said why in one line. Status 0 means that what came out
is made of numbers.
"""

import contextlib
import json
import math
import operator
import re
import warnings
from unittest import mock

import numpy as np
import pandas as pd
import tomli_w
from command_line import stickslip_here
from hypothesis import strategies as st

from cosim.gap.data.campaign_file import CampaignTable, RunTable
from cosim.scenario import Scenario
from cosim.scenario.validation import known_keys

#: What only a library says.
INSIDE = re.compile(
    r"Traceback|ndarray|numpy|scipy|sklearn|pydantic|pandas|savgol|window_length|array with"
    r"|broadcast|ufunc|dtype|unhashable|NoneType|object has no|object is not|index \d+ is out"
    r"|out of bounds for|not enough values|unpack|list index|KeyError|float division|math domain"
    r"|cannot convert|convert float|singular matrix|Matrix is singular|SVD did not|infs or NaNs"
    r"|positional argument|positive definite|setting an array|Unable to allocate|MemoryError"
    r"|zero-size|must be real number|Result too large|Numerical result|overflow|Tokenizing"
    r"|Input should be|validation error|DTD|Errno",
    re.IGNORECASE,
)
EXTREME = [
    0, -1, 1, 2, 1e-300, 5e-324, 1e-30, 1e-12, 1e-6, 1e-3, 0.1, 0.5, 3.0, 10.0, 1e3, 1e6, 1e9, 1e12,
    1e30, 1e154, 1e300, -1e-9, -0.5, -1e300, math.inf, -math.inf, math.nan, 2**31, 2**63, 10**400,
]  # fmt: skip
RUBBISH = st.recursive(
    st.one_of(
        st.sampled_from(EXTREME),
        st.booleans(),
        st.text(max_size=8),
        st.sampled_from(["", "disc", "ring", "slab", "belt", "nan", "\x00", "../x", "a" * 300]),
        st.dates(),
        st.floats(),
        st.integers(-(10**6), 10**6),
    ),
    lambda inner: st.one_of(
        st.lists(inner, max_size=5), st.dictionaries(st.text(max_size=5), inner, max_size=3)
    ),
    max_leaves=8,
)
NUMBERS = st.one_of(st.sampled_from(EXTREME), st.floats(1e-4, 1e4), st.floats(0.0, 1.0))


BOUNDS = {"gt": operator.gt, "ge": operator.ge, "lt": operator.lt, "le": operator.le}


def _keys(model):
    return sorted(key for key in known_keys(model) if "." in key)


def _values(field, wild):
    """What the key is made for; if wild, numbers at the ends of its range, beyond, or rubbish."""
    default = field.get_default()
    near = [default, default] if not isinstance(default, (int, float)) else []
    if isinstance(default, float) and math.isfinite(default):
        near = [default, 0.5 * default, 2.0 * default]
        extra = field.json_schema_extra
        near += list(extra.get("typical") or ()) if isinstance(extra, dict) else []
    if isinstance(default, int) and not isinstance(default, bool):
        near = [default, default + 1]
    near = [list(value) if isinstance(value, tuple) else value for value in near]
    sensible = st.sampled_from(near) if near else NUMBERS
    if not wild:
        return sensible
    within = [value for value in EXTREME if _is_within(value, field)]
    edge = st.sampled_from(within) if within and isinstance(default, float) else sensible
    return st.one_of(edge, edge, edge, NUMBERS, RUBBISH)


def _is_within(value, field):
    """Whether a number keeps the bounds that a field states."""
    for bound in field.metadata:
        for name, holds in BOUNDS.items():
            if getattr(bound, name, None) is not None and not holds(value, getattr(bound, name)):
                return False
    return abs(value) < math.inf


class Wildness:
    """Decides what of a case is wild: nothing in some cases, one thing in most, much in a few."""

    def __init__(self, draw, chances=(0, 1, 1, 2, 4)):
        self._draw = draw
        self._chance = draw(st.sampled_from(chances))

    def __call__(self):
        """Whether the next thing is."""
        return self._draw(st.integers(0, 9)) < self._chance

    def of(self, usual, wild):
        """One of the usual values, or of the wild ones."""
        return self._draw(st.sampled_from(wild if self() else usual))


def _tables(draw, wild, model, keys):
    """Some keys of a model with values; now and then a key or a table that is none."""
    known = known_keys(model)
    tables = {}
    for key in draw(st.lists(st.sampled_from(_keys(model)), max_size=keys, unique=True)):
        block, _, entry = key.partition(".")
        value = draw(_values(known[key], wild()))
        if not hasattr(value, "model_dump") and not isinstance(value, list | tuple | str):
            tables.setdefault(block, {})[entry] = value
        elif wild():
            tables.setdefault(block, {})[entry] = draw(RUBBISH)
    if wild() and wild():
        tables[draw(st.sampled_from(["rig", "run", "nix", "run.x", "name"]))] = draw(RUBBISH)
    return tables


@st.composite
def scenarios(draw):
    """Tables of a scenario file; where the run says nothing, it is a short one."""
    tables = _tables(draw, Wildness(draw), Scenario, 5)
    run = tables.setdefault("run", {})
    if isinstance(run, dict):
        run.setdefault("duration", 0.05)
        run.setdefault("patience", 4.0)
    return tables


def _columns(draw, wild):
    """A track, as a tracker writes it or ill: name -> values, text among them."""
    rows = wild.of([150], [0, 1, 3, 19, 20, 21, 60])
    time = np.arange(rows) * 0.02 * wild.of([1.0], [1e-3, 1e3, 1e-12, 0.2, 5.0])
    random = np.random.default_rng(draw(st.integers(0, 99)))
    x = wild.of([1e-2, 3e-2], [1e-9, 1e-5, 1.0, 10.0, 0.0, 1e200]) * np.sin(9.0 * time)
    x = x + wild.of([2e-4], [1e-12, 0.0, 1e-2]) * random.standard_normal(rows)
    if wild():
        x = np.round(x, draw(st.integers(1, 4)))
    if wild():
        x[draw(st.integers(0, rows)) : draw(st.integers(0, rows))] = math.nan
    time = time + wild.of([0.0], [1e9, -1e3, 1e300])
    if wild():
        time[rows // 2 :] += draw(st.sampled_from([1.0, 100.0, 1e4, 1e9]))
    found = {"t": list(time), "x": list(x)}
    others = ["y", "phi", "force"]
    for name in draw(st.lists(st.sampled_from(others), max_size=2, unique=True)):
        found[name] = list(x * wild.of([0.1, 1.0], [0.0, 1e3, math.nan]))
    if wild():
        found[draw(st.sampled_from(["nix", "", "time"]))] = list(x)
    while wild() and rows:
        ill = ["", "nan", "x", "1,5", "1e400", -1e300, 1e300, 0.0, 1e9, "inf"]
        name, place = draw(st.sampled_from(sorted(found))), draw(st.integers(0, rows - 1))
        found[name][place] = draw(st.sampled_from(ill))
    return found


@st.composite
def campaigns(draw, planned=False):
    """(tables, [columns of each run's file])."""
    wild = Wildness(draw)
    tables = _tables(draw, wild, CampaignTable, 2)
    runs, files = [], []
    known = RunTable.model_fields
    settings = sorted(set(known) - {"file", "summary"})
    for _ in range(wild.of([1, 2], [0, 3])):
        run = {"mass": 0.67, "stiffness": 20.17, "surface_speed": draw(st.sampled_from([0.1, 0.2]))}
        while wild():
            key = draw(st.sampled_from(settings))
            run[key] = draw(_values(known[key], True))
        if planned:
            run.setdefault("duration", 3.0)
        elif not wild():
            run["file"] = f"run{len(files)}.csv"
            files.append(_columns(draw, wild))
        else:
            figures = st.sampled_from(["mean_x", "frequency", "slip_share", "max_rotation_deg"])
            pairs = st.lists(NUMBERS, min_size=1, max_size=3)
            run["summary"] = draw(st.dictionaries(figures, pairs, max_size=3))
        runs.append(run)
    if wild() and wild():
        runs.append(draw(RUBBISH))
    tables["run"] = runs
    return tables, files


def toml(tables):
    """As a file; None for what TOML cannot hold."""
    try:
        return tomli_w.dumps(tables)
    except (TypeError, ValueError, AttributeError):
        return None


def write_campaign(folder, tables, files):
    """The campaign's file, or None for what TOML cannot hold."""
    text = toml(tables)
    if text is None:
        return None
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "campaign.toml").write_text(text, encoding="utf-8", errors="replace")
    for number, table in enumerate(files):
        rows = [",".join(table), *(",".join(map(str, row)) for row in zip(*table.values()))]  # noqa: B905
        (folder / f"run{number}.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    return folder / "campaign.toml"


def called(*argv, figures=True):
    """Exit status and what was printed of a command in this process.

    figures: without them a run takes a tenth of the time.
    """
    with contextlib.ExitStack() as stack:
        stack.enter_context(warnings.catch_warnings())
        # whether a motion is stable is another question, which takes seconds
        stack.enter_context(mock.patch("cosim.cli.runs.running.MOST_STEPS", 2e4))
        if not figures:
            stack.enter_context(mock.patch("cosim.report.figures.plates_of", return_value=()))
            stack.enter_context(mock.patch("cosim.report.style.png", return_value=b""))
        done = stickslip_here(".", *argv)
    return done.returncode, done.stdout, done.stderr


def fault_of(status, out, err, folder=None):
    """What is wrong with a command's answer, or nothing."""
    if status not in (0, 1, 2):
        return f"exit status {status}"
    # what the user gave is shown between quotes
    said = re.sub(r'"[^"\n]*"', '""', err)
    found = INSIDE.search(said)
    if found:
        return f"a library's inside: {found[0]}"
    errors = [line for line in err.splitlines() if line.startswith("error: ")]
    if status and len(errors) != 1:
        return f"{len(errors)} lines of error with status {status}"
    if status == 2 and "allowed" not in errors[0] and not re.search(_SAYS_HOW, errors[0]):
        return "a refusal that does not say what is allowed"
    if "(--debug shows where)" in err:
        return "an error that nobody expected"
    if status == 0 and folder is not None:
        return _fault_of_numbers(folder)
    return None


#: Words of refusals that name the remedy in place of what is allowed.
_SAYS_HOW = (
    r"no such key|not TOML|is not valid: not well-formed|must|give one|leave|unknown|take a|take s"
    r"|cuts the belt|too short"
    r"|needed is|is given to an integer from|expected an|known (are|is)|known: |nearest: "
    r"|a connection (starts|ends) at|only those wit|did you mean"
    r"|is shorter|already sets|needs|beside|both given"
)


def _fault_of_numbers(folder):
    """Numbers in the results that are none."""
    table = folder / "result.csv"
    if table.exists():
        motion = pd.read_csv(table)
        for name in ("time", "x", "y", "phi", "vx", "friction_force_x"):
            if name in motion and not np.isfinite(motion[name]).all():
                return f"{name} is not finite in a complete run"
    for name in ("gap.json", "plan.json", "summary.json"):
        if (folder / name).exists():
            text = (folder / name).read_text(encoding="utf-8")
            strange: list[str] = []
            json.loads(text, parse_constant=strange.append)
            if strange:
                return f"{name} holds {strange[0]}"
    return None
