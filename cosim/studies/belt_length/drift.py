"""What a case comes to: rises of belt and ice after the runs and for ever, by four models."""

from __future__ import annotations

from dataclasses import dataclass

from .case import CONTACT_LENGTH, Case

#: What the study's thermal camera tells apart, K.
CAMERA = 0.07


@dataclass(frozen=True)
class Drift:
    """Rises over the air, K, where the belt enters the contact unless said.

    study: one pass, all heat to the belt, the study's rate; single_pass: mended; run, steady:
    finite elements at the end of the last run and for ever. interface_run: mean of the two faces
    then, interface_drift: what of it came at constant speed; both again on a belt that never comes
    round (endless). belt_share: of the friction heat so far. Where the ice melts for ever,
    `steady_melts`.
    """

    study: float
    single_pass: float
    run: float
    steady: float
    ice_run: float
    ice_steady: float
    interface_run: float
    interface_drift: float
    interface_run_endless: float
    interface_drift_endless: float
    flash_run: float
    belt_share: float
    belt_share_steady: float
    steady_melts: bool

    @property
    def seen_by_camera(self) -> bool:
        """Would the camera see the drift of a run?"""
        return self.run > CAMERA


def drift(case: Case) -> Drift:
    """All of it. NoSteadyState for h = 0, ParameterError for a belt that cannot be."""
    sliding = case.sliding()
    before, run = case.follow(sliding)
    steady = sliding.settle()
    endless_before, endless = _follow(endless_belt(case))
    ambient = case.ambient_degC
    return Drift(
        study=case.as_the_study().temperature_degC(case.length) - ambient,
        single_pass=case.single_pass().temperature_degC(case.length) - ambient,
        run=0.0 if never_comes_round(case) else run.entry,
        steady=steady.entry,
        ice_run=run.ice_face,
        ice_steady=steady.ice_face,
        interface_run=run.mean_interface,
        interface_drift=run.mean_interface - before.mean_interface,
        interface_run_endless=endless.mean_interface,
        interface_drift_endless=endless.mean_interface - endless_before.mean_interface,
        flash_run=run.hottest_interface,
        belt_share=run.belt_share_so_far,
        belt_share_steady=steady.belt_share,
        steady_melts=steady.melting > 0.0,
    )


def _follow(case: Case):
    return case.follow(case.sliding())


def run_drift(case: Case) -> float:
    """Rise where the belt enters the contact at the end of the last run, K."""
    return 0.0 if never_comes_round(case) else _follow(case)[1].entry


def interface_drift(case: Case) -> float:
    """Rise of the interface at constant speed in the last run, K."""
    before, after = _follow(case)
    return after.mean_interface - before.mean_interface


def steady_drift(case: Case) -> float:
    """Rise where the belt enters the contact for ever, K."""
    return case.sliding().settle().entry


def never_comes_round(case: Case) -> bool:
    """Does the contact never meet again what was heated, in all runs? The belt enters cold then."""
    belt = case.rig.belt
    elsewhere = (belt.rollers > 0 and belt.roller_rise != 0.0) or (
        belt.railing_friction > 0.0 and belt.railing_length > CONTACT_LENGTH
    )
    return case.length > _way(case) and not elsewhere


def endless_belt(case: Case) -> Case:
    """The same on a belt that never comes round."""
    return case.with_length(1.01 * _way(case))


def _way(case: Case) -> float:
    """Length that a belt must have never to come round, m."""
    heated = 2.0 * CONTACT_LENGTH + case.rig.belt.railing_length
    return case.protocol.runs * case.protocol.moving * case.speed + heated
