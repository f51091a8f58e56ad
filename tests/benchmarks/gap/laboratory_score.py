"""What the gap workflow says of campaigns whose answers are known, counted.

named          the hidden effects by name, and nothing else
class          a stated class, every hidden effect in it
partial        named as a part of the misfit, the hidden effects among them
none, unknown  right where they are true
wrong          a name that is not hidden and that no stated class excuses
failed         no answer

Compared with what is true are mu_k and mu_s where nothing hidden makes friction change with time,
place, speed or load, the exponent of a power of the load, the curvature of a turning surface, the
period of a ripple or a pattern, and the amounts of a camera's faults. Other laws of the laboratory
have shapes that the catalogue does not hold: their numbers have no counterpart. mu of a scattering
campaign is the mean over all runs that could be made. Rotation is compared by size: its sign is a
convention.
"""

import json
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from statistics import NormalDist
from types import SimpleNamespace
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import binomtest

KINDS = ("named", "class", "partial", "none", "unknown", "wrong", "failed")
SIZES = (0.0, 2.0, 5.0, 10.0, 20.0)  # where the size classes begin, noise units
LEVELS = (0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 0.7, 0.9)
BINS = (0.0, 0.5, 0.8, 0.9, 0.95, 0.99, 1.0)  # of stated probabilities
FAULT = "measurement."  # effects of the tracker, not of the block

# Hidden things that leave mu_k and mu_s numbers of the contact.
STEADY = {"lateral_friction", "turning_surface", "spring_hardening", "spring_misalignment",
          "structural_damping", "speed_ripple"}  # fmt: skip
# Contacts whose static friction is a number of their own, and not the peak of a curve.
WITH_STATIC = {"jump", "lugre", "elasto_plastic", "iwan"}
# Shape of a fault -> the parameter that is its amount, in the same unit.
AMOUNTS = {"scale": "scale", "clock": "clock", "rotation": "rotation", "smoothing": "smoothing",
           "rolling_shutter": "latency", "lagging": "smoothing_past"}  # fmt: skip
UNSIGNED = {"turning_surface.curvature", f"{FAULT}rotation"}
# Names of quantities in gap.json -> the laboratory's. Where every run has the same gravity, a power
# of the load is one of the mass.
SAME = {"load": "mass", "normal_force": "mass", "surface_speed": "speed", "sliding speed": "speed"}
NEAR = 0.2  # as near as an exponent has to be
SAID = ("verdict", "effects", "classes", "gap", "share", "exponents", "ladder", "remarks")


def judged(lines: Iterable[Mapping[str, Any]]) -> pd.DataFrame:
    """The last line of every campaign, with what is true of it and what kind of answer it has."""
    last = {(line["suite"], line["name"]): line for line in lines}
    rows = []
    for _, line in sorted(last.items()):
        truth, found = truth_of(line["answer"]), line["found"]
        kind = kind_of(truth, found)
        told = {key: line[key] for key in ("suite", "name", "error", "seconds", "cpu")}
        rows.append(told | {"truth": truth, "found": found, "kind": kind,
                            "right": is_right(truth, found, kind)})  # fmt: skip
    return pd.DataFrame(rows)


def truth_of(answer: Mapping[str, Any]) -> SimpleNamespace:
    """The truth of one entry of an answers.json.

    The laboratory writes `effects`, `also_right`, `out_of_catalogue`, `hidden`; other campaigns
    with answers write `effect` or `members`, and nothing more than the verdict where none is
    hidden.
    """
    verdicts = [answer["verdict"]] if isinstance(answer["verdict"], str) else answer["verdict"]
    hidden = answer.get("hidden") or ()
    return SimpleNamespace(
        verdicts=verdicts,
        effects=frozenset(answer.get("effects") or answer.get("effect") or ()),
        members=frozenset(answer.get("members") or ()),
        also_right=frozenset(answer.get("also_right") or ()),
        kind=answer.get("out_of_catalogue") or ("not told" if "unknown" in verdicts else None),
        exponents=answer.get("exponents") or {},
        hidden=hidden,
        contact=answer.get("contact") or {},
        scatter=answer.get("scatter"),
        size=min((each["size"]["size"] for each in hidden if each.get("size")), default=None),
    )


def names_of(found: Mapping[str, Any]) -> tuple[frozenset, frozenset]:
    """What is given a name; the same, and what the answer says cannot be told from it."""
    naming = found["verdict"] in ("named", "class", "partial")
    named = frozenset(found["effects"] if naming else ())
    groups = map(frozenset, found.get("classes") or ())
    return named, named.union(*(group for group in groups if group & named))


