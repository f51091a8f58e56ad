"""Every number of the method that is chosen, with the reason for it."""

from __future__ import annotations

# Smoothing and regimes.
#: Half width w of the cubic that finds slips, in 1 / omega: its velocity is off by
#: (omega w)^4 / 504 = 4e-4 of an oscillation's, its acceleration by (omega w)^2 / 14 = 3 %, and the
#: noise of its velocity is a third of that of w = 0.3.
CUBIC_REACH = 0.65
#: Half width of the quintic inside slips, in 1 / omega: its acceleration is off by 1.3e-3, its
#: velocity by 2e-5.
QUINTIC_REACH = 1.0
#: Samples nearer to one another than this, in 1 / omega, are averaged: sixty a swing are left.
FINE_ENOUGH = 0.1
#: Most of omega times the interval: that quintic needs seven samples. And the fewest fitted runs as
#: fine as that of which rows are made without the others: of one, friction has no scatter.
COARSEST, LEAST_FINE = 1.0 / 3.0, 2
#: Samples count as even within this part of their interval: cubic interpolation is better below.
EVEN = 0.01
#: A hole is longer than so many intervals: interpolation across it is guesswork.
HOLE = 2.5
#: Sliding speed below which a contact may still be letting go, m/s, and part of the surface's:
#: published Stribeck speeds of dry contacts are 1 to 8 mm/s.
LEAST_SLIDING, LEAST_SLIDING_SHARE = 6e-3, 0.06
#: The same in parts of the fastest sliding, where a rig is so slow that this is less.
SLOW_PART = 0.1
#: Standard deviations of the smoothed velocity beyond which it is no noise: that reaches them once
#: in seven swings, for a sample or two, which is no slip (`SLIP_SIGMAS`).
VELOCITY_SIGMAS = 3.0
#: In a slip the surface gets ahead of the block by more than so many standard deviations of a
#: sample: some 2000 samples of noise alone do not.
SLIP_SIGMAS = 8.0
#: In a stick it gets ahead by no more than so many, which smoothed noise does not reach, and this
#: part of its way: the last of a slip that is counted with it, creep, a set-point that is off.
STICK_SIGMAS, STICK_AHEAD = 4.0, 0.15

#: Swings faster than stated by this factor are those of other springs: noise and rubbing do not
#: make them so, and their noise is weighed as that of the springs that are there.
FAR_STIFFER = 1.25
#: Standard deviation of x, in those of the noise, from which the block swings at all: smoothing
#: leaves a tenth of the noise's squares, then a hundredth of those of the swings.
MOVES = 3.0

#: Rounds in which a linear fit and what it is linear about follow one another - phases and shape of
#: a wave; numbers, sliding direction and turn in the plane -: 1e-3 of the change is left.
ROUNDS = 6

# Test functions.
#: Distance of the splines' knots, in 1 / omega: they pass half of what is five times as fast as the
#: free oscillation, and a slip of half a period holds five functions, one of three quarters ten.
#: For so long next to a slip a stick is not counted as one: the smoothed velocity still mixes both.
KNOTS = 0.3

#: Part by which a variance is enlarged, so that rounding leaves a covariance positive: slow swings
#: of finely sampled tracks make neighbouring rows all but one.
ROUNDING = 1e-9

#: Root mean square of x about its mean, in noise, up to which a block is at rest: of noise alone
#: it is 1 +- 0.09 over two periods of 30 samples each.
AT_REST = 1.25

#: Standard deviation of what damps a block that came to rest, a part of what is critical: it
#: multiplies the noise of its speeds. A film of 1.5 N s/m under 0.67 kg on springs of 80 N/m makes
#: 0.1.
DAMPED = 0.1

# Break-aways.
#: Of the largest deflection, the part that the surface's own speed may make: beyond it nearly all
#: of the overshoot is the belt's, and what the contact held is the small difference of two numbers.
MOST_OVERSHOOT = 0.8
#: Slips for each power of the time by which kinetic friction is followed over a run: the error of
#: the course is then half of a slip's in the mean.
SLIPS_OF_A_POWER = 5
#: A stick shorter than this part of a period may be none.
SHORTEST_STICK = 0.08

