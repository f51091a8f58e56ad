"""Where each number stands in the kernel's flat arrays.

The kernel speaks only in flat arrays of floats, so that one source runs interpreted (lists),
under numba (numpy arrays) and as generated C. Five arrays travel together:

=====  ==========================================================================
``p``  parameters, constant during a run (`P_*`)
``u``  inputs, constant during a call of `advance` (`U_*`)
``z``  everything that a run remembers; copying it is saving the run (`Z_*`)
``w``  scratch space, without memory between calls (`W_*`)
``e``  log of events (`E_*`)
=====  ==========================================================================

A moment of the motion is a *block* of `BLOCK` numbers: time, the integrated state (`X` ...),
the mode and the direction of the last sliding. `z` holds four blocks: `HERE`, where the
integrator's own step begins; `NEXT`, where it ends; `SHOWN`, the moment asked for; and `BETWEEN`,
for moments on the way to it.
"""

# --- modes ------------------------------------------------------------------------------------
STICK = 0
SLIP = 1

# --- integrated state, offsets inside a block ---------------------------------------------------
TIME = 0
X = 1
Y = 2
PHI = 3
VX = 4
VY = 5
OMEGA = 6
TRAVEL = 7  # way of the surface since the start, m
DISTANCE = 8  # mean sliding distance of the contact, m
WARMTH = 9  # recent friction heat, J (thermal_weakening)
AGE = 10  # age of the contact, s (rate_and_state)
HEAT = 11  # friction heat since the start, J
WORK_SURFACE = 12  # work of the surface on the block, J
WORK_EXTERNAL = 13  # work of the external forces, J
DAMPED = 14  # work of the block on the structural damping, J
STATES = 14  # integrated numbers: X ... DAMPED
MOVING = 6  # those that every motion depends on: X ... OMEGA
REMEMBERED = 10  # those that it can depend on by way of friction: X ... AGE

# --- discrete state, offsets inside a block -----------------------------------------------------
MODE = 15
DIRECTION = 16  # unit vector of the scaled sliding velocity
SLIPS = 19  # break-aways since the start
HOLD_SINCE = 20  # when the present stick began, s
SLIP_TIME = 21  # time spent in slip since the start, s
CREEPING = 22  # 1 where the direction of a slow slip follows from the load alone, see creep
BLOCK = 23

# --- z: memory of a run -------------------------------------------------------------------------
HERE = 0
NEXT = 23
SHOWN = 46
BETWEEN = 69
Z_STEP = 92  # size that the next internal step wants, s
Z_HAS_NEXT = 93  # 1 while NEXT holds the end of the internal step that begins in HERE
Z_ENERGY = 94  # kinetic and spring energy at the start, J
Z_STARTED = 95
Z_INPUTS = 96  # the inputs that HERE and NEXT were computed with
Z_HEAT_BEFORE = 102  # friction heat at the communication point before, J
Z_TIME_BEFORE = 103
Z_STATUS = 104  # what the last call of `advance` returned
Z_SPAN = 105  # size of the internal step from HERE to NEXT, s
Z_SMOOTH = 106  # 1 where the interpolant over that step is accurate enough
Z_DENSE = 107  # the interpolant: POWERS rows of STATES coefficients
Z_SIZE = 205

# --- u: inputs ----------------------------------------------------------------------------------
U_SPEED = 0  # m/s
U_TEMPERATURE = 1  # interface temperature, degC
U_FORCE_X = 2
U_FORCE_Y = 3
U_MOMENT = 4
U_FILM = 5  # water between block and surface, mean over the contact, m
U_SIZE = 6

