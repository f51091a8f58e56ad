"""A linear system as a participant, solved exactly for inputs that are polynomials in time.

x' = A x + B u, y = C x + D u: what a coupled run of such participants is off by is the coupling
scheme's alone.
"""

from math import factorial

import numpy as np
from part import Restorable
from scipy.linalg import expm

from cosim.coupling import Waveform, inputs, outputs, port_table


class Linear(Restorable):
    """A, B, C, D: (n, n), (n, m), (k, n), (k, m); ins, outs: port name -> unit; x: state (n,)."""

    def __init__(self, name, a, b, c, d=None, *, ins, outs, x):
        self.name = name
        self.ports = port_table(inputs(**ins) + outputs(**outs))
        self.a, self.b, self.c = (np.atleast_2d(np.asarray(m, float)) for m in (a, b, c))
        self.d = np.zeros((len(outs), len(ins))) if d is None else np.atleast_2d(d)
        self.ins, self.outs = list(ins), list(outs)
        self.x = np.array(x, dtype=float)
        self.u = [Waveform((0.0,), 0.0)] * len(ins)
        self.u_now = np.zeros(len(ins))
        self._powers = {}

    def write(self, values):
        self.write_waveforms({name: Waveform((value,), 0.0) for name, value in values.items()})

    def write_waveforms(self, waveforms):
        for name, wave in waveforms.items():
            self.u[self.ins.index(name)] = wave
        self.u_now = np.array([wave.start for wave in self.u])

    def read(self):
        return dict(zip(self.outs, (self.c @ self.x + self.d @ self.u_now).tolist(), strict=True))

    def step(self, time, size):
        # x(h) = e^{Ah} x + sum_k phi_{k+1}(Ah) h^{k+1} k! B c_k for u = sum c_k t^k
        degree = max((len(wave.coefficients) for wave in self.u), default=0)
        exponential, integrals = self._integrals(size, degree)
        self.x = exponential @ self.x
        for k in range(degree):
            c = np.array([(*wave.coefficients, 0.0, 0.0, 0.0)[k] for wave in self.u])
            self.x += integrals[k] @ (self.b @ c)
        self.u_now = np.array([wave.at(size) for wave in self.u])

    def _integrals(self, size, degree):
        """e^{Ah} and the integrals of e^{A(h-t)} t^k over the step, by one exponential."""
        if (size, degree) not in self._powers:
            n = len(self.x)
            big = np.zeros((n * (degree + 1), n * (degree + 1)))
            big[:n, :n] = self.a
            for k in range(degree):
                big[n * k : n * (k + 1), n * (k + 1) : n * (k + 2)] = np.eye(n)
            power = expm(big * size)
            parts = [factorial(k) * power[:n, n * (k + 1) : n * (k + 2)] for k in range(degree)]
            self._powers[size, degree] = power[:n, :n], parts
        return self._powers[size, degree]

    def get_state(self):
        return self.x.copy(), list(self.u), self.u_now.copy()

    def set_state(self, state):
        self.x, self.u, self.u_now = state[0].copy(), list(state[1]), state[2].copy()
