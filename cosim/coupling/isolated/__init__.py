"""Participants in processes of their own: where one crashes or hangs, a call has failed here."""

from cosim.coupling.isolated.participant import IsolatedParticipant
from cosim.coupling.isolated.process import IsolatedError

__all__ = ["IsolatedError", "IsolatedParticipant"]
