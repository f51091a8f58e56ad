"""Stick is judged by a part of the spring force: the study counts one spring of four.

The load that a stick takes is compared with mu_s N after it was multiplied by the ratio.
"""

from ...quantity import Table, quantity
from ..effect import Case, Effect


class StickStiffness(Table):
    """Stick is judged by a part of the spring force: the study counts one spring of four.

    ratio : part of the load that stick is judged by: 1 all, 0.25 the study
    """

    ratio: float = quantity(1.0, "1", gt=0, le=1, typical=(0.25, 0.75))


EFFECT = Effect(
    id="stick_stiffness",
    table=StickStiffness,
    switch=("ratio",),
    enters="contact",
    source="a fault of the source study: one spring instead of four in stick",
    # the search for the break-away (`kernel.rest`) scales the load with it
    core={"ratio": "STICK_RATIO"},
    case=Case({"ratio": 0.25}),
)
