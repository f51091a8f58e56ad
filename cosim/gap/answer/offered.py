"""Which laws are tried on a campaign: the catalogue's and the camera's that it could tell."""

from __future__ import annotations

from stickslip.effects.candidate import Candidate

from cosim.gap.candidates.catalogue import candidates, laws_of_speed
from cosim.gap.candidates.measurement import measurement_candidates
from cosim.gap.candidates.scales import scales
from cosim.gap.evidence.settled import Settled

from .models import Bench


def offered(bench: Bench, plain: Settled) -> list[Candidate]:
    """On top of the plain model as it was settled."""
    rig = bench.campaign.rig
    extension = rig.spring_length - rig.spring_natural_length
    typical = scales(list(bench.runs), plain.values["friction.mu_k"], extension)
    effects = [law for law in candidates(typical) if _is_felt(law, bench)]
    return [*effects, *measurement_candidates(typical, bench.channels)]


def _is_felt(law: Candidate, bench: Bench) -> bool:
    """Whether the campaign could tell the law from the plain model at all."""
    if law.effect == "stick_stiffness":  # along x it is another mu_s
        return "mu_s" in bench.campaign.friction
    if bench.campaign.friction_table is not None and law.effect in laws_of_speed():
        return False
    return bench.planar or not law.lateral
