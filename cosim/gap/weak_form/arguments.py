"""What friction and springs may depend on: one unknown curve for every argument.

The runs decide on the argument, by the same evidence for all; which law the curve follows is asked
afterwards. Where one called `other.` wins, what is missing is not in the catalogue.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import lru_cache

import numpy as np
from scipy.signal import bilinear, lfilter
from stickslip.effects.friction.thermal_weakening import (
    FAST_WEIGHT,
    FASTER,
    SLOW_WEIGHT,
    SLOWER,
)

from cosim.gap.data import Campaign
from cosim.gap.weak_form.constants import (
    CURVE_NODES,
    LEAST_LOG_RANGE,
    LONGEST_MEMORY,
    NEAR_MEMORIES,
    RESONATOR_DAMPING,
    RESONATOR_STEP,
    RESONATORS,
    SHORTEST_MEMORY,
    SINCE_RELEASE,
    SLIP_PERCENTILE,
    STOP_LENGTHS,
    WIDER_SPRINGS,
)
from cosim.gap.weak_form.rig_unknowns import Level
from cosim.gap.weak_form.rows import Response, RunRows
from cosim.gap.weak_form.unknowns import Curve, Unknown, column

#: Form of a drift in which both coefficients keep their ratio.
IN_PROPORTION = "mu_s in proportion"


class Arguments:
    """The arguments of a campaign's runs, and the unknowns that they make."""

    def __init__(self, campaign: Campaign, runs: list[RunRows], level: Level):
        self.campaign, self.runs, self.level = campaign, runs, level
        self.slipping = [run for run in runs if run.track.slips]
        self.force = level.kinetic * float(np.mean([run.weight for run in runs]))

    def unknowns(self) -> dict[str, list[Unknown]]:
        """effect or other finding -> its variants, those that these runs can show."""
        made = {}
        if self.slipping:
            made = {
                "velocity_weakening": [self._over_speed(True, steep) for steep in (False, True)],
                "film_drag": [self._over_speed(False, steep) for steep in (False, True)],
                "structural_damping": [self._over_velocity()],
                "spring_hardening": list(self._over_place()),
                "run_in": list(self._over_distance()),
                "thermal_weakening": list(self._over_heat()),
                "other.time": list(self._over_time()),
                "other.hysteresis": [self._hysteresis()],
                "other.resonator": list(self._resonators()),
                "other.release": [self._since_release()],
                "other.springs": [self._springs()],
            }
        made["load_dependence"] = list(self._trend("load_dependence", lambda run: run.weight))
        made["other.room"] = list(
            self._trend("other.room", lambda run: np.exp(0.1 * run.track.run.ambient_degC))
        )
        order = {run.track.run.name: number for number, run in enumerate(self.runs)}
        made["other.order"] = list(
            self._trend("other.order", lambda run: np.exp(0.1 * order[run.track.run.name]))
        )
        made["static_strengthening"] = list(self._over_hold())
        return {name: variants for name, variants in made.items() if variants}

    def _over_speed(self, of_weight: bool, steep: bool) -> Unknown:
        """Coefficient, or force, over the sliding speed; steep : at low speeds."""
        fastest = self._largest(lambda run: np.abs(run.track.sliding))
        nodes = fastest * np.linspace(0.0, 1.0, CURVE_NODES) ** (2.5 if steep else 1.3)

        def respond(run: RunRows) -> Response:
            unit = self.level.kinetic * run.weight if of_weight else self.force
            at = curve.at(np.abs(run.track.sliding))
            return Response(force=unit * run.track.direction[:, None] * at)

        name, per = ("velocity_weakening", "mu_k") if of_weight else ("film_drag", "N")
        curve = Curve("sliding speed", "m/s", nodes, per, root=steep)
        return Unknown.over(name, curve, respond, "steep at first" * steep)

    def _over_velocity(self) -> Unknown:
        """Force against the block's own velocity, odd in it."""
        fastest = self._largest(lambda run: np.abs(run.track.velocity))
        nodes = np.linspace(0.0, fastest, CURVE_NODES)

        def respond(run: RunRows) -> Response:
            velocity = run.track.velocity
            at = curve.at(np.abs(velocity))
            return Response(force=-self.force * np.sign(velocity)[:, None] * at)

        curve = Curve("velocity of the block", "m/s", nodes, "N")
        return Unknown.over("structural_damping", curve, respond)

    def _over_place(self) -> Iterator[Unknown]:
        """Force of the springs beyond the stated ones, odd in the place: as large whatever springs
        are in, or in proportion to their stiffness, as of springs of one make."""
        farthest = self._largest(lambda run: np.abs(run.track.place))
        curve = Curve("place of the block", "m", np.linspace(0.0, farthest, CURVE_NODES), "N")
        stiffness = {run.track.run.name: run.track.run.total_stiffness for run in self.runs}
        typical = float(np.mean(list(stiffness.values())))
        several = float(np.ptp(np.log(list(stiffness.values())))) > LEAST_LOG_RANGE

        for per_spring in (False, True) if several else (True,):

            def respond(run: RunRows, per_spring: bool = per_spring) -> Response:
                unit = farthest * (stiffness[run.track.run.name] if per_spring else typical)
                place = run.track.cause  # a stiff spring feels what smoothing leaves
                force = -unit * np.sign(place)[:, None] * curve.at(np.abs(place))
                turned = [abs(event.force) / stiffness[run.track.run.name] for event in run.events]
                return Response(force=force, static=-unit * curve.at(np.array(turned)))

            words = "in proportion to the stiffness" if per_spring and several else ""
            settings = {"per_stiffness": float(per_spring)}
            yield Unknown.over("spring_hardening", curve, respond, words, settings)

    def _springs(self) -> Unknown:
        """All springs stiffer than stated, far beyond the stated error."""

        def respond(run: RunRows) -> Response:
            held = column([-event.force for event in run.events])
            return Response(force=column(-run.restoring), static=held)

        return Unknown("other.springs", "", respond, WIDER_SPRINGS**2 * np.eye(1))

    def _hysteresis(self) -> Unknown:
        """Springs, or guides, that give way: stop operators of several lengths (Prandtl 1928).

        The shortest is dry friction against the frame, the longest a spring beside the springs.
        """
        farthest = self._largest(lambda run: np.abs(run.track.place))
        lengths = farthest * np.array(STOP_LENGTHS)

        def respond(run: RunRows) -> Response:
            stops = np.column_stack([_stopped(run.track.place, one) for one in lengths])
            return Response(force=-self.force * stops)

        return Unknown("other.hysteresis", "", respond, np.eye(lengths.size))

    def _resonators(self) -> Iterator[Unknown]:
        """A mass on a spring that the block carries: it rings after every jolt."""
        own = float(np.median([run.track.run.natural_frequency for run in self.runs]))
        low, high = np.log(own * np.array(RESONATORS))

        for omega in np.exp(np.arange(low, high, RESONATOR_STEP)):

            def respond(run: RunRows, omega: float = omega) -> Response:
                pull = _resonator(self._acceleration(run), run.track.interval, omega)
                return Response(force=column(run.track.run.mass * pull))

            words = f"{omega / (2.0 * np.pi):.2g} Hz"
            yield Unknown("other.resonator", words, respond, np.eye(1))

    def _acceleration(self, run: RunRows) -> np.ndarray:
        """(n,) m/s2, by the balance of forces in slip, 0 in stick: without the noise of x''."""
        rubbing = self.level.kinetic * run.weight * run.track.direction
        pulled = run.track.run.total_stiffness * run.track.place
        return np.where(run.track.slips_mask, rubbing - pulled, 0.0) / run.track.run.mass

    def _over_distance(self) -> Iterator[Unknown]:
        """Coefficient over the distance slid in the run; static friction with it, or not."""
        slid = {run.track.run.name: self._slid(run) for run in self.runs}
        longest = max(values[-1] for values in slid.values())
        nodes = longest * np.linspace(0.0, 1.0, CURVE_NODES + 3) ** 2
        # laws of wear are steep at first: smooth over the root of the distance
        curve = Curve("distance slid", "m", nodes, "mu_k", root=True)
        yield from self._remembered("run_in", "", slid, curve, {})

    def _over_time(self) -> Iterator[Unknown]:
        """Coefficient over the time in the run, whatever was slid."""
        time = {run.track.run.name: run.track.time for run in self.runs}
        nodes = np.linspace(0.0, max(values[-1] for values in time.values()), CURVE_NODES)
        curve = Curve("time", "s", nodes, "mu_k")
        yield from self._remembered("other.time", "", time, curve, {})

    def _over_heat(self) -> Iterator[Unknown]:
        """Coefficient over the friction heat that is remembered, of the contact or per weight."""
        count = round(np.log2(LONGEST_MEMORY / SHORTEST_MEMORY)) + 1
        per_weight = (
            (False, True) if len({run.track.run.mass for run in self.runs}) > 1 else (False,)
        )
        for memory in np.geomspace(SHORTEST_MEMORY, LONGEST_MEMORY, count):
            for each in per_weight:
                yield from self._of_memory(float(memory), each, False)
        for memory in np.geomspace(SHORTEST_MEMORY, LONGEST_MEMORY, count // 2 + 1):
            yield from self._of_memory(float(memory), False, True)

    def near(self, unknown: Unknown) -> list[Unknown]:
        """The same argument with settings between those that were tried; [] where it has none."""
        if "memory" not in unknown.settings:
            return []
        memory, static = unknown.settings["memory"], unknown.settings["static"]
        per_weight, spread = unknown.settings["per_weight"], unknown.settings["diffusion"]
        return [
            one for factor in NEAR_MEMORIES
            for one in self._of_memory(memory * factor, bool(per_weight), bool(spread))
            if one.settings["static"] == static
        ]  # fmt: skip

    def _of_memory(self, memory: float, per_weight: bool, spread: bool) -> Iterator[Unknown]:
        """spread : heat goes into a half-space, as the effect thermal_weakening has it."""
        typical = float(np.mean([run.weight for run in self.runs]))
        memories = {memory: 1.0}
        if spread:
            memories |= {memory / FASTER: FAST_WEIGHT, memory * SLOWER: SLOW_WEIGHT}
        heat = {}
        for run in self.runs:
            power = self.level.kinetic * self._sliding(run)
            power *= typical if per_weight else run.weight
            parts = [
                weight * _decaying(power, run.track.interval, time)
                for time, weight in memories.items()
            ]
            heat[run.track.run.name] = np.sum(parts, axis=0)
        most = max(values.max() for values in heat.values())
        nodes = most * np.linspace(0.0, 1.0, CURVE_NODES - 3)
        curve = Curve("friction heat remembered", "J", nodes, "mu_k")
        kind = ", half-space" * spread + ", per weight" * per_weight
        settings = {"memory": memory, "per_weight": float(per_weight), "diffusion": float(spread)}
        yield from self._remembered(
            "thermal_weakening", f"memory {memory:.2g} s{kind}", heat, curve, settings
        )

    def _remembered(
        self, name: str, variant: str, values: dict[str, np.ndarray], curve: Curve,
        settings: dict[str, float],
    ) -> Iterator[Unknown]:  # fmt: skip
        """Coefficient over what a run remembers: mu_s stays, moves as well, or in proportion."""
        shares = {"mu_k alone": 0.0, "mu_s by half as much": 0.5, "mu_s by as much": 1.0}
        if any(run.events for run in self.runs):
            shares[IN_PROPORTION] = self.level.static / self.level.kinetic
        for form, share in shares.items():

            def respond(run: RunRows, share: float = share) -> Response:
                at = curve.at(values[run.track.run.name])
                unit = self.level.kinetic * run.weight
                static = share * unit * at[[event.at for event in run.events]]
                return Response(force=unit * run.track.direction[:, None] * at, static=static)

            words = ", ".join(filter(None, [variant, form]))
            more = {"static": share, "in_proportion": float(form == IN_PROPORTION)}
            yield Unknown.over(name, curve, respond, words, {**settings, **more})

    def _trend(self, name: str, quantity: Callable[[RunRows], float]) -> Iterator[Unknown]:
        """Both coefficients with the logarithm of a setting of the runs."""
        logs = {run.track.run.name: float(np.log(quantity(run))) for run in self.runs}
        middle, span = np.mean(list(logs.values())), np.ptp(list(logs.values()))
        if span < 0.02:
            return

        def respond(run: RunRows) -> Response:
            part = (logs[run.track.run.name] - middle) / span
            kinetic = part * self.level.kinetic * run.weight * run.track.direction
            static = np.full((len(run.events), 1), part * self.level.static * run.weight)
            return Response(force=column(kinetic), static=static)

        yield Unknown(name, "", respond, np.eye(1),
                      settings={"middle": float(middle), "span": float(span)})  # fmt: skip

    def _over_hold(self) -> Iterator[Unknown]:
        """Static friction over the hold time before it."""
        holds = [event.hold for run in self.runs for event in run.events]
        if not holds or np.log(max(holds) / min(holds)) < LEAST_LOG_RANGE:
            return
        nodes = np.linspace(np.log(min(holds)), np.log(max(holds)), CURVE_NODES - 3)

        def respond(run: RunRows) -> Response:
            held = np.log([event.hold for event in run.events])
            return Response(static=self.level.static * run.weight * curve.at(held))

        curve = Curve("logarithm of the hold time", "ln s", nodes, "mu_s")
        yield Unknown.over("static_strengthening", curve, respond)

    def _since_release(self) -> Unknown:
        """Coefficient over the time since the block let go: what a rest has built up goes."""
        nodes = SINCE_RELEASE * np.linspace(0.0, 1.0, CURVE_NODES - 3)

        def respond(run: RunRows) -> Response:
            since = np.full(run.track.time.size, SINCE_RELEASE)
            for first, last in run.track.slips:
                since[first:last] = run.track.interval * np.arange(last - first)
            at = curve.at(SINCE_RELEASE - since)[:, ::1]
            unit = self.level.kinetic * run.weight
            return Response(force=unit * run.track.direction[:, None] * at)

        curve = Curve("time before the memory of the break-away ends", "s", nodes, "mu_k")
        return Unknown.over("other.release", curve, respond)

    def _largest(self, values: Callable[[RunRows], np.ndarray]) -> float:
        """Of a quantity in slip, but for the last percent, which may be outliers."""
        return max(
            float(np.percentile(values(run)[run.track.slips_mask], SLIP_PERCENTILE))
            for run in self.slipping
        )

    def _sliding(self, run: RunRows) -> np.ndarray:
        """(n,) sliding speed, 0 in stick, m/s; in a hole of the record what it is in the mean."""
        sliding = np.where(run.track.slips_mask, np.abs(run.track.sliding), 0.0)
        return np.where(run.track.seen, sliding, np.abs(run.track.surface_speed))

    def _slid(self, run: RunRows) -> np.ndarray:
        """(n,) distance slid since the start, m."""
        return np.cumsum(self._sliding(run)) * run.track.interval


def _stopped(place: np.ndarray, length: float) -> np.ndarray:
    """(n,) force of a spring that slips beyond a deflection, m, in parts of the force there."""
    stopped, last = np.empty(place.size), 0.0
    for number, step in enumerate(np.diff(place, prepend=place[0]).tolist()):
        last = min(max(last + step, -length), length)
        stopped[number] = last
    return stopped / length


def _resonator(acceleration: np.ndarray, interval: float, omega: float) -> np.ndarray:
    """(n,) m/s2, force on its carrier per carried mass, beyond that of a mass that is fixed to it.

    u'' + 2 zeta omega u' + omega^2 u = -x'' from rest, by the bilinear rule; the force is -u''.
    """
    return np.asarray(lfilter(*_ringing(interval, omega), acceleration))


@lru_cache(maxsize=1024)
def _ringing(interval: float, omega: float) -> tuple[np.ndarray, np.ndarray]:
    """Coefficients of its filter: runs of one camera have the same."""
    damping = 2.0 * RESONATOR_DAMPING * omega
    above, below = bilinear([1.0, 0.0, 0.0], [1.0, damping, omega**2], 1.0 / interval)
    return above, below


def _decaying(rate: np.ndarray, interval: float, memory: float) -> np.ndarray:
    """(n,) integral of a rate that is forgotten within a memory, s."""
    kept = np.exp(-interval / memory)
    return np.asarray(lfilter([interval], [1.0, -kept], rate))
