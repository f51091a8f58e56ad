"""The page of a friction map: its figure, the regimes in words, every run."""

from __future__ import annotations

from cosim.report.page import Picture, render

from .map import FrictionMap


def page(found: FrictionMap, picture: Picture, command: str) -> str:
    """HTML of a map, its figure, and the command line that made it."""
    return render(
        "friction_map.html.j2",
        "cosim.studies.friction_map",
        name=found.scenario.name,
        speeds=len({point.speed for point in found.at(found.ambients[0])}),
        duration=found.duration,
        regimes=[found.regimes(ambient) for ambient in found.ambients],
        points=found.points,
        picture=picture,
        scenario=found.scenario.to_toml(),
        command=command,
    )
