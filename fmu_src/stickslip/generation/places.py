"""The places of the kernel at which an effect can enter, and the words its terms can take.

A term is a function of numbers in an effect's file, named by its place. Its arguments are bound by
name: a parameter of the effect, one of its derived numbers, sums or states, what another of its
terms gives, or a word: one of `WORDS`, or one of those that the place itself has. A term is left
out where all the switches among its arguments are zero; one that takes no switch, where all the
switches of its effect are.
"""

from dataclasses import dataclass

#: How the text spells an array of floats: one that needs no import.
ARRAY = '"float[:]"'
#: Words that a term of the contact or the surface can take -> where the kernel has them.
WORDS = {
    "place": "w[W_STATE + X] - w[W_STATE + TRAVEL]",  # on the surface under the block, m
    "travel": "w[W_STATE + TRAVEL]",  # of the surface since the start, m
    "slid": "w[W_STATE + DISTANCE]",  # mean sliding distance since the start, m
    "temperature": "min(u[U_TEMPERATURE], 0.0)",  # of the interface, at most melting, degC
    "film_thickness": "u[U_FILM]",  # of the water, mean over the contact, m
}
#: Constants of a run, which a term of any place can take.
CONSTANTS = {
    "mass": "p[P_MASS]",  # kg
    "normal_force": "p[P_NORMAL_FORCE]",  # N
    "radius": "p[P_RADIUS]",  # of the contact, m
    "stiffness": "p[P_STIFFNESS]",  # of one spring, N/m
    "mu_s": "p[P_MU_S]",
    "mu_k": "p[P_MU_K]",
}
#: What of these makes friction depend on the motion's past.
MEMORY = ("place", "travel", "slid")


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
    words: tuple[str, ...] = ()
    arrays: str = "p u w"

    @property
    def local(self) -> tuple[str, ...]:
        """Words that a term takes from the place itself."""
        return (self.so_far, *self.words) if self.so_far else self.words

    @property
    def sees_motion(self) -> bool:
        """Whether `WORDS` and the effects' states can be taken."""
        return "w" in self.arrays.split()


#: In the kernel, in the order in which a coefficient of friction meets them.
PLACES = (
    Place("place_variation", "friction of a place on the surface, on top of 1", "add"),
    Place("kinetic_temperature_factor", "mu_k in proportion", "multiply"),
    Place("kinetic_factor", "mu_k in proportion, by what has been", "multiply"),
    Place("static_temperature_factor", "mu_s in proportion", "multiply"),
    Place("static_factor", "mu_s in proportion, by what has been", "multiply"),
    Place("static_growth", "mu_s after ``hold`` seconds of rest, on top", "add", words=("hold",)),
    # the local law: mu_k at a local sliding speed (m/s)
    Place("dry_factor", "mu_k of the dry contact in proportion", "multiply", words=("speed",)),
    Place("melting", "friction where ice melts, made of that so far", "replace", "mu", ("speed",)),
    Place("film_friction", "coefficient of a film, on top", "add", words=("speed",)),
    Place("flooded_share", "part of the load that is not borne by the solid contact", "add"),
    Place(
        "mixed",
        "friction where a part ``flooded`` of the load is not on the solid contact",
        "replace",
        "mu",
        ("speed", "flooded"),
    ),
    # of the whole contact, at its mean sliding speed; where there is such a law, what it gives at
    # rest is also what the contact holds, and mu_s is not used
    Place("state_law", "mu_k by speed and state of the contact, on top", "add", words=("speed",)),
    Place("contact_drag", "force of the whole contact per sliding speed, N s/m", "add", arrays="p"),
    Place("surface_speed", "speed of the surface, m/s", "replace", "steady_speed", ("time",)),
    Place(
        "surface_acceleration",
        "rate of the surface's speed, m/s^2",
        "replace",
        "steady_acceleration",
        ("steady_speed", "time"),
    ),
    Place("spring_force", "force of one spring, N", "add", words=("extension",), arrays="p"),
    Place("spring_energy", "energy of one spring, J", "add", words=("extension",), arrays="p"),
)
#: Places of the local law: a term there that takes the speed makes mu_k vary over the contact.
LOCAL = ("dry_factor", "melting", "film_friction", "mixed")
#: Where terms enter once a run, when parameters become the vector ``p``.
PACKED = (
    Place("coefficient_factor", "mu_s and mu_k in proportion", "multiply"),
    Place("spring_turn", "turn of every spring about its attachment, rad", "add"),
    Place("frame_turn", "turn of all anchors about the middle of the rig, rad", "add"),
    Place("anchor_shift", "shift of every anchor along y, m", "add"),
    Place("diagonal_shift", "shift along y of anchors 1 and 4, of 2 and 3 the other way, m", "add"),
    Place("fastest_rate", "rate of the drive's fastest change, rad/s", "largest"),
)
#: Not places of terms, but where the rate and the scale of a state take their numbers.
RATE = Place("rate", "rate of a state", "replace", words=("friction_power", "speed"))  # W, m/s
SCALE = Place("scale", "what counts as much as the speed", "replace", words=("speed",), arrays="p")
