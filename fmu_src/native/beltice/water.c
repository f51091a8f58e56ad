#include "water.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846;
static const double DENSITY = 999.8, VISCOSITY = 1.79e-3; /* of water at 0 degC, kg/m3 and Pa s */

double film_available(const Water *water, const Tables *tables, double displacement)
{
    double residences = fabs(displacement) / tables->contact;
    return residences == 0.0 ? water->film : water->film * residences / expm1(residences);
}

/* Melting and shear, then the squeeze; returns the mass that the belt takes along. */
static double advance_film(Water *water, const Tables *tables, const Numbers *numbers,
                           double duration, double displacement, double melted)
{
    double residences = fabs(displacement) / tables->contact, area = tables->area;
    double kept = residences == 0.0 ? 1.0 : -expm1(-residences) / residences;
    double whole = fmax(0.0, water->film + melted);
    double stays = fmin(whole, fmax(0.0, water->film * exp(-residences) + melted * kept));
    double squeeze = 2.0 * (numbers->load / area) * PI / (3.0 * VISCOSITY * area);
    double thickness = stays / (DENSITY * area);
    water->film = stays / sqrt(1.0 + 2.0 * squeeze * thickness * thickness * duration);
    water->squeezed += stays - water->film;
    return whole - stays;
}

/* Lay down a mass evenly where an edge of the contact passes. */
static void lay(Water *water, const Tables *tables, double mass, double edge, double movement)
{
    double cell = belt_cell(tables);
    double edges[2] = {-0.5 * cell, 0.5 * cell}, sum = 0.0;
    Window window;
    set_window(&window, 1, edges, 1.0, edge, movement, cell);
    for (int k = window.begin[0]; k < window.end[0]; k++) {
        sum += window.loads[0][k];
    }
    for (int k = window.begin[0]; k < window.end[0]; k++) {
        water->water[belt_node(tables, window.first + k)] += mass * window.loads[0][k] / sum;
    }
    water->is_wet = true;
}

/* A wiper takes its share off the nodes that come under the block. */
static void wipe(Water *water, const Tables *tables, double edge, double movement, double share)
{
    double cell = belt_cell(tables);
    int first = (int)ceil(fmin(edge, edge + movement) / cell);
    int end = (int)ceil(fmax(edge, edge + movement) / cell);
    for (int i = first; i < end; i++) {
        int node = belt_node(tables, i);
        water->wiped += share * water->water[node];
        water->water[node] *= 1.0 - share;
        water->frozen[node] *= 1.0 - share;
    }
}

/* Water on the nodes below the contact joins the film. */
static void pick_up(Water *water, const Tables *tables, double centre)
{
    double cell = belt_cell(tables), reach = 0.5 * tables->contact / cell - 1.0;
    int first = (int)ceil(centre / cell - reach), last = (int)floor(centre / cell + reach);
    for (int i = first; i <= last; i++) {
        int node = belt_node(tables, i);
        water->film += water->water[node];
        water->water[node] = 0.0;
    }
}

void move_water(Water *water, const Tables *tables, const Numbers *numbers, double duration,
                double displacement, double centre, double mass)
{
    double half = 0.5 * copysign(tables->contact, displacement);
    double left = advance_film(water, tables, numbers, duration, displacement, mass);
    water->melted += mass;
    if (displacement != 0.0 && left > 0.0) {
        lay(water, tables, left, centre + half, -displacement);
    }
    if (!water->is_wet) {
        return;
    }
    if (numbers->wiper != 0.0 && displacement != 0.0) {
        wipe(water, tables, centre - half, -displacement, numbers->wiper);
    }
    pick_up(water, tables, centre - displacement);
}

double all_water(const Water *water, const Tables *tables)
{
    double sum = water->film + water->squeezed + water->wiped;
    for (int i = 0; water->is_wet && i < tables->cells; i++) {
        sum += water->water[i];
    }
    return sum;
}

double freeze_on_belt(Water *water, Belt *belt, const Tables *tables, double duration, double melting,
                      double melt_heat)
{
    double rise = belt_rise(belt, tables, duration), frozen = 0.0;
    for (int i = 0; i < tables->cells; i++) {
        if (water->water[i] == 0.0 && water->frozen[i] == 0.0) {
            continue;
        }
        double wanted = (melting - belt_face(belt, tables, i)) * (duration / (rise * melt_heat));
        double mass = fmin(fmax(wanted, -water->frozen[i]), water->water[i]);
        water->water[i] -= mass;
        water->frozen[i] += mass;
        frozen += mass;
        belt_heat_node(belt, tables, duration, i, mass * melt_heat / duration);
    }
    return frozen * melt_heat / duration * belt_loss(belt, tables, duration);
}
