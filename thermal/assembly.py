"""A body as a Galerkin space: everything that its temperature obeys, as small dense arrays.

The same for the block of ice and, through its thickness, for the belt, which never melts: its J is
1. The block loses height at its contact face when it melts. Its coordinate upwards is therefore
zeta = z H0/H, which runs from 0 to the height H0 at the start while the block is H = J H0 high: J,
the height ratio, is the Jacobian of the map from the mesh to the block. The unknown is U = J u, the
heat in a volume of the mesh over its capacity (u the temperature rise above the air). The ice above
sinks through the mesh towards the face, at the speed -V share (1 - zeta/H0) for a face that recedes
by V, so that the conservative form reads

    d/dt int C U v = - int (k grad_across U . grad_across v + k/J^2 U_zeta v_zeta)
                     - int_side h U v - 1/J int_top h U v
                     - V/J int C share (1 - zeta/H0) U v_zeta + load,

C the capacity of a volume. What leaves through the face has the temperature of melting, since it
melts there, and is part of the load. For v = 1 nothing but films and load remains: heat is
conserved to rounding, melting or not.

Quadratic forms are kept as factors F with F^T F the form. Rates that are sums of squares err by
rounding relative to themselves, not to the fastest rate.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

import numpy as np
from scipy.sparse import spmatrix
from skfem import BilinearForm, CellBasis, FacetBasis, LinearForm

from .arrays import Array
from .materials import Medium

Function = Callable[[Array], Array]

#: Elements whose gradients are held at a time.
_CHUNK = 1000


@dataclass(frozen=True)
class HeatSpace:
    """n trial functions on N degrees of freedom; power for amplitude 1 in W, heat in J.

    trial (N, n); capacity (n, n) J/K; factors (up to n, n) of the forms in the module's equation,
    W/K: across, upwards, side, top; sinking (n, n), W/K for V = 1 m/s; contact (n,): mean over the
    contact, K, and load of 1 W on it; heat (n,) J/K; side_air, top_air (n,) W/K. height: H0, m;
    area: of the contact, m2; whole_capacity: of the block before it melts, J/K.
    """

    trial: Array
    capacity: Array
    across: Array
    upwards: Array
    side: Array
    top: Array
    sinking: Array
    contact: Array
    heat: Array
    side_air: Array
    top_air: Array
    height: float
    area: float
    whole_capacity: float

    def factor(self, height_ratio: float) -> Array:
        """Factor (up to 4 n, n) of everything that takes heat away, at that height ratio."""
        return np.concatenate(
            (self.across, self.upwards / height_ratio, self.side, self.top / np.sqrt(height_ratio))
        )

    def air(self, height_ratio: float) -> Array:
        """Heat (n,) to the air at that height ratio, W/K."""
        return self.side_air + self.top_air / height_ratio


@dataclass(frozen=True)
class Body:
    """Finite elements of a block that stands on z = 0, its last coordinate z upwards.

    measure: weight of the volume element (1, or 2 pi r). side, top: bases of the surfaces that are
    cooled with h W/m2K, which melting makes lower (side) or only lets down (top). bottom: basis of
    the face on z = 0; share: part of it at x that touches the belt.
    """

    basis: CellBasis
    medium: Medium
    h: float
    side: FacetBasis | None
    top: FacetBasis | None
    bottom: FacetBasis
    share: Function
    measure: Function
    height: float

    def contact(self) -> tuple[Array, float]:
        """Load of 1 W/m2 on the contact (N,), and the contact's area in m2."""
        form = LinearForm(lambda v, w: self.measure(w.x) * self.share(w.x) * v)
        load = form.assemble(self.bottom)
        return load, float(load.sum())

    def capacity(self) -> spmatrix:
        """Capacity matrix, J/K."""
        return self.weighted(self.medium.capacity)

    def weighted(self, density: float | Array) -> spmatrix:
        """Integral of u v with a density, which may vary from element to element (elements, 1)."""
        form = BilinearForm(lambda u, v, w: density * self.measure(w.x) * u * v)
        return form.assemble(self.basis)

    def conduction(self) -> spmatrix:
        """Conduction and films at J = 1, W/K."""
        k, axes = self.medium.conductivity, range(self.basis.mesh.dim())
        inside = BilinearForm(
            lambda u, v, w: k * self.measure(w.x) * sum(u.grad[i] * v.grad[i] for i in axes)
        ).assemble(self.basis)
        film = BilinearForm(lambda u, v, w: self.h * self.measure(w.x) * u * v)
        return inside + sum(film.assemble(part) for part in (self.side, self.top) if part)

    def sinking(self) -> spmatrix:
        """The form of V/J in the module's equation, W/K for V = 1 m/s."""
        up = self.basis.mesh.dim() - 1

        def form(u: Any, v: Any, w: Any) -> Any:
            sinks = self.share(w.x) * (1.0 - w.x[up] / self.height)
            return -self.medium.capacity * self.measure(w.x) * sinks * u * v.grad[up]

        return BilinearForm(form).assemble(self.basis)

    def film(self, part: FacetBasis | None) -> Array:
        """Heat (N,) to the air through a part of the surface, W/K."""
        if part is None:
            return np.zeros(self.basis.N)
        found: Array = LinearForm(lambda v, w: self.h * self.measure(w.x) * v).assemble(part)
        return found

    def space(self, trial: Array) -> HeatSpace:
        """The Galerkin space of the columns of trial (N, n)."""
        capacity = self.capacity()
        load, area = self.contact()
        gradients = [partial(_slope, i) for i in range(self.basis.mesh.dim())]
        k = self.medium.conductivity
        return HeatSpace(
            trial=trial,
            capacity=trial.T @ (capacity @ trial),
            across=self._factor(self.basis, k, gradients[:-1], trial),
            upwards=self._factor(self.basis, k, gradients[-1:], trial),
            side=self._factor(self.side, self.h, [np.asarray], trial),
            top=self._factor(self.top, self.h, [np.asarray], trial),
            sinking=trial.T @ (self.sinking() @ trial),
            contact=trial.T @ (load / area),
            heat=trial.T @ np.asarray(capacity.sum(axis=0)).ravel(),
            side_air=trial.T @ self.film(self.side),
            top_air=trial.T @ self.film(self.top),
            height=self.height,
            area=area,
            whole_capacity=float(capacity.sum()),
        )

    def _factor(
        self,
        basis: CellBasis | FacetBasis | None,
        density: float | Array,
        values: Sequence[Function],
        trial: Array,
    ) -> Array:
        """R (up to n, n) with R^T R the power, W, of some values of the trial functions (N, n).

        density: of the power, for a value of 1. Few rows, as those of a film, are their own factor;
        more are made a triangle.
        """
        columns = trial.shape[1]
        factor = np.zeros((0, columns))
        if basis is None:
            return factor
        root = np.sqrt(density * self.measure(basis.global_coordinates()) * basis.dx)
        for start in range(0, len(root), _CHUNK):
            part = slice(start, start + _CHUNK)
            for value in values:
                at_points = sum(
                    np.einsum(
                        "eq,en->eqn",
                        np.broadcast_to(value(phi[0]), root.shape)[part],
                        trial[dofs[part]],
                    )
                    for phi, dofs in zip(basis.basis, basis.element_dofs, strict=True)
                )
                rows = (root[part, :, None] * at_points).reshape(-1, columns)
                factor = np.concatenate((factor, rows))
                if len(factor) > columns:
                    factor = np.asarray(np.linalg.qr(factor, mode="r"))
        return factor


def _slope(axis: int, function: Any) -> Array:
    """Of a function of the basis along an axis."""
    found: Array = function.grad[axis]
    return found