def kind_of(truth: SimpleNamespace, found: Mapping[str, Any] | None) -> str:
    """The kind of an answer, see above."""
    said = found["verdict"] if found else "failed"
    if said in ("failed", "none", "unknown"):
        return said
    wanted, (named, stated) = truth.members or truth.effects, names_of(found)
    if not wanted:
        return "partial" if said == "partial" and truth.kind else "wrong"
    if said == "named":
        exact = not truth.members and named - truth.also_right == wanted - truth.also_right
        return "named" if exact else "wrong"
    return said if wanted <= stated else "wrong"


def is_right(truth: SimpleNamespace, found: Mapping[str, Any] | None, kind: str) -> bool:
    """A right name, a class that holds what is hidden, or the right one of the other verdicts.

    A part (`partial`) of what the catalogue holds whole is no right answer, even with the name.
    """
    if truth.effects or truth.members:
        return kind in ("named", "class")
    return found is not None and kind != "wrong" and found["verdict"] in truth.verdicts


def share(holds: Iterable[bool]) -> str:
    """A part with its exact 95 % interval (Clopper and Pearson, Biometrika 26, 1934)."""
    answers = [bool(each) for each in holds]
    if not answers:
        return "–"
    test = binomtest(sum(answers), len(answers))
    low, high = (100.0 * end for end in test.proportion_ci(0.95, method="exact"))
    counted = f"{test.k} of {test.n} = {100 * test.k / test.n:.1f} %"
    return f"{counted} ({low:.0f} to {high:.0f})"


def true_values(truth: SimpleNamespace) -> Iterator[tuple[str, float, float]]:
    """Key, true value, how far that may be off: of all parameters that mean the same in both."""
    if truth.contact and truth.kind is None and truth.effects <= STEADY:
        yield "friction.mu_k", float(truth.contact["mu_k"]), 0.0
        if truth.contact["form"] in WITH_STATIC:
            yield "friction.mu_s", float(truth.contact["mu_s"]), 0.0
    for hidden in truth.hidden:
        name, shape, law = hidden["name"], hidden["shape"], hidden["law"]
        if name == "load_dependence" and shape == "power":
            yield "load_dependence.exponent", float(hidden["strength"]), 0.0
        if name == "turning_surface" and shape == "abreast":
            yield "turning_surface.curvature", float(hidden["strength"]), 0.0
        if name == "speed_ripple" and (match := re.search(r"([\d.]+) Hz$", law)):
            yield "speed_ripple.frequency", *rounded(match[1])
        if name == "surface_pattern" and (match := re.search(r"every ([\d.]+) m", law)):
            yield "surface_pattern.wavelength", *rounded(match[1])
        if name.startswith(FAULT) and shape in AMOUNTS:
            yield FAULT + AMOUNTS[shape], float(hidden["strength"]), 0.0


def rounded(text: str) -> tuple[float, float]:
    """A number written with three digits, and how far the unwritten one may be from it."""
    value = float(text)
    return value, 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - 2)


def distances(rows: pd.DataFrame) -> pd.DataFrame:
    """Parameters of right answers that can be compared: key, off by how many of their deviations"""
    found = []
    for row in rows[rows["right"]].itertuples():
        if row.found["verdict"] == "unknown":
            continue
        fitted = row.found.get("extended") or {}
        values, deviations = fitted.get("parameters") or {}, fitted.get("sd") or {}
        for key, true, slack in true_values(row.truth):
            sd = deviations.get(key)
            if key not in values or sd is None or key in fitted.get("at_bound", ()):
                continue
            value = float(values[key])
            if key in UNSIGNED:
                value, true = abs(value), abs(true)
            off = max(abs(true - value) - slack, 0.0)
            found.append((key, off / sd if sd > 0.0 else math.inf))
    return pd.DataFrame(found, columns=["key", "off"])


def inside(level: float) -> float:
    """Standard deviations either side of a normal estimate in an interval of that level."""
    return NormalDist().inv_cdf(0.5 + level / 2)


def exponents_are_near(row: Any) -> bool:
    """Whether every power of mass and speed that is not nought is stated as it is, and no other.

    The true ones are beside the law as it is written: a share of mu, a force in N, heat in J;
    gap.json has the whole power and that of the catalogue's law.
    """
    stated: dict[str, dict[str, float]] = {}
    for each in (row.found or {}).get("exponents") or ():
        quantity = SAME.get(each["quantity"], each["quantity"])
        more = float(each["value"]) - float(each["catalogue"])
        stated.setdefault(each["effect"], {})[quantity] = more
    return all(
        abs(row.truth.exponents.get(effect, {}).get(quantity, 0.0) - said.get(quantity, 0.0))
        <= NEAR
        for effect in row.truth.effects
        for said in [stated.get(effect, {})]
        for quantity in {*row.truth.exponents.get(effect, {}), *said}
    )


