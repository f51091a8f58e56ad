/* StickSlip3DOF: the memory of a run of the mechanical model. */
#ifndef MODEL_H
#define MODEL_H

#include "kernel.h"

typedef struct {
    double p[P_SIZE]; /* parameters, as the kernel has them */
    double g[G_SIZE]; /* inputs as the host gives them */
    double u[U_SIZE]; /* inputs as the kernel has them */
    double z[Z_SIZE]; /* everything that the kernel remembers of the run */
} Model;

#endif
