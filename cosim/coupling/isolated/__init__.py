"""Participants in processes of their own: where one crashes or hangs, a call has failed here."""

from cosim.coupling.isolated.participant import IsolatedError, IsolatedParticipant

__all__ = ["IsolatedError", "IsolatedParticipant"]