# --- p: parameters ------------------------------------------------------------------------------
P_MASS = 0
P_INERTIA = 1
P_NORMAL_FORCE = 2
P_RADIUS = 3  # contact radius, m
P_FREE_Y = 4  # 1 free, 0 guided
P_FREE_PHI = 5
P_STIFFNESS = 6  # one spring, N/m
P_NATURAL_LENGTH = 7
P_ATTACH = 8  # x, y of each attachment in the block's frame
P_ANCHOR = 16  # x, y of each anchor in the frame of the rig
P_CUBIC = 24  # spring_hardening, N/m^3
P_CURVE_POINTS = 25  # points of the tabulated force-length curve; 0: none
P_CURVE = 26  # extension, force, stiffness, energy of each point
P_DAMPING = 90  # N s/m
P_DAMPING_ROTATION = 91  # N m s
P_MU_S = 92
P_MU_K = 93
P_LATERAL = 94  # friction across the motion relative to that along x: 0 ... 1
P_STRENGTHENING = 95  # growth of mu_s per decade of hold time
P_HOLD_TIME = 96  # s
P_LOCAL_LAW = 97  # 1 where mu_k depends on the local sliding speed
P_LINEAR = 98  # s/m
P_HYPERBOLIC = 99  # s/m
P_INVERSE_ROOT = 100  # s/m
P_STRIBECK = 101  # part of mu_k
P_STRIBECK_SPEED = 102  # m/s
P_FILM = 103  # linear film drag, N s/m
P_FILM_ROOT = 104  # film drag growing with the root of the speed, N at 1 m/s
P_WEAKENING = 105  # thermal_weakening, 1/J
P_RELAXATION = 106  # s
P_RUN_IN = 107  # final change of mu_k, part of it
P_RUN_IN_DISTANCE = 108  # m
P_PATTERN = 109  # amplitude
P_PATTERN_WAVENUMBER = 110  # rad/m
P_PATTERN_PHASE = 111  # rad
P_SCATTER = 112  # standard deviation of the friction field, part of mu
P_SCATTER_WAVES = 113  # wavenumber and phase of 16 waves
P_DIRECT = 145  # rate_and_state: a
P_EVOLUTION = 146  # b
P_STATE_DISTANCE = 147  # m
P_STATE_SPEED = 148  # speed at which mu_k holds in steady sliding, m/s
P_CREEP_SPEED = 149  # m/s
P_INITIAL_AGE = 150  # s
P_SENSITIVITY = 151  # 1/K
P_REFERENCE = 152  # temperature at which mu_k holds, degC
P_CURVATURE = 153  # 1/R of the slab, 1/m; 0 is a belt
P_RUN_UP = 154  # s
P_RIPPLE = 155  # amplitude
P_RIPPLE_RATE = 156  # rad/s
P_RIPPLE_PHASE = 157  # rad
P_STICK_RATIO = 158  # part of the spring force that stick is judged by (1; the study's fault: 1/4)
P_TOLERANCE = 159
P_RATE = 160  # characteristic rate of the motion, rad/s
P_LONGEST_STEP = 161  # s
P_SPEED_SCALE = 162  # speed that the motion reaches by itself, m/s; scales the error test
P_SHORTEST = 163  # length below which a spring counts as collapsed, m
P_INITIAL = 164  # x, y, phi, vx, vy, omega
P_STATIC_SENSITIVITY = 170  # of mu_s, 1/K
P_ASPERITY = 171  # asperity_melting, K^2 s/m
P_MELT_FILM = 172  # melt_film, s/m
P_FEEDING = 173  # integrated numbers that the motion depends on: MOVING or REMEMBERED
P_QUADRATURE = 174  # nodes and weights for friction that varies over the disc, see disc
P_TABLEAU = 214  # the Runge-Kutta coefficients, see tableau
P_WEAKENING_CURVATURE = 574  # of the law of thermal_weakening
P_RIPPLE_SECOND = 575  # amplitude of the second harmonic, part of the first
P_RIPPLE_SECOND_PHASE = 576  # rad
P_PATTERN_SECOND = 577  # the same of surface_pattern
P_PATTERN_SECOND_PHASE = 578  # rad
P_SATURATING = 579  # growth of mu_s that a long hold comes to
P_SATURATION_TIME = 580  # s
P_STICK_CREEP = 581  # sliding speed of a stick per load, m/(s N), see stick
P_NEUTRAL = 582  # extension of a spring at which its cubic term vanishes, m
P_FLOODED = 583  # mixed_lubrication: part of the contact that water can fill
P_ROUGHNESS = 584  # m
P_COUETTE = 585  # friction coefficient of a film of 1 m at 1 m/s, s
P_RELATIVE_STIFFNESS = 586  # of each spring: what its force is multiplied by, see imperfections
P_SIZE = 590

