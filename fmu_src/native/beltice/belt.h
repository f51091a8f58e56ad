/* The belt: columns through the thickness, side by side along the loop. */
#ifndef BELT_H
#define BELT_H

#include "model.h"

#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* The contact's strips on consecutive nodes, as mean over a movement: `loads[strip][node]`, m2, for
   nodes of the window from `begin` to before `end` of a strip. */
typedef struct {
    int first, count; /* first node, unwrapped */
    int begin[MOST_STRIPS], end[MOST_STRIPS];
    double loads[MOST_STRIPS][MOST_WINDOW];
} Window;

/* What a step finds below the contact: step-mean of the face over each strip without flux, K, and
   its response to fluxes, strips by strips, K m2/W. */
typedef struct {
    Window window;
    double free[MOST_STRIPS];
    double response[MOST_STRIPS * MOST_STRIPS];
} Found;

double belt_cell(const Tables *tables);
int belt_node(const Tables *tables, int node); /* wrapped onto the loop */

/* Modes for a heat transfer of the free faces, W/m2K; the whole belt at the air's temperature. */
void belt_begin(Belt *belt, const Tables *tables, double film);

/* Strips between edges (count + 1 of them, m from the centre), on nodes `cell` apart. */
void set_window(Window *window, int strips, const double edges[], double lane, double centre,
                double movement, double cell);

/* A step of a contact that moves from `centre`. */
void belt_find(const Belt *belt, const Tables *tables, double duration, double centre,
               double movement, Found *found);

/* Conduction along the belt over a time, s; of a step, half before all else and half behind it. */
void belt_conduct(Belt *belt, const Tables *tables, double duration);

/* Heat in the belt above the air's temperature, J. */
double belt_stored(const Belt *belt, const Tables *tables);

/* Advance under fluxes (strips) W/m2, without conduction along the belt; what its faces give to the
   air, J, as if all of both were free. */
double belt_advance(Belt *belt, const Tables *tables, double duration, const Window *window,
                  const double fluxes[]);

/* Rise of the face for 1 W on every node over a step, K/W; heat that goes to the air for 1 W into
   the face, J/W; heat (W on a node) that freezes there. */
double belt_rise(const Belt *belt, const Tables *tables, double duration);
double belt_loss(const Belt *belt, const Tables *tables, double duration);
void belt_heat_node(Belt *belt, const Tables *tables, double duration, int node, double power);

/* The face at a node, and at a place, m, between two nodes. */
double belt_face(const Belt *belt, const Tables *tables, int node);
double belt_at(const Belt *belt, const Tables *tables, double place);
double belt_mean(const Belt *belt, const Tables *tables, double centre); /* over the contact */

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
