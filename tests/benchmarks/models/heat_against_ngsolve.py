"""Belt under a moving heat flux: scikit-fem and exact propagators against ngsolve.

    python tests/benchmarks heat_against_ngsolve [--json FILE]

One metre of belt, 1 mm cells, 13 nodes through the thickness, the same for both: 13 000 unknowns.
A flux of a contact's size runs along it for 2 s at 0.82 m/s. Ours has P2 elements through the
thickness and any step in time exactly; ngsolve has bilinear elements on the same nodes, sparse
Cholesky factorised once, and Crank-Nicolson or BDF2 with steps halved until its error is ours, or
falls no more. Errors are those of the contact face, root mean square over the largest, against a
belt of 24 elements and half cells in steps of 1 ms. Only the steps are timed, on one thread, in
this run; prints the ratio. Needs `pip install ngsolve`; says so, and ends, without it.
"""

import math
import os
import time

os.environ.setdefault("OMP_NUM_THREADS", "1")
os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")

import numpy as np
from baseline import Figure, arguments, write
from scipy.fft import rfft

from thermal import Belt
from thermal.belt.material_frame import CONTACT, BeltField
from thermal.contact.footprint import Footprint

SPEED, DURATION, FLUX, LENGTH, H = 0.82, 2.0, 600.0, 1.0, 15.0
ELEMENTS, CELL = 6, 1e-3
FOOTPRINT = Footprint(0.04, 0.075, 1)
#: Steps of the peer, ms, from the longest that follows the contact.
STEPS_MS = (10.0, 5.0, 2.5, 1.25, 0.625)
FALLS_NO_MORE = 0.9


def centres(count):
    """Middle of the contact at the start of each step, and its travel, m."""
    travel = -SPEED * DURATION / count
    return 0.5 + travel * np.arange(count), travel


def nodal_loads(cell, cells, centre, travel):
    """W into each node of the face for the flux, mean over a step."""
    first, loads = FOOTPRINT.loads(centre, travel, cell)
    nodal = np.zeros(cells)
    np.add.at(nodal, (first + np.arange(loads.shape[1])) % cells, FLUX * loads[0])
    return nodal


def our_belt(elements, cell):
    return BeltField(
        Belt(length=LENGTH, cell_length=cell, elements=elements, air_heat_transfer=H),
        FOOTPRINT.lane,
    )


def run_ours(belt, count):
    """Face (cells,) K at the end and seconds for the steps."""
    duration = DURATION / count
    belt.response(duration)
    places, travel = centres(count)
    began = time.perf_counter()
    for centre in places:
        load = nodal_loads(belt.cell, belt.cells, centre, travel)
        belt.advance(duration, {CONTACT: rfft(load)})
    return belt.face(), time.perf_counter() - began


def peer_setting(depth, cells):
    """ngsolve's space, mass and stiffness on the same nodes, and the face's unknowns."""
    import ngsolve as ngs
    from ngsolve.meshes import MakeStructured2DMesh

    rows = depth.size - 1
    mesh = MakeStructured2DMesh(
        quads=True,
        nx=cells,
        ny=rows,
        periodic_x=True,
        mapping=lambda x, y: (LENGTH * x, float(np.interp(y, np.arange(rows + 1) / rows, depth))),
    )
    space = ngs.Periodic(ngs.H1(mesh, order=1))
    u, v = space.TnT()
    lane, parameters = FOOTPRINT.lane, Belt()
    mass = ngs.BilinearForm(space, symmetric=True)
    mass += lane * parameters.density * parameters.heat_capacity * u * v * ngs.dx
    stiffness = ngs.BilinearForm(space, symmetric=True)
    stiffness += lane * parameters.conductivity * ngs.grad(u) * ngs.grad(v) * ngs.dx
    stiffness += lane * H * u * v * ngs.ds("bottom|top")
    mass.Assemble()
    stiffness.Assemble()
    face = np.zeros(cells, dtype=int)
    for vertex in mesh.vertices:
        x, z = vertex.point
        if z < 1e-12 and x < LENGTH - 1e-9:
            face[round(x / (LENGTH / cells))] = space.GetDofNrs(vertex)[0]
    return ngs, space, mass, stiffness, face


