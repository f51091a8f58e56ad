/* StickSlip3DOF: the memory of a run of the mechanical model, and what is looked up for it. */
#ifndef MODEL_H
#define MODEL_H

#include "kernel.h"
#include "variables.h"

typedef struct {
    double p[P_SIZE]; /* parameters, as the kernel has them */
    double g[G_SIZE]; /* inputs as the host gives them */
    double u[U_SIZE]; /* inputs as the kernel has them */
    double z[Z_SIZE]; /* everything that the kernel remembers of the run */
    double watched[WATCHED_COUNT]; /* what no rig bears, 1 or 0, as it was at the last event */
} Model;

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* Where the kernel keeps each output. */
extern const int OUTPUT_SLOTS[];
/* Where each local variable is among the states and, behind them, their rates. */
extern const int LOCAL_SLOTS[];
/* Value reference of each continuous state. */
extern const int STATE_REFERENCES[];
/* Of each random number: its seed among the parameters; uniform, or else normal. */
extern const int DRAW_SEED[], DRAW_UNIFORM[];

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
