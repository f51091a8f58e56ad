/* The block of ice: modes of a small Galerkin space, and its face that melts away.

   The equations are those of thermal/assembly.py and thermal/ice/body.py: the unknown is the
   temperature times the height ratio, the present height over that at the start. */
#ifndef ICE_H
#define ICE_H

#include "model.h"

#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* What a step of some duration does. */
typedef struct {
    double duration;
    double decay[MOST_ICE], mean[MOST_ICE], held[MOST_ICE], held_mean[MOST_ICE];
    double mean_rise, end_rise; /* of the face for 1 W, at the height of the modes, K/W */
} IceStep;

void ice_begin(Ice *ice, const Tables *tables, double film);
void ice_prepare(const Ice *ice, const Tables *tables, double duration, IceStep *step);

/* Height ratio after the face has receded by another depth, m. */
double height_ratio(const Ice *ice, const Tables *tables, double recession);

/* The face without flux, mean over the step and at its end, under a load on the modes; K. */
void ice_free(const Ice *ice, const Tables *tables, const IceStep *step, const double sinking[],
              double recession, double *mean, double *end);

/* Load on the modes from ice that sinks towards a face that recedes (m) under a load (W) on the
   contact; sinking: an estimate, which is replaced. */
void ice_sink(const Ice *ice, const Tables *tables, const IceStep *step, double recession,
              double load, double sinking[]);

/* Advance, with what goes to the air, J; false when less than a twentieth of the block is left. */
bool ice_advance(Ice *ice, const Tables *tables, double film, const IceStep *step, double load,
                 const double sinking[], double recession, double *to_air);

/* Heat in the block above the air's temperature, J. */
double ice_stored(const Ice *ice, const Tables *tables);

double ice_face(const Ice *ice, const Tables *tables);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
