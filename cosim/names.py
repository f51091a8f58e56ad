"""What was meant by a name that does not exist: one search for all that a user may spell wrong."""

import difflib
from collections.abc import Iterable

#: Least similarity of two spellings, 0 to 1 (Ratcliff and Obershelp), to offer one for the other.
SIMILARITY = 0.6
#: So many known names are told where none is near; more would not be read.
MOST_NAMES = 12
#: So many of a list are told, of more how many there are.
MOST_LISTED = 4


def nearest(name: str, known: Iterable[str], similarity: float = SIMILARITY) -> str | None:
    """The known name that is most like another one, None below that ``similarity``.

    >>> nearest("rig.mas", ["rig.mass", "springs.stiffness"])
    'rig.mass'
    """
    near = difflib.get_close_matches(name, list(known), n=1, cutoff=similarity)
    return near[0] if near else None


def nearest_key(key: str, keys: Iterable[str]) -> str | None:
    """The `table.key` that was meant: of that name in another table, of its table, or of any.

    >>> nearest_key("stiffness", ["rig.mass", "springs.stiffness"])
    'springs.stiffness'
    """
    keys = list(keys)
    table, _, entry = key.rpartition(".")
    ends: dict[str, str] = {}
    for known in keys:
        ends.setdefault(known.rpartition(".")[2], known)
    if entry in ends:
        return ends[entry]
    siblings = [known for known in keys if known.rpartition(".")[0] == table]
    near = nearest(key, siblings) or nearest(key, keys)
    return near or ends.get(nearest(entry, ends) or "")


def listed(names: Iterable[str]) -> str:
    """Names in a line, of many the first and how many more.

    >>> listed("abcdefg")
    'a, b, c, d and 3 more'
    """
    names = list(names)
    if len(names) <= MOST_LISTED + 1:
        return ", ".join(names)
    return f"{', '.join(names[:MOST_LISTED])} and {len(names) - MOST_LISTED} more"


def unknown_name(kind: str, name: str, known: Iterable[str]) -> str:
    """One line on a name that does not exist, with the nearest that does.

    >>> unknown_name("parameter of brake", "mas", ["mass", "length"])
    "no parameter of brake is named 'mas'; nearest: 'mass'"
    """
    known = sorted(known)
    near = nearest(name, known, similarity=0.5)
    if near:
        return f"no {kind} is named {name!r}; nearest: {near!r}"
    if len(known) > MOST_NAMES:
        known = [*known[:MOST_NAMES], "..."]
    return f"no {kind} is named {name!r}; known: {', '.join(known) or 'none'}"
