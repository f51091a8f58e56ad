"""What a case comes to: rises of belt and ice after a run and for ever, by four models."""

from __future__ import annotations

from dataclasses import dataclass

from .case import COARSENESS, CONTACT_LENGTH, Case

#: Times at constant speed at which the drift is told, s: the study's run, and with its run-up.
RUN, LONG_RUN = 20.0, 30.0
#: What the study's thermal camera tells apart, K.
CAMERA = 0.07


@dataclass(frozen=True)
class Drift:
    """Rises over the air, K, where the belt enters the contact unless said.

    study: one pass, all heat to the belt, the study's rate; single_pass: mended; run, long_run,
    steady: finite elements after 20 s, 30 s and for ever. interface_run: mean of the two faces.
    belt_share: of the friction heat of 20 s. Where the ice melts for ever, `steady_melts`.
    """

    study: float
    single_pass: float
    run: float
    long_run: float
    steady: float
    ice_run: float
    ice_long_run: float
    ice_steady: float
    interface_run: float
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
    run = sliding.until(RUN, COARSENESS)
    long_run = sliding.until(LONG_RUN, COARSENESS)
    steady = sliding.settle()
    ambient = case.ambient_degC
    return Drift(
        study=case.as_the_study().temperature_degC(case.length) - ambient,
        single_pass=case.single_pass().temperature_degC(case.length) - ambient,
        run=run.entry, long_run=long_run.entry, steady=steady.entry,
        ice_run=run.ice_face, ice_long_run=long_run.ice_face, ice_steady=steady.ice_face,
        interface_run=run.mean_interface, flash_run=run.flash_interface,
        belt_share=run.belt_share_so_far, belt_share_steady=steady.belt_share,
        steady_melts=steady.melting > 0.0)


def run_drift(case: Case) -> float:
    """Rise where the belt enters the contact after 20 s, K; 0 when nothing of it has been there."""
    if case.speed * RUN < case.length - 2.0 * CONTACT_LENGTH:
        return 0.0
    return case.sliding().until(RUN, COARSENESS).entry


def steady_drift(case: Case) -> float:
    """The same for ever."""
    return case.sliding().settle().entry
