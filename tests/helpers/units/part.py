"""A participant of nothing: what a test's own have in common, so that they say what is theirs."""


class Part:
    def enter_initialisation(self, start, stop):
        """Nothing to begin from."""

    def exit_initialisation(self):
        """Nothing to finish."""

    def write(self, values):
        """No inputs."""

    def step(self, time, size):
        """Nothing that changes by itself."""

    def close(self):
        """Nothing to let go of."""


class Restorable(Part):
    """One whose state is its attributes, the simple ones; they are set anew, never changed."""

    def get_state(self):
        return vars(self).copy()

    def set_state(self, state):
        vars(self).update(state)

    def free_state(self, state):
        """Python does it."""