def run_peer(setting, count, scheme):
    """Face (cells,) K at the end and seconds for the steps, by `cn` or `bdf2`."""
    ngs, space, mass, stiffness, face = setting
    dt, cell = DURATION / count, LENGTH / face.size
    matrix = mass.mat.CreateMatrix()
    weight = {"cn": 0.5 * dt, "bdf2": 2.0 / 3.0 * dt}[scheme]
    matrix.AsVector().data = mass.mat.AsVector() + weight * stiffness.mat.AsVector()
    solve = matrix.Inverse(space.FreeDofs(), inverse="sparsecholesky")
    u, before, right, change = (mass.mat.CreateColVector() for _ in range(4))
    u[:] = 0.0
    before[:] = 0.0
    load = right.CreateVector()
    load[:] = 0.0
    places, travel = centres(count)
    began = time.perf_counter()
    for centre in places:
        load.FV().NumPy()[face] = nodal_loads(cell, face.size, centre, travel)
        if scheme == "cn":  # (M + dt/2 K) (u+ - u) = dt (load - K u)
            right.data = load - stiffness.mat * u
            change.data = dt * (solve * right)
            u.data += change
        else:  # (M + 2/3 dt K) u+ = M (4 u - u-)/3 + 2/3 dt load; the cold start is its own past
            change.data = 4.0 / 3.0 * u - 1.0 / 3.0 * before
            right.data = mass.mat * change + weight * load
            before.data = u
            u.data = solve * right
    seconds = time.perf_counter() - began
    return u.FV().NumPy()[face].copy(), seconds


def error(face, exact):
    """Root mean square over the largest; the exact face has nodes among which ours are."""
    at_nodes = exact[:: exact.size // face.size]
    return float(np.sqrt(np.mean((face - at_nodes) ** 2)) / exact.max())


def main():
    told = arguments(__doc__).parse_args()
    try:
        import ngsolve
    except ImportError:
        print("ngsolve is not installed: nothing to compare with (pip install ngsolve)")
        return
    ngsolve.SetNumThreads(1)
    exact, _ = run_ours(our_belt(24, 0.5 * CELL), 2000)
    count = math.ceil(SPEED * DURATION / (FOOTPRINT.length / 16))
    belt = our_belt(ELEMENTS, CELL)
    face, ours = run_ours(belt, count)
    mine = error(face, exact)
    print(
        f"ours    {1e3 * DURATION / count:7.3f} ms a step  error {mine:.2e}  {ours:7.3f} s"
        f"  {1e3 * ours / count:6.3f} ms each"
    )
    setting = peer_setting(belt.depth, belt.cells)
    best = None
    for scheme in ("cn", "bdf2"):
        last = math.inf
        for step in STEPS_MS:
            steps = round(DURATION / (1e-3 * step))
            face, seconds = run_peer(setting, steps, scheme)
            theirs = error(face, exact)
            print(
                f"{scheme:<7} {step:7.3f} ms a step  error {theirs:.2e}  {seconds:7.3f} s"
                f"  {1e3 * seconds / steps:6.3f} ms each"
            )
            if best is None or (theirs, seconds) < best:
                best = theirs, seconds
            if theirs <= mine or theirs > FALLS_NO_MORE * last:
                break
            last = theirs
    print(
        f"ratio at the peer's best error, {best[0]:.2e} to our {mine:.2e}:"
        f" {best[1] / ours:.1f} (same time step: see the ms each)"
    )
    write(
        told.json,
        "heat_against_ngsolve",
        {
            "our error": Figure(mine),
            "peer / ours": Figure(best[1] / ours, better="more"),
            "a step of ours": Figure(1e3 * ours / count, "ms"),
        },
    )


if __name__ == "__main__":
    main()