# What a rig's own numbers may be beforehand: standard deviations.
#: Speed over which a contact's friction falls from static to kinetic, m/s, and by what part of
#: mu_k: dry contacts fall over 1 to 8 mm/s.
CONTACT_SPEED, CONTACT_FALL = 4e-3, 1.0
#: Time by which a contact lets go sooner, or later, than an ideal one, s: bristles of 20 to 100 um
#: on surfaces of 5 mm/s and more.
CONTACT_DELAY = 0.02
#: Part of the surface's speed at which a contact creeps under the fourth power of its load, and
#: length by which its bristles have given way when it lets go, m.
CREEP = (0.1, 1e-4)
#: Speed at which it creeps under its load whatever the surface does, m/s: friction that is regular
#: in the speed, and pastes.
CREEP_SPEED = 1e-3
#: Scatter of static friction alone, in parts of that of friction as a whole.
OWN_STATIC = 0.25
#: To what part of itself a break-away's force is read off in a run, beside its scatter.
STATIC_FLOOR = 3e-3
#: Scatter of friction from stick to stick: standard deviation beforehand.
STICK_SCATTER = 0.02
#: Scatter of friction from run to run: the values asked.
SCATTER_ASKED = (0.002, 0.006, 0.02, 0.06)
#: Spread of the tracker's zeros in parts of what is stated.
ZERO_PARTS_ASKED = (0.1, 0.3, 1.0)

# Arguments.
#: Nodes of a curve: a law that bends over a third of its range, as exp(-3 u) or 1 / (1 + 3 u), is
#: followed to a thousandth.
CURVE_NODES = 9
#: The largest value of an argument in slip, but for outliers of the smoothed velocity.
SLIP_PERCENTILE = 99.0
#: Memories of friction heat that are tried, s: shorter ones are a law of the sliding speed, longer
#: ones of the distance.
SHORTEST_MEMORY, LONGEST_MEMORY = 0.5, 32.0
#: Memories about the one found, in parts of it, once it is found.
NEAR_MEMORIES = (0.6, 0.71, 0.84, 1.19, 1.41, 1.68)
#: Natural logarithm by which hold times, or stiffnesses, must differ to tell of their law.
LEAST_LOG_RANGE = 0.3
#: Time after a break-away in which what a rest has built up may still be felt, s.
SINCE_RELEASE = 0.5
#: How far springs may be from what is stated where that is the finding, a part.
WIDER_SPRINGS = 0.5
#: Scales of an argument's curve that are tried, in parts of what it acts on.
SCALES_ASKED = (0.003, 0.01, 0.03, 0.1, 0.3, 1.0)
#: Bends of a curve that are tried, in parts of its straight line.
BENDS_ASKED = (0.03, 0.3, 1.0)

# Waves.
#: Harmonics of a wave's shape: bumps of a fifth of the wave length.
HARMONICS = 4
#: Wavenumbers are scanned at so many steps within the resolution 1 / (length of a run).
SCAN_STEPS = 2
#: The shortest wave lasts so long for the block, in 1 / omega, a third of a swing: test functions
#: pass four fifths of it, and what differs faster, within a slip alone, is the contact's.
SHORTEST_WAVE = 2.0
#: Most wavenumbers of a scan times samples of a run, for the sake of memory: long records of fast
#: swings are scanned for long waves alone.
MOST_WAVES = 1e7
#: Least part of a step by which a wave is moved: what is left then gains next to nothing.
LEAST_STEP = 0.05
#: Peaks of the scan that are fitted as one shape.
WAVES_FITTED = 3

#: Angle by which a wave may be off at the end of a run while its phase is looked for, rad, and the
#: most speeds of the surface to either side that are tried for it.
ALIGNED, SPEEDS_TRIED = 1.5, 12

# The ladder.
#: ln of how much more probable the rows must be with a finding: with some twenty that are tried,
#: one in twenty campaigns without any would gain 6 by chance.
LEAST_GAIN = 6.0
#: ln by which a faulty camera, or what no effect stands for, is less probable beforehand than an
#: effect: one campaign in twenty.
PRICE = 3.0
#: A further finding counts from this part of what is missing at first (root mean square): what is
#: smaller may be what smoothed arguments and the nodes of the first one's curve leave.
LEAST_PART = 0.12
#: ln by which a further finding counts where there is no misfit to take a part of, and up to which
#: rows do not decide between two explanations: twice what they are asked for a finding; smoothed
#: arguments have turned 7.
UNDECIDED = 12.0
#: More findings than these are no explanation.
MOST_FINDINGS = 3

# Arguments that no effect stands for.
#: Lengths at which hysteretic springs give way, in parts of the largest deflection.
STOP_LENGTHS = (0.02, 0.1, 0.3, 1.0)
#: Frequencies of a carried mass in those of the block, their steps (ln), and its damping ratio: it
#: rings for three periods, so that its frequency counts to 5 %.
RESONATORS, RESONATOR_STEP, RESONATOR_DAMPING = (0.5, 4.0), 0.05, 0.05
#: Parts of the surface's speed within which a block may move with it while its ripple is looked
#: for: no threshold of an answer, only of what is a stick.
RIPPLE_BANDS = (0.35, 0.15)

