"""The faults of a camera by name: their numbers, units and meanings."""

from __future__ import annotations

#: Beginning of every key of a fault's number.
PREFIX = "measurement."

#: Place along x over which a rolling shutter's delay is stated, m.
ACROSS = 0.1

#: Fault -> what it does, a sentence.
SENTENCES = {
    "measurement.scale": "The camera's scale is off",
    "measurement.clock": "The camera's clock is off",
    "measurement.rotation": "The camera's axes are turned against the motion",
    "measurement.drift": "The camera's zero creeps during a run",
    "measurement.latency": "The time at which the camera sees a block depends on its place",
    "measurement.smoothing": "The tracker's filter rounds the motion",
    "measurement.quantisation": "The tracker writes steps that are coarser than its noise",
}

#: Key of a number -> unit and meaning.
QUANTITIES = {
    "measurement.scale": ("", "part by which x and y are written too large"),
    "measurement.clock": ("", "part by which times are written too long"),
    "measurement.rotation": ("rad", "angle by which the camera's axes are turned"),
    "measurement.drift_rate_x": ("m/s", "steady creep of the zero of x"),
    "measurement.drift_rate_y": ("m/s", "steady creep of the zero of y"),
    "measurement.drift_x": ("m", "creep of the zero of x once it has settled"),
    "measurement.drift_y": ("m", "creep of the zero of y once it has settled"),
    "measurement.drift_time": ("s", "time in which the zero settles"),
    "measurement.drift_log_x": ("m", "creep of the zero of x in a factor e of time"),
    "measurement.drift_log_y": ("m", "creep of the zero of y in a factor e of time"),
    "measurement.drift_log_time": ("s", "time from which on the zero creeps logarithmically"),
    "measurement.latency": ("s", f"how much later a place {ACROSS:g} m further along x is seen"),
    "measurement.smoothing": ("s", "standard deviation of the tracker's Gaussian filter"),
    "measurement.smoothing_past": ("s", "time constant of the tracker's filter of the past"),
    "measurement.quantisation": ("m", "step of the numbers that the tracker writes"),
}


def is_fault(key: str) -> bool:
    """Whether an effect, or a number, is the camera's."""
    return key.startswith(PREFIX)


def fault_of(key: str) -> str:
    """The fault that a number belongs to: `measurement.drift_x` is one of `measurement.drift`."""
    return key.partition("_")[0]