# --- sizes inside p -----------------------------------------------------------------------------
CURVE_WIDTH = 4
WAVES = 16
STAGES = 12  # of a step
ALL_STAGES = 16  # with the slope at its end and those that only the interpolant needs
POWERS = 7  # coefficients of the interpolant for each state
EXTRA_POWERS = 4  # those that need the further stages
LATE = 5  # stages 1 ... LATE - 1 feed later stages only: no result takes their slopes
T_A = 0  # ALL_STAGES x ALL_STAGES, row by row
T_B = 192  # the row that gives the end of the step
T_C = 256
T_E5 = 272
T_E3 = 284
T_D = 296  # EXTRA_POWERS x ALL_STAGES
RAYS = 8
Q_STRIP = 0  # cos and sin^2 of the strips' angle, RAYS of each
Q_RAY = 16  # cos and sin^2 of the rays' angle about the centre of rotation, RAYS of each
DEPTHS = 4
Q_DEPTH = 32  # Gauss-Legendre nodes, then weights, DEPTHS of each

# --- w: scratch ---------------------------------------------------------------------------------
W_STATE = 0  # a block: the moment at which the right-hand side is wanted
W_SLOPES = 23  # ALL_STAGES rows of STATES slopes
W_LOAD = 247  # springs, damping and external loads on the block: x, y, phi
W_SLIDING = 250  # velocity of the block relative to the surface: x, y, phi
W_FRICTION = 253  # friction on the block: x, y, phi
W_MEAN_SPEED = 256  # local sliding speed, mean over the contact, m/s
W_SURFACE = 257  # velocity and acceleration of the surface under the block
W_PAIR = 263  # return values of functions with two results
W_DIRECTION = 265  # direction of sliding where the sliding velocity is too small to tell
W_CREEP = 268  # direction of sliding that the load asks for, see creep
W_RUNNING_UP = 271  # 1 while the internal step lies in the surface's run-up
W_SPAN = 272  # size of the step that the slopes belong to, s
W_ALONG = 273  # sliding velocity at its end along the direction at its beginning, m/s
W_SIZE = 274

# --- e: log of events ---------------------------------------------------------------------------
E_COUNT = 0
E_CAPACITY = 1
E_FIRST = 2
E_WIDTH = 3  # time, mode after the event, x

# --- o: what a run shows at a moment ------------------------------------------------------------
O_X = 0
O_Y = 1
O_PHI = 2
O_VX = 3
O_VY = 4
O_OMEGA = 5
O_FRICTION_X = 6
O_FRICTION_Y = 7
O_FRICTION_MOMENT = 8
O_SLIDING_SPEED = 9
O_HEAT_FLOW = 10
O_HEAT = 11
O_DISTANCE = 12
O_MODE = 13
O_SLIPS = 14
O_ENERGY_RESIDUAL = 15
O_TRAVEL = 16
O_SURFACE_SPEED = 17
O_DAMPED = 18
O_SURFACE_WORK = 19
O_EXTERNAL_WORK = 20
O_SLIP_TIME = 21
O_SIZE = 22
TRACKED = 3  # outputs at the beginning: x, y and phi, what a tracker sees

# --- what `advance` returns ---------------------------------------------------------------------
DONE = 0
STEP_VANISHED = 1  # the error test asks for a step below the resolution of time
NOT_FINITE = 2
SPRING_COLLAPSED = 3  # the block has been carried into the anchor of a spring
TOO_STIFF = 4  # more internal steps than anybody would wait for
STEPS_AT_LEAST = 20000  # internal steps that a call of `advance` may always take, and beyond them
STEPS_PER_SECOND = 200000.0  # so many for each second of motion
