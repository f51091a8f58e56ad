/* StickSlip3DOF: the memory of a run of the mechanical model. */
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

#endif
