"""The compiled loop of the study's scheme, `scheme.c`: what it reads and writes."""

from collections.abc import Callable
from ctypes import CDLL, CFUNCTYPE, POINTER, Structure, addressof, byref, c_double, c_int64, memmove
from functools import cache
from typing import Any

import numpy as np

from . import scheme_code
from .scheme_options import SchemeEffects

INTERVAL = 0.01  # s, the pieces of time that the study steps through
STEPS = 99  # a block is sampled at 100 instants
STEP = INTERVAL / STEPS
STICK_STEP = 20.0 / 1999.0  # s: 2000 samples over 20 s, the study's
ROW_STEPS = 11  # a row every ninth part of a block, 1.1 ms
MOST_PHASES = 20_000
DRAWN_AT_ONCE = 50_000

STICK, SLIP = 0, 1
# how a phase ended
BROKE_AWAY, STUCK_AGAIN, CUT, OUT_OF_TIME = 0, 1, 2, 3

ROW = 10  # t, x, y, phi, x', y', phi', force, moment, mode
PHASE = 5  # begin, end, mode, how it ended, jump of x' at the end

_DOUBLES = POINTER(c_double)


def _fields(kind: Any, names: str) -> list[tuple[str, Any]]:
    return [(name, kind) for name in names.split()]


class SchemeRig(Structure):
    """Rig and friction; SI units. Scatters are standard deviations.

    covered: share of the disc's area that the strips have together
    """

    _fields_ = [  # noqa: RUF012
        *_fields(
            c_double, "mass inertia stiffness normal_force speed curvature mu_s mu_k mu_slope"
        ),
        *_fields(c_double, "mu_k_speed static_scatter force_scatter moment_scatter"),
        *_fields(c_double, "correlation_length covered reach spring_length"),
        *_fields(c_int64, "updated strip_wise seed"),
    ]


class SchemeFaults(Structure):
    """The faults as the loop reads them."""

    _fields_ = _fields(c_int64, "one_spring white on_grid stale mirrored cut lagging")


class Propagator(Structure):
    """Co, Si, P2, P3 and W Si, (3, 3) each, of an exact step."""

    _fields_ = _fields(c_double * 3 * 3, "co si p2 p3 wsi")


class _Effects(Structure):
    _fields_ = [  # noqa: RUF012
        ("on", c_int64),
        *_fields(c_double, " ".join(SchemeEffects._fields[1:])),
    ]


class _Memory(Structure):
    _fields_ = [  # noqa: RUF012
        *_fields(c_double * 3, "q v before"),
        *(("alpha", c_double * 4), ("load", c_double * 3), ("mean", c_double * 2)),
        *_fields(c_double, "side recent_heat distance friction"),
        *(("attachment", c_double * 2 * 4), ("beta", c_double * 4)),
        *_fields(_DOUBLES, "shares middles"),
        ("strips", c_int64),
        *_fields(_DOUBLES, "rows phases"),
        *_fields(c_int64, "row_count row_limit phase_count phase_limit"),
        ("normals", _DOUBLES),
        *_fields(c_int64, "drawn normal_count"),
        ("refill", CFUNCTYPE(None)),
    ]


class Motion:
    """A run of the scheme as it goes: what it begins from, and its rows and phases.

    q, v : (3,) x, y, phi and their rates at the start; alpha, beta : (4,) angles of the springs and
    of their attachments (4, 2); mean : (2,) force and moment of friction where no strip's speed
    matters; shares, middles : of the strips
    """

    def __init__(self, duration: float, seed: int, **begin: np.ndarray) -> None:
        count = int(duration / (ROW_STEPS * STEP) + duration / STICK_STEP) + 4 * MOST_PHASES
        self._rows, self._phases = np.empty((count, ROW)), np.empty((MOST_PHASES, PHASE))
        self._normals = np.empty(DRAWN_AT_ONCE)
        self._arrays = {name: np.ascontiguousarray(each, float) for name, each in begin.items()}
        generator = np.random.RandomState(seed)

        def refill() -> None:
            self._normals[:] = generator.standard_normal(DRAWN_AT_ONCE)

        self._memory = _Memory(
            side=1.0,
            strips=len(begin["shares"]),
            row_limit=count,
            phase_limit=MOST_PHASES,
            drawn=DRAWN_AT_ONCE,
            normal_count=DRAWN_AT_ONCE,
            refill=CFUNCTYPE(None)(refill),
        )
        pointed_at = {"rows": self._rows, "phases": self._phases, "normals": self._normals}
        for name, array in (self._arrays | pointed_at).items():
            place = getattr(self._memory, name)
            if isinstance(place, _DOUBLES):
                setattr(self._memory, name, array.ctypes.data_as(_DOUBLES))
            else:
                memmove(addressof(place), array.ctypes.data, array.nbytes)

    def run(
        self, rig: SchemeRig, faults: SchemeFaults, effects: SchemeEffects, *until: float
    ) -> None:
        """Stick and slip for a number of cycles or to a time, s; or slide to a time."""
        call = functions().run if len(until) == 2 else functions().slide
        given = byref(rig), byref(faults), byref(_Effects(*effects)), byref(self._memory)
        call(*given, *until)

    @property
    def rows(self) -> np.ndarray:
        """(n, ROW)"""
        return self._rows[: self._memory.row_count].copy()

    @property
    def phases(self) -> np.ndarray:
        """(k, PHASE)"""
        return self._phases[: self._memory.phase_count].copy()


@cache
def functions() -> CDLL:
    """The library's functions. Raises CompilerError where there is no compiler."""
    library = scheme_code().load()
    structures = [POINTER(each) for each in (SchemeRig, SchemeFaults, _Effects, _Memory)]
    vector, matrix = c_double * 3, c_double * 3 * 3
    heads: dict[str, list[Any]] = {
        "run": [*structures, c_int64, c_double],
        "slide": [*structures, c_double],
        "field_scatter": [c_int64, c_double, c_double, _DOUBLES],
        "propagator": [matrix, c_double, POINTER(Propagator)],
        "step": [POINTER(Propagator), c_double, *[vector] * 6],
    }
    for name, arguments in heads.items():
        function: Callable[..., None] = getattr(library, name)
        function.argtypes, function.restype = arguments, None  # type: ignore[attr-defined]
    return library