# The plane.
#: Samples of a piece of which y is averaged; by how many standard deviations chi-squared of the
#: means must exceed what noise makes it where y moves.
STILL_PIECE, STILL_SIGMAS = 20, 6.0
#: Standard deviations within which a number of a form may be zero.
STILL_NUMBER = 4.0
#: Part of the misfit of y that an effect may leave: a swing that no form follows has small numbers
#: of high evidence.
PLANE_PART = 0.5
#: Part of what friction across explains that a number beside it must add. How the load lies on the
#: contact nobody has measured: the moment of friction on a disc is 2/3 of its radius evenly loaded,
#: 4/5 hollow; a model that follows the motion to half of that, 10 %, leaves so much of its squares.
PLANE_FOLLOWED = 1e-2
#: Sliding speed that stands for none, m/s: a block held so drifts by 1e-6 m in a minute's stick.
SLOWEST_SLIDING = 1e-6
#: Largest turn of a block whose turn is not measured, rad: springs let it go no farther.
MOST_TURN = 0.5
#: ln g, g the square of lateral_friction.ratio: the least, a ratio of 0.2; the most, as mu_k, with
#: which it goes, is known to some percent only; and the largest step in a round.
LEAST_SHARE, MOST_SHARE, SHARE_STEP = -3.2, 0.15, 0.7
#: How far off the springs' axis a block may be put down, m: the values asked, from nowhere to be
#: seen on.
STARTS_ASKED = (1e-5, 3e-4, 3e-3, 2e-2)
#: How far it may be turned then, rad: a degree where only friction over the disc tells of it, and
#: five.
START_TURN = (0.02, 0.1)
#: Turns of the springs to set out from beside none, rad: half of what a block was seen to do; and
#: the least that is found from there alone: up to 5 degrees lead there from springs along x.
TURNS_ASKED, LEAST_FAR = (0.15, -0.15), 0.08
#: Scatter of friction for which its probability is worked out: range, and steps of a fifth; a
#: scatter whose interval reaches the least is not determined.
SCATTER_RANGE, SCATTER_STEPS = (5e-4, 0.2), 33
#: Phases of a ripple that are tried in a run that seldom sticks.
PHASES_TRIED = 12

# Corners, and faults of the camera.
#: Least reach of a test function from a corner into its slip, and of the line in its stick, in
#: 1 / omega; three times as much at most: the longer, the less noise; the shorter, the less is
#: asked of springs.
CORNER_SHORTEST = 0.8
#: Square of the time for which a contact rounds a corner as a filter would, s^2: bristles of 50 um
#: under mu = 0.2 do as one of sqrt(2 z / (mu g)) = 7 ms.
CORNER_CONTACT = 7e-3**2
#: What faults are at the largest, as standard deviations; smaller ones are asked for too. Parts of
#: scale and clock: who calibrates by hand is off by 1 to 4 %, who does not by 10 %. Course of the
#: zero in a run, m: a stand that settles by 1 to 10 mm. Delay over 0.1 m, s: read-out of the frame
#: of a slow chip (10 to 30 ms, Meingast et al. 2005) with a block that crosses it in a third. Zero
#: of a run, m: a target moved by hand. Smoothing: parts of the square of a filter's width.
FAULT_SIZES = {
    "scale": 0.1,
    "clock": 0.1,
    "drift": 1e-2,
    "latency": 0.1,
    "zero": 3e-3,
    "smoothing": 1.0,
}
#: Standard deviations of filters that are tried, s: two fifths of a frame of 60 a second, which
#: none sees, up to two frames of 30; their squares lie apart by less than a scale asked for.
FILTER_WIDTHS = (0.007, 0.012, 0.02, 0.035, 0.06)

#: Delays over 0.1 m for which a slow chip is asked, s: one is off by a fifth of itself at most, and
#: what it does beyond its own proportion by a fifth of that; how many times as long as asked it may
#: be found. The most by which it may bring samples together, a part of their interval.
LATENCIES, LONGER, MOST_LEAN = (0.01, 0.015, 0.023, 0.035, 0.053, 0.08), 2.0, 0.9

# What cannot be told apart.
#: ln of a Bayes factor below which two explanations are not told apart: 20 to 1 (Kass & Raftery,
#: J. Am. Stat. Assoc. 90, 1995).
ALIKE = 3.0
#: The same of two that this design confuses: what is 400 to 1 here may be the rare campaign of the
#: design in which they differ by so much.
NEARLY_ALIKE = 6.0
