/* What becomes of ice that melts: a film below the block, water and ice on the belt.

   The equations are those of thermal/contact.py. */
#ifndef WATER_H
#define WATER_H

#include "belt.h"

#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* Most mass (kg) of the film that can freeze over a step in which the belt moves (m). */
double film_available(const Water *water, const Tables *tables, double displacement);

/* All water that there is, kg: below the block, beside it, on the belt, off it. */
double all_water(const Water *water, const Tables *tables);

/* Freeze and thaw on the belt, whose field is that of a step's end without it; what of that goes to
   the air, J. melting: the melting point, K above the air; melt_heat: J/kg. */
double freeze_on_belt(Water *water, Belt *belt, const Tables *tables, double duration, double melting,
                      double melt_heat);

/* Move the water of a step in which `mass` (kg) melted, the contact being at `centre` before it. */
void move_water(Water *water, const Tables *tables, const Numbers *numbers, double duration,
                double displacement, double centre, double mass);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
