"""Every number of the study that ours are laid beside, and where the study prints it.

What is computed from its numbers does not belong here: a `Row` has a place of its own for it.
"""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Printed:
    """A number of the study, or a range between two of its numbers.

    place: section, then table, figure or equation. ValueError for a number without its place.
    """

    value: float | str
    place: str

    def __post_init__(self) -> None:
        if not self.place:
            raise ValueError(f"{self.value}: where does the study print it?")

    @property
    def number(self) -> float:
        """The value; TypeError where the study prints words."""
        if isinstance(self.value, str):
            raise TypeError(f"{self.value!r} ({self.place}) is no number")
        return self.value


def _at(place: str, **values: float | str) -> dict[str, Printed]:
    return {name: Printed(value, place) for name, value in values.items()}


#: K/k, by treatment and entry; what is not listed is printed as 0
MATRICES = {
    "zero": {
        (0, 0): Printed(4.0, "§4.2.2, eq. 4.16"), (2, 2): Printed(0.00117, "§4.2.2, eq. 4.16"),
    },
    "constant": {
        (0, 0): Printed(3.99878, "§4.2.2, eq. 4.17"), (0, 1): Printed(0.0698, "§4.2.2, eq. 4.17"),
        (1, 1): Printed(0.00122, "§4.2.2, eq. 4.17"), (2, 2): Printed(0.00117, "§4.2.2, eq. 4.17"),
    },
    "opposed": {
        (0, 0): Printed(3.99878, "§4.2.2, eq. 4.18"), (1, 1): Printed(0.00122, "§4.2.2, eq. 4.18"),
        (1, 2): Printed(-0.00119, "§4.2.2, eq. 4.18"),
        (2, 2): Printed(0.00117, "§4.2.2, eq. 4.18"),
    },
}  # fmt: skip
#: Temperature of the belt after one pass, degC, by its length, m
TEMPERATURES = {
    length: Printed(value, "§3.3.1, table 3.5")
    for length, value in ((1.0, -7.9435), (2.0, -7.9583), (3.0, -7.9693), (4.0, -7.9774))
}
STUDY = {
    **_at("§3.3.1, eq. 3.1", friction_force=4.1261),
    **_at("§3.3.1, eq. 3.4", rise_in_a_pass=0.0748),
    **_at("§3.3.3, §6.1", camera_mK=70.0),
    **_at("§4.3.1, fig. 4.6", rotation_sets_in="after 10"),
    **_at("§4.3.2, §4.3.3", minutes_updated="5 to 8", seconds_others="20 to 30"),
    **_at("§4.5, fig. 4.14", stiff_displacement=0.0),
    **_at("§4.6.3, fig. 4.18c", mean_x_measured=0.02, mean_x_dataset_2=0.004),
    **_at("§4.6.3", percent_in_slip="90 to 95 %"),
    **_at("§4.6.4", rotation_measured=20.0),
    **_at("§4.6.4, eq. 4.26", rotation_dataset_1=150.0, swing_dataset_1=880.0,
          rotation_dataset_2=15.0, swing_dataset_2=56.0),
    **_at("§5.1", runs_with_a_jump="three"),
    **_at("§5.4, fig. 5.11", oscillations_measured=34.0, oscillations_at_1=29.0),
    **_at("§6.2, fig. 6.4b", mean_y_measured=0.01),
    **_at("executive summary", least_mu_k=0.05, largest_mu_k=0.11),
}  # fmt: skip


def every() -> list[Printed]:
    """All of them."""
    entries = (one for matrix in MATRICES.values() for one in matrix.values())
    return [*entries, *TEMPERATURES.values(), *STUDY.values()]
