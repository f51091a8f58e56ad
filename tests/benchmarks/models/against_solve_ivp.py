"""The kernel against scipy's `solve_ivp` with events, on the same right-hand side.

    python tests/benchmarks against_solve_ivp [--json FILE]

Both run 20 s of stick-slip on a belt, for several contacts. scipy calls the kernel's own right-hand
side, once as Python and once compiled, so that the second ratio is scipy's stepping alone. Its
DOP853 is given the tolerance at which its last break-away is as exact as ours (against a run of
ours at the tightest tolerance), stick and slip alternate by its event location, and it is spared
what the kernel does besides: outputs at 100 Hz come from its own dense output.
"""

import time
from types import SimpleNamespace

import numpy as np
from baseline import Figure, arguments, write
from mechanics import median_seconds
from scipy.integrate import solve_ivp
from stickslip import Initial, Parameters, Rig, Solver, simulate
from stickslip.catalogue import CATALOGUE
from stickslip.kernel import contact, layout, motion

SPEED, DURATION = 0.15, 20.0
SWERVE = {"y": 0.005, "phi": 0.1}
WEAKER = {"velocity_weakening": {"hyperbolic": 1.0}}
# contact -> (blocks, start beside the belt's speed along x)
CONTACTS = {
    "friction along x": ({}, {}),
    "in the plane": ({"lateral_friction": {"ratio": 1.0}}, {}),
    "in the plane, turning": ({"lateral_friction": {"ratio": 1.0}}, SWERVE),
    "turning, mu_k falls with v": ({"lateral_friction": {"ratio": 1.0}} | WEAKER, SWERVE),
}
PYTHON = SimpleNamespace(
    set_slopes=motion.set_slopes,
    set_contact=contact.set_contact,
    set_holding_load=contact.set_holding_load,
    holding_ratio=contact.holding_ratio,
    set_onset_direction=contact.set_onset_direction,
    scaled_sliding_speed=contact.scaled_sliding_speed,
    rest_speed=contact.rest_speed,
)


def belt(name: str = "in the plane", tolerance: float = 1e-11) -> Parameters:
    blocks, start = CONTACTS[name]
    return Parameters(
        **blocks,
        rig=Rig(spring_natural_length=0.17),
        initial=Initial(vx=SPEED, **start),
        solver=Solver(tolerance=tolerance),
    )


