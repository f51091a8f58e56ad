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
the mode and the direction of the last sliding. `z` holds three blocks: `HERE`, where the
integrator's own step begins; `NEXT`, where it ends; and `SHOWN`, the moment asked for.
"""

# --- modes ------------------------------------------------------------------------------------
STICK = 0
SLIP = 1

# --- integrated state, offsets inside a block -------------------------------------------------
TIME = 0
X = 1
Y = 2
PHI = 3
VX = 4
VY = 5
OMEGA = 6
HEAT = 7  # friction heat since the start, J
DISTANCE = 8  # mean sliding distance of the contact, m
TRAVEL = 9  # way of the surface since the start, m
WORK_SURFACE = 10  # work of the surface on the block, J
WORK_EXTERNAL = 11  # work of the external forces, J
STATES = 11  # integrated numbers: X ... WORK_EXTERNAL

# --- discrete state, offsets inside a block ---------------------------------------------------
MODE = 12
DIRECTION = 13  # three numbers: unit vector of the scaled sliding velocity
SLIPS = 16  # break-aways since the start
BLOCK = 17

# --- z: memory of a run -----------------------------------------------------------------------
HERE = 0
NEXT = 17
SHOWN = 34
Z_STEP = 51  # size that the next internal step wants, s
Z_HAS_NEXT = 52  # 1 while NEXT holds the end of the internal step that begins in HERE
Z_ENERGY = 53  # kinetic and spring energy at the start, J
Z_STARTED = 54
Z_INPUTS = 55  # the inputs that HERE and NEXT were computed with, five numbers
Z_HEAT_BEFORE = 60  # friction heat at the communication point before, J
Z_TIME_BEFORE = 61
Z_SIZE = 62

# --- u: inputs --------------------------------------------------------------------------------
U_SPEED = 0  # m/s
U_TEMPERATURE = 1  # interface temperature, degC
U_FORCE_X = 2
U_FORCE_Y = 3
U_MOMENT = 4
U_SIZE = 5

# --- p: parameters ----------------------------------------------------------------------------
P_MASS = 0
P_INERTIA = 1
P_NORMAL_FORCE = 2
P_RADIUS = 3  # contact radius, m
P_FREE_Y = 4  # 1 free, 0 guided
P_FREE_PHI = 5
P_STIFFNESS = 6  # one spring, N/m
P_NATURAL_LENGTH = 7
P_ATTACH = 8  # eight numbers: x, y of each attachment in the block's frame
P_ANCHOR = 16  # eight numbers: x, y of each anchor in the frame of the rig
P_MU_S = 24
P_MU_K = 25
P_LATERAL = 26  # friction across the motion relative to that along x: 0 ... 1
P_CURVATURE = 27  # 1/R of the slab, 1/m; 0 is a belt
P_SENSITIVITY = 28  # 1/K
P_REFERENCE = 29  # temperature at which mu_k holds, degC
P_RUN_UP = 30  # s
P_TOLERANCE = 31
P_RATE = 32  # characteristic rate of the motion, rad/s
P_SPEED_SCALE = 33  # speed that the motion reaches by itself, m/s; scales the error test
P_SHORTEST = 34  # length below which a spring counts as collapsed, m
P_INITIAL = 35  # six numbers: x, y, phi, vx, vy, omega
P_TABLEAU = 41  # the Runge-Kutta coefficients, see tableau

# --- the tableau's parts, offsets from P_TABLEAU ----------------------------------------------
STAGES = 12
T_A = 0  # STAGES x STAGES, row by row
T_B = 144
T_C = 156
T_E5 = 168
T_E3 = 180
P_SIZE = 233

# --- w: scratch -------------------------------------------------------------------------------
W_STATE = 0  # a block: the moment at which the right-hand side is wanted
W_SLOPES = 17  # STAGES rows of STATES slopes
W_LOAD = 149  # force and moment of springs and external loads on the block: x, y, phi
W_SLIDING = 152  # velocity of the block relative to the surface: x, y, phi
W_FRICTION = 155  # friction on the block: x, y, phi
W_MEAN_SPEED = 158  # local sliding speed, mean over the contact, m/s
W_SURFACE = 159  # velocity and acceleration of the surface under the block, 6 numbers
W_PAIR = 165  # return values of functions with two results
W_DIRECTION = 167  # direction of sliding where the sliding velocity is too small to tell
W_RUNNING_UP = 170  # 1 while the internal step lies in the surface's run-up
W_SIZE = 171

# --- e: log of events -------------------------------------------------------------------------
E_COUNT = 0
E_CAPACITY = 1
E_FIRST = 2
E_WIDTH = 3  # time, mode after the event, x

# --- o: what a run shows at a moment ----------------------------------------------------------
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
O_SIZE = 18

# --- what `advance` returns -------------------------------------------------------------------
DONE = 0
STEP_VANISHED = 1  # the error test asks for a step below the resolution of time
NOT_FINITE = 2
SPRING_COLLAPSED = 3  # the block has been carried into the anchor of a spring