def listing(rows: pd.DataFrame) -> str:
    """Every answer that is wrong, or right with a wrong power: what is true, and what was said."""
    parts = []
    for row in rows.itertuples():
        if row.right and (not row.truth.exponents or exponents_are_near(row)):
            continue
        said = {key: row.found.get(key) for key in SAID} if row.found else {"error": row.error}
        ranking = (row.found or {}).get("ranking", [])
        said |= {"first": ranking[:3], "places": [each["effect"] for each in ranking]}
        both = {"true": vars(row.truth), "said": said}
        text = json.dumps(both, indent=1, ensure_ascii=False, default=sorted)
        head = f"{row.suite} {row.name}: {row.kind}, {row.seconds:.0f} s"
        parts.append(f"## {head}\n```json\n{text}\n```\n")
    return "\n".join([f"# {len(parts)} of {len(rows)} campaigns not answered right\n", *parts])


def table(head: Sequence[str], lines: Iterable[Sequence[object]]) -> str:
    """A Markdown table."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(str(cell) for cell in row) + " |" for row in rows) + "\n"


def by(head: str, names: pd.Series, rows: pd.DataFrame) -> str:
    """Right answers, and how many of each kind, of all rows of one name; None: not counted."""
    lines = []
    for name, some in rows.groupby(names, sort=False):
        counts = some["kind"].value_counts()
        lines.append((name, share(some["right"]), *(counts.get(kind, "") for kind in KINDS)))
    return table((head, "right", *KINDS), lines)


def parameters(off: pd.DataFrame) -> str:
    """Coverage of 90 % intervals by parameter, and the estimates' distances."""
    groups = [*off.groupby("key"), ("all", off)]
    lines = [(key, share(some["off"] <= inside(0.9)), f"{some['off'].median():.2f}")
             for key, some in groups]  # fmt: skip
    return table(("parameter", "90% interval holds the truth", "median distance / sd"), lines)


def names_wrong(rows: pd.DataFrame) -> Iterator[tuple[str, str]]:
    """Mean stated probability of a lone name to be wrong, and how often it was; bin by bin."""
    stated = []
    for row in rows.itertuples():
        named = names_of(row.found)[0] if row.found and row.found["verdict"] == "named" else ()
        for each in row.found.get("ranking") or () if len(named) == 1 else ():
            if each["effect"] in named:
                stated.append((float(each["probability"]), row.kind != "named"))
                break
    for low, high in zip(BINS, BINS[1:], strict=False):
        some = [each for each in stated if low <= each[0] < high or each[0] == high == 1.0]
        if some:
            yield f"{1.0 - np.mean([p for p, _ in some]):.3f}", share(wrong for _, wrong in some)


def times(rows: pd.DataFrame) -> str:
    """Seconds of an answer."""
    lines, there = [], rows[rows["found"].notna()]
    for suite, some in [*there.groupby("suite", sort=False), ("all", there)]:
        figures = [*np.percentile(some["seconds"], (50, 95)), *np.percentile(some["cpu"], (50, 95))]
        lines.append((suite, len(some), *(f"{figure:.1f}" for figure in figures)))
    head = ("suite", "answers", "wall, median / s", "wall, 95 % / s", "processor, median / s")
    return table((*head, "processor, 95 % / s"), lines)


def markdown(rows: pd.DataFrame, title: str) -> str:
    """All tables on a page."""
    off, truth = distances(rows), rows["truth"]
    hidden = truth.map(
        lambda t: " + ".join(sorted(t.effects or t.members) or [t.kind or "nothing"])
    )
    sizes = truth.map(lambda t: t.size)
    sizes = sizes.dropna().map(lambda s: f"from {max(edge for edge in SIZES if edge <= s):g}")
    by_size = rows.loc[sizes.index].iloc[np.argsort([truth[i].size for i in sizes.index])]
    missed = [(f"{level:g}", share(off["off"] > inside(1.0 - level))) for level in LEVELS]
    parts = {
        "Kinds of answers": by("suite", rows["suite"], rows),
        "By what is hidden": by("hidden", hidden, rows.loc[hidden.sort_values().index]),
        "By size": by("size / noise", sizes, by_size),
        "By contact": by("contact", truth.map(lambda t: t.contact.get("form")), rows),
        "Parameters of right answers": parameters(off),
        "Intervals of right answers": table(("1 - level", "miss the truth"), missed),
        "Lone names": table(("stated probability to be wrong", "wrong"), names_wrong(rows)),
        "Time of an answer, each on one core": times(rows),
    }
    return f"# {title}\n\n" + "\n".join(f"## {head}\n{text}" for head, text in parts.items())