class ScipyRun:
    """One run by `solve_ivp`: stick until the load reaches the limit, slip until rest."""

    def __init__(self, name: str, kernel, array):
        parameters = belt(name)
        self.kernel = kernel
        self.p, self.u = array(parameters.pack()), array(np.zeros(layout.U_SIZE))
        self.u[layout.U_SPEED] = SPEED
        self.u[layout.U_TEMPERATURE] = parameters.temperature_dependence.reference_degC
        self.w = array(np.zeros(layout.W_SIZE))
        self.rest = kernel.rest_speed(self.p, self.u)
        self.start = parameters.initial

    def slopes(self, t, y):
        w = self.w
        w[layout.W_STATE] = t
        w[layout.W_STATE + 1 : layout.W_STATE + 1 + layout.STATES] = y
        self.kernel.set_slopes(self.p, self.u, w, float(self.mode), layout.W_SLOPES)
        return np.array(w[layout.W_SLOPES : layout.W_SLOPES + layout.STATES])

    def look(self, t, y):
        self.w[layout.W_STATE] = t
        self.w[layout.W_STATE + 1 : layout.W_STATE + 1 + layout.STATES] = y
        self.kernel.set_contact(self.p, self.u, self.w, layout.W_STATE)

    def gives_way(self, t, y):
        self.look(t, y)
        self.kernel.set_holding_load(self.p, self.w)
        return self.kernel.holding_ratio(self.p, self.u, self.w) - 1.0

    def comes_to_rest(self, t, y):
        """Speed above that of rest; along x alone it changes sign there."""
        if t < self.began + 1e-3:
            return 1.0
        self.look(t, y)
        if self.p[layout.P_LATERAL] == 0.0:
            return self.w[layout.W_SURFACE] - y[layout.VX - 1]
        return self.kernel.scaled_sliding_speed(self.w) - self.rest

    def follow_surface(self, t, y):
        self.look(t, y)
        y[layout.VX - 1] = SPEED
        if self.p[layout.P_LATERAL] > 0.0:
            y[layout.VY - 1 : layout.VY + 1] = 0.0
        self.look(t, y)

    def break_aways(self, tolerance: float) -> list[float]:
        """Their times, s."""
        y, t, starts = np.zeros(layout.STATES), 0.0, []
        start = self.start
        y[layout.X - 1 : layout.X + 5] = (
            start.x,
            start.y,
            start.phi,
            start.vx,
            start.vy,
            start.omega,
        )
        self.follow_surface(t, y)
        self.mode = layout.STICK if self.gives_way(t, y) < 0.0 else layout.SLIP
        samples = np.arange(0.0, DURATION + 0.005, 0.01)
        self.comes_to_rest.__func__.terminal = self.gives_way.__func__.terminal = True
        self.gives_way.__func__.direction = 1.0
        self.comes_to_rest.__func__.direction = -1.0
        while t < DURATION:
            self.began = t
            if self.mode == layout.SLIP:
                self.kernel.set_onset_direction(self.p, self.u, self.w)
            run = solve_ivp(
                self.slopes,
                (t, DURATION),
                y,
                method="DOP853",
                t_eval=samples[samples >= t],
                events=self.gives_way if self.mode == layout.STICK else self.comes_to_rest,
                rtol=tolerance,
                atol=1e-3 * tolerance,
            )
            if run.status == 0:
                break
            t, y = run.t_events[0][0], run.y_events[0][0].copy()
            self.follow_surface(t, y)
            held = self.gives_way(t, y) < 0.0
            if self.mode == layout.STICK:
                starts.append(t)
            self.mode = layout.STICK if self.mode == layout.SLIP and held else layout.SLIP
        return starts


def same_accuracy(exact: float, ours: float, run: ScipyRun) -> tuple[float, float]:
    """Seconds and error of the loosest scipy run that is as exact as ours."""
    for tolerance in (1e-8, 1e-9, 1e-10, 1e-11, 1e-12):
        start = time.perf_counter()
        error = abs(run.break_aways(tolerance)[-1] - exact)
        seconds = time.perf_counter() - start
        if error <= max(abs(ours - exact), 1e-10):
            break
    return seconds, error


def compare(name: str) -> dict[str, Figure]:
    """Print a contact's rows; its figures."""
    exact = simulate(belt(name, 1e-13), DURATION).slip_starts[-1]
    ours = simulate(belt(name), DURATION).slip_starts[-1]
    seconds = median_seconds(lambda: simulate(belt(name), DURATION), 9)
    print(f"{name}\n  kernel               {1e3 * seconds:9.2f}   {abs(ours - exact):20.1e}")
    figures = {f"{name}: kernel": Figure(1e3 * seconds, "ms")}
    for language, kernel, array in (
        ("Python", PYTHON, list),
        ("compiled", CATALOGUE.compiled, np.array),
    ):
        ScipyRun(name, kernel, array).break_aways(1e-3)  # compiles
        peer, error = same_accuracy(exact, ours, ScipyRun(name, kernel, array))
        row = f"  solve_ivp, {language:10s}{1e3 * peer:9.2f}   {error:20.1e}"
        print(f"{row}   {peer / seconds:13.0f}")
        figures[f"{name}: solve_ivp, {language} / ours"] = Figure(peer / seconds, better="more")
    return figures


def main() -> None:
    told, figures = arguments(__doc__).parse_args(), {}
    print("                              ms   last break-away off by, s   ratio")
    for name in CONTACTS:
        figures |= compare(name)
    write(told.json, "against_solve_ivp", figures)


if __name__ == "__main__":
    main()
