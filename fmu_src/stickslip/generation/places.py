"""The places of the kernel at which an effect can enter, and the words its terms can take.

A term is a function of numbers in an effect's file, named by its place. Its arguments are bound by
name: a parameter of the effect, one of its derived numbers, sums or states, what another of its
terms gives, or a word: one of `WORDS`, or one of those that the place itself has. A term is left
out where all the switches among its arguments are zero; one that takes no switch, where all the
switches of its effect are. Places and words are declared in ``places.toml``.
"""

from collections.abc import Sequence
from dataclasses import dataclass

from ..packaged import packaged_tables

#: How the text spells an array of floats: one that needs no import.
ARRAY = '"float[:]"'
#: What of the words makes friction depend on the motion's past.
MEMORY = ("place", "travel", "slid")
#: Places of the local law: a term there that takes the speed makes mu_k vary over the contact.
LOCAL = ("dry_factor", "melting", "film_friction", "mixed")


@dataclass(frozen=True)
class Place:
    """Where terms enter.

    Attributes
    ----------
    name : of the terms that do
    meaning : what the terms give there, and its unit
    joins : how a term's value meets what is there: "add", "multiply", "replace" or "largest"
    so_far : word for the value that is there; only a place where terms replace it has one
    words : what the place has beside WORDS
    arrays : arrays of the kernel that the place sees: "p", or "p u w" where WORDS can be taken
    """

    name: str
    meaning: str
    joins: str
    so_far: str = ""
    words: Sequence[str] = ()
    arrays: str = "p u w"

    @property
    def local(self) -> tuple[str, ...]:
        """Words that a term takes from the place itself."""
        return (self.so_far, *self.words) if self.so_far else (*self.words,)

    @property
    def sees_motion(self) -> bool:
        """Whether `WORDS` and the effects' states can be taken."""
        return "w" in self.arrays.split()


_DECLARED = packaged_tables(__package__, "places.toml")


def _in_kernel(kind: str) -> dict[str, str]:
    """Word -> where the kernel has it."""
    return {word: told["kernel"] for word, told in _DECLARED[kind].items()}


#: Words that a term of the contact or the surface can take.
WORDS = _in_kernel("words")
#: Constants of a run, which a term of any place can take.
CONSTANTS = _in_kernel("constants")
#: At which values a word is tried, in SI units, degC.
TRIED: dict[str, Sequence[float]] = {
    word: told["tried"]
    for kind in ("words", "constants", "own")
    for word, told in _DECLARED[kind].items()
}
#: Where terms enter in the kernel; where once a run; and the two of a state.
PLACES, PACKED, (RATE, SCALE) = (
    tuple(Place(name, **told) for name, told in _DECLARED[kind].items())
    for kind in ("places", "packed", "states")
)
