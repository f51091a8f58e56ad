"""What can go wrong in a coupled run."""


class CouplingError(ValueError):
    """The coupling as described cannot work: a port, a unit, a causality, an order, a step."""


class FmuError(ValueError):
    """A file is not an FMU that can be used here, or a value given to it is refused."""


class ParticipantError(RuntimeError):
    """A participant failed while it was being initialised or stepped.

    participant: its name; time: the macro step's start in s (None: before the first step).
    """

    def __init__(self, participant: str, time: float | None, message: str):
        when = "during initialisation" if time is None else f"in the step from t = {time:.9g} s"
        super().__init__(f"{participant}: failed {when}: {message}")
        self.participant = participant
        self.time = time
