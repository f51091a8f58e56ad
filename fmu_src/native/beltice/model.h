/* BeltIceThermal, reduced: the memory of a run of the heat model.

   Temperatures inside are rises above the air, K. SI units. The block stands still and the belt runs
   to greater x; positions on the belt are its material's. */
#ifndef MODEL_H
#define MODEL_H

#include <stdbool.h>
#include <stdint.h>

/* What there is room for: plain memory has one size. */
enum {
    MOST_CELLS = 4096,  /* along the belt */
    MOST_FIELD = 32768, /* cells times modes */
    MOST_MODES = 16,    /* trial functions through the thickness of the belt */
    MOST_ICE = 40,      /* trial functions of the block */
    MOST_STRIPS = 32,   /* of the contact, across the belt */
    MOST_WINDOW = 256,  /* nodes below the contact in one step */
    STARTS = 8          /* parameters of the unit, all of which the resources set */
};

/* What the file in the resources holds, in its order behind the header. */
typedef struct {
    int cells, modes, ice, strips;
    double length, lane, contact, area; /* of the belt; width and length of the contact; m, m2 */
    double height, volume, capacity;    /* block: height m; density kg/m3; J/(kg K) */
    double starts[STARTS];
    double conduction[MOST_MODES * MOST_MODES], film[MOST_MODES * MOST_MODES];
    double along[MOST_MODES * MOST_MODES], face[MOST_MODES];
    double across[MOST_ICE * MOST_ICE], upwards[MOST_ICE * MOST_ICE];
    double side[MOST_ICE * MOST_ICE], top[MOST_ICE * MOST_ICE], sinking[MOST_ICE * MOST_ICE];
    double front[MOST_ICE]; /* contact face of the ice */
    double belt_heat[MOST_MODES], ice_heat[MOST_ICE]; /* stored by amplitude 1: J/m, J */
} Tables;

/* The belt: modes through the thickness at each node along it. */
typedef struct {
    double rates[MOST_MODES], along[MOST_MODES], face[MOST_MODES];
    double heat[MOST_MODES], air[MOST_MODES]; /* stored, J/m; given to the air, W/m */
    double field[MOST_FIELD]; /* amplitudes, the modes of a node side by side */
} Belt;

/* The ice: modes that belong to one height of the block. */
typedef struct {
    double melted, fitted; /* depths, m: by which the face has receded, for which the modes are */
    double speed;          /* of the receding face in the last step, m/s */
    double rates[MOST_ICE], shapes[MOST_ICE * MOST_ICE], front[MOST_ICE];
    double sinking[MOST_ICE * MOST_ICE];
    double heat[MOST_ICE], air[MOST_ICE]; /* stored, J; given to the air, W */
    double amplitudes[MOST_ICE];
} Ice;

/* Water between ice and belt, and water and ice on the belt, kg. */
typedef struct {
    double film, melted;    /* below the block; what the ice has lost */
    double squeezed, wiped; /* water out at the sides of the block; off the belt */
    bool is_wet; /* whether there is anything on the belt */
    double water[MOST_CELLS], frozen[MOST_CELLS];
} Water;

typedef struct {
    double ambient, belt_film, ice_film, latent_heat, conductance, belt_side, wiper, load;
} Numbers;

typedef struct {
    Tables tables;
    Numbers numbers;
    Belt belt;
    Ice ice;
    Water water;
    double time;
    double heat, travel, x;                   /* what has crossed the ports: J, m, m */
    double total;                             /* of the input `heat` as it was last, J */
    bool follows_total;                       /* `heat` has changed: heat_flow does not count */
    double taken_heat, taken_travel, taken_x; /* what of it is in the temperatures */
    double place;                             /* how far the belt has run below the block, m */
    double direction;                         /* of the last movement: 1 or -1 */
    double received, to_belt, to_air;         /* friction heat, the belt's part of it; air's; J */
    double melt_rate;                         /* kg/s, mean over the last step */
} Model;

#endif
