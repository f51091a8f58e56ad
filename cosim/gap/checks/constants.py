"""Every number of the checks that is chosen, with the reason for it."""

from __future__ import annotations

from scipy import stats

#: Chance that a campaign which is as stated is doubted, all runs of one check together.
LEVEL = 1e-3

# Units.
#: Samples farther apart than this part of a free vibration's period see no motion, and so does a
#: record that is shorter: it is refused when it is read (`data.units`).
HALF = 0.5
#: Sticks only make cycles longer than free vibrations, hardening springs shorter by a factor of
#: two: cycles that are shorter than this part of one are of another mass, or of other springs.
SHORT_CYCLE = 1.0 / 3.0
#: Swing of the spring force over weight that no contact without glue gives.
MOST_FRICTION = 5.0
#: A surface that is so many times faster than x ever moves, while the springs' force swings by this
#: part of the weight: x would have to move at 0.005 g / omega, a few mm/s, at least.
UNIT_SPEED, SWINGS = 300.0, 0.01
#: Part of a free vibration over which x is seen to move.
LAG = 1.0 / 8.0

# Speed in stick.
#: Part of the speed by which a contact that is sheared has the block swing past the surface.
SHEARED = 0.02
#: Part of the speed by which a loaded contact creeps: bristles of 100 um in a stroke of 1 mm.
CREEPS = 0.1
#: Beyond this part a set-point is another one: what runs at it says nothing of the one stated.
WRONG_SPEED = 0.15
#: Velocities are counted in so many bins; the median within this part about the fullest is what x
#: has most often: noise of a velocity is as wide on slow surfaces.
BINS, PEAK = 40, 0.3
#: Fewest sticks whose scatter tells the error of their mean slope.
FEWEST_STICKS = 3
#: Least travel in a stick, as part of the range of x, and fewest sticks, as part of all cycles: the
#: end of a vibration that dies out is straight, too.
TRAVEL, THROUGHOUT = 0.2, 0.5
#: Third derivative of x in sticks, as part of that in the crests of a vibration: 0, or 1; on
#: springs that are half as stiff half of it.
CREST = 0.5

# Springs.
#: Standard deviation of what friction that goes with the place, or with what was slid, makes of the
#: stiffness: friction a F (1 + sin q x) is a spring of a F q, a few percent of those of the rig.
FRICTION = 0.02
#: Fewest rows of the weak form, ten of a slip, and fewest velocities, that tell anything.
FEWEST_ROWS = 30
#: Nothing that is known makes springs softer than this part of themselves: a second mass on the
#: block, or a belt that gives, takes a fifth.
SOFTEST = 0.7
#: Standard deviation of what springs that are not linear, or not along x, make of a measured force.
SHAPE = 0.02

# Tracker.
#: Most of omega times the interval: a quintic over one radian to either side, which smooths the
#: motion in slip to 1e-3, needs seven samples.
COARSEST = 1.0 / 3.0
#: Noise that is so many times too large, or too small, hides as much misfit as any effect makes.
HIDES = 1.35
#: Most of a vibration's third difference, in parts of the noise, where noise is told from motion.
LEAK = 0.5
#: Samples that tell noise; and autocorrelation of third differences at a lag of one for
#: white noise, with n times its variance (Bartlett 1946, from -3/4, 3/10, -1/20 at lags 1 to 3).
QUIET, WHITE, BARTLETT = 200, -0.75, 0.20625
#: By how much it is higher where smoothing is felt: a Gaussian of half an interval makes it so.
SMOOTHED = 0.1
#: A number lies on a lattice within this part of a step, since a file's decimals are rounded too;
#: part of the numbers on a lattice that no finer one would leave; steps that are tried.
NEAR, ON_LATTICE, TRIED = 0.02, 0.75, 30

# Record.
#: Cycles of a window, and fewest windows beyond the first of each run: a standard deviation from
#: two pieces is known to 71 % of itself, from one not at all.
CYCLES, WINDOWS = 3, 2
#: Fewest runs.
RUNS = 2


def far(count: int) -> float:
    """Standard deviations, either way, that one of ``count`` figures exceeds in `LEVEL` of cases.

    >>> round(far(1), 2), round(far(6), 2)
    (3.29, 3.76)
    """
    return float(stats.norm.isf(0.5 * LEVEL / max(count, 1)))
