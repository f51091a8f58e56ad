/* BeltIceThermal, reduced: a step as `BeltIceModel` of thermal/model.py makes it. */
#include "unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "belt.h"
#include "ice.h"
#include "linear.h"
#include "resources.h"
#include "water.h"

/* As in the whole model: longest movement of the contact and distance of entry and exit from it,
   parts of its length; longest recession of the face, m; loops and parts that a step may take; and what
   of a total is rounding. */
static const double MOVEMENT = 1.0 / 16.0, PROBE = 1.0 / 8.0;
static const double LONGEST_RECESSION = 2e-5;
static const double MOST_LOOPS = 1000.0, MOST_PARTS = 1e5, ROUNDING = 1e-12;

enum { MOST_ITERATIONS = 60, MOST_PATH = 4096 };

bool model_read(Model *model, const char *resources, bool is_uri, char message[])
{
    char path[MOST_PATH];
    return path_in(resources, is_uri, "beltice.bin", path, sizeof path, message, MESSAGE_SIZE) &&
           read_tables(&model->tables, path, message, MESSAGE_SIZE);
}

void model_clear(Model *model, double values[])
{
    memset(&model->numbers, 0, sizeof *model - offsetof(Model, numbers));
    memcpy(values + FIRST_PARAMETER, model->tables.starts, sizeof model->tables.starts);
}

/* J that take a kilogram of ice from the air's temperature to water. */
static double melt_heat(const Model *model)
{
    return model->numbers.latent_heat - model->tables.capacity * model->numbers.ambient;
}

static double contact_place(const Model *model)
{
    double length = model->tables.length, place = fmod(0.5 * length - model->place, length);
    return place < 0.0 ? place + length : place;
}

static void show(Model *model, double values[])
{
    const Tables *tables = &model->tables;
    double centre = contact_place(model), ambient = model->numbers.ambient;
    double probe = 0.5 * fmin((1.0 + 2.0 * PROBE) * tables->contact, tables->length);
    double ahead = model->direction * probe;
    double belt = belt_mean(&model->belt, tables, centre), ice = ice_face(&model->ice, tables);
    double *out = values + FIRST_OUTPUT;
    out[OUT_INTERFACE_TEMPERATURE] = ambient + 0.5 * (belt + ice);
    out[OUT_BELT_ENTRY_TEMPERATURE] = ambient + belt_at(&model->belt, tables, centre - ahead);
    out[OUT_BELT_EXIT_TEMPERATURE] = ambient + belt_at(&model->belt, tables, centre + ahead);
    out[OUT_ICE_FACE_TEMPERATURE] = ambient + ice;
    out[OUT_BELT_SHARE] = model->received > 0.0 ? model->to_belt / model->received : 0.0;
    out[OUT_MELT_RATE] = model->melt_rate;
    out[OUT_MELTED_MASS] = model->water.melted;
    out[OUT_HEAT_RECEIVED] = model->received;
    out[OUT_HEAT_STORED] = belt_stored(&model->belt, tables) + ice_stored(&model->ice, tables) +
                           melt_heat(model) * all_water(&model->water, tables);
    out[OUT_HEAT_TO_AIR] = model->to_air;
}

bool model_begin(Model *model, double values[], double tolerance, char message[])
{
    (void)tolerance; /* nothing here is integrated to a tolerance */
    memset(&model->numbers, 0, sizeof *model - offsetof(Model, numbers));
    memcpy(&model->numbers, values + FIRST_PARAMETER, sizeof model->numbers);
    if (model->numbers.ambient >= 0.0) {
        snprintf(message, MESSAGE_SIZE,
                 "ambient.temperature_degC = %g: the block would not be ice; must be below 0",
                 model->numbers.ambient);
        return false;
    }
    belt_begin(&model->belt, &model->tables, model->numbers.belt_film);
    ice_begin(&model->ice, &model->tables, model->numbers.ice_film);
    model->direction = 1.0;
    model->x = model->taken_x = values[FIRST_INPUT + IN_X];
    model->total = values[FIRST_INPUT + IN_HEAT];
    show(model, values);
    return true;
}

/* --- the exchange at the contact, thermal/contact.py --- */

typedef struct {
    double free_mean, free_end, mean_rise, end_rise; /* of the ice's face; K, K m2/W */
    double melting, refreezing;                      /* K above the air, W/m2 */
} Face;

typedef struct {
    double belt[MOST_STRIPS]; /* W/m2 */
    double from_contact, ice, melting;
} Fluxes;

/* Fluxes into the strips for an ice face at `face` - `rise` times their mean through the contact. */
static void solve_strips(const Model *model, const Found *found, double friction, double face,
                         double rise, Fluxes *fluxes)
{
    int n = model->tables.strips;
    double h = model->numbers.belt_film, resistance = 1.0 / model->numbers.conductance;
    double matrix[MOST_STRIPS * MOST_STRIPS], mean_through[MOST_STRIPS] = {0.0}, kept = 0.0;
    double own = model->numbers.belt_side * friction;
    for (int i = 0; i < n; i++) {
        kept += h * found->free[i] / n;
        for (int j = 0; j < n; j++) {
            double through = (i == j ? 1.0 : 0.0) - h * found->response[i * n + j];
            mean_through[j] += through / n;
            matrix[i * n + j] = resistance * through + found->response[i * n + j];
        }
    }
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++) {
            matrix[i * n + j] += rise * mean_through[j];
        }
        fluxes->belt[i] = face - found->free[i] + own * resistance +
                          resistance * h * found->free[i] + rise * kept;
    }
    solve(n, matrix, fluxes->belt);
    fluxes->from_contact = dot(n, mean_through, fluxes->belt) - kept;
}

static void exchange(const Model *model, const Found *found, double friction, const Face *face,
                     Fluxes *fluxes)
{
    double given = friction + face->refreezing;
    solve_strips(model, found, friction, face->free_mean + face->mean_rise * given, face->mean_rise,
                 fluxes);
    fluxes->ice = given - fluxes->from_contact;
    fluxes->melting = -face->refreezing;
    if (face->free_end + face->end_rise * fluxes->ice <= face->melting) {
        return;
    }
    fluxes->ice = (face->melting - face->free_end) / face->end_rise;
    solve_strips(model, found, friction, face->free_mean + face->mean_rise * fluxes->ice, 0.0,
                 fluxes);
    fluxes->melting = friction - fluxes->from_contact - fluxes->ice;
}

/* --- the melting face, thermal/ice/melting.py --- */

/* Fluxes of a step, the load that sinking ice puts on the modes, and how far the face recedes. */
static bool recede(Model *model, const Found *found, const IceStep *step, double friction,
                   double displacement, Fluxes *fluxes, double sinking[], double *recession)
{
    const Tables *tables = &model->tables;
    double area = tables->area, duration = step->duration;
    double volume_heat = tables->volume * melt_heat(model), load = 0.0;
    Face face = {.melting = -model->numbers.ambient};
    face.refreezing = film_available(&model->water, tables, displacement) * melt_heat(model) /
                      (area * duration);
    *recession = model->ice.speed * duration;
    memset(sinking, 0, MOST_ICE * sizeof *sinking);
    for (int i = 0; i < MOST_ITERATIONS; i++) {
        if (*recession != 0.0) {
            ice_sink(&model->ice, tables, step, *recession, load, sinking);
        }
        ice_free(&model->ice, tables, step, sinking, *recession, &face.free_mean, &face.free_end);
        face.mean_rise = step->mean_rise * area / height_ratio(&model->ice, tables, 0.5 * *recession);
        face.end_rise = step->end_rise * area / height_ratio(&model->ice, tables, *recession);
        exchange(model, found, friction, &face, fluxes);
        double before = *recession;
        *recession = fluxes->melting * duration / volume_heat;
        load = fluxes->ice * area;
        if (fabs(*recession - before) <= 1e-17 + 1e-11 * fabs(*recession)) {
            model->ice.speed = *recession / duration;
            if (*recession == 0.0) {
                memset(sinking, 0, MOST_ICE * sizeof *sinking);
            }
            return true;
        }
    }
    return false;
}

/* --- steps --- */

/* What the film below the contact took, J, where in truth there is none: `solve_strips` gives the
   belt that much more. */
static double taken_below(const Model *model, const Found *found, double duration,
                          const double fluxes[])
{
    int n = model->tables.strips;
    double rises = 0.0;
    for (int i = 0; i < n; i++) {
        rises += found->free[i] + dot(n, found->response + i * n, fluxes);
    }
    return model->numbers.belt_film * duration * model->tables.area / n * rises;
}

/* One internal step: what it finds, the fluxes, both fields, the water, the ledger. */
static bool advance(Model *model, double duration, double heat, double displacement, char message[])
{
    const Tables *tables = &model->tables;
    Found found;
    IceStep step;
    Fluxes fluxes;
    double centre = contact_place(model), sinking[MOST_ICE], recession, from_ice;
    belt_conduct(&model->belt, tables, 0.5 * duration);
    belt_find(&model->belt, tables, duration, centre, -displacement, &found);
    ice_prepare(&model->ice, tables, duration, &step);
    if (!recede(model, &found, &step, heat / (duration * tables->area), displacement, &fluxes,
                sinking, &recession)) {
        snprintf(message, MESSAGE_SIZE, "the iteration for the melt rate did not settle in %d passes;"
                 " take a shorter step", MOST_ITERATIONS);
        return false;
    }
    model->to_air += belt_advance(&model->belt, tables, duration, &found.window, fluxes.belt) -
                     taken_below(model, &found, duration, fluxes.belt);
    double each = melt_heat(model);
    if (model->water.is_wet) {
        model->to_air += freeze_on_belt(&model->water, &model->belt, tables, duration,
                                        -model->numbers.ambient, each);
    }
    belt_conduct(&model->belt, tables, 0.5 * duration);
    if (!ice_advance(&model->ice, tables, model->numbers.ice_film, &step, fluxes.ice * tables->area,
                     sinking, recession, &from_ice)) {
        snprintf(message, MESSAGE_SIZE, "the ice has melted: of its %g m less than a twentieth is "
                 "left", tables->height);
        return false;
    }
    move_water(&model->water, tables, &model->numbers, duration, displacement, centre,
               fluxes.melting * tables->area * duration / each);
    model->received += heat;
    model->to_air += from_ice;
    model->to_belt += fluxes.from_contact * tables->area * duration;
    model->place = fmod(model->place + displacement, tables->length);
    return true;
}

/* What a step of the host brings: the increase of `heat` as soon as that has ever changed, before
   `heat_flow` over the step. */
static double brought(Model *model, const double values[], double duration)
{
    double total = values[FIRST_INPUT + IN_HEAT], before = model->total;
    model->total = total;
    model->follows_total = model->follows_total || total != before;
    return model->follows_total ? total - before : values[FIRST_INPUT + IN_HEAT_FLOW] * duration;
}

/* Heat, J, and displacement, m, that a step of the host adds; false where it cannot be. */
static bool added(Model *model, const double values[], double duration, double *heat, double *slid,
                  char message[])
{
    model->heat += brought(model, values, duration);
    model->travel += values[FIRST_INPUT + IN_SURFACE_SPEED] * duration;
    model->x = values[FIRST_INPUT + IN_X];
    *heat = model->heat - model->taken_heat;
    if (*heat < 0.0 && *heat >= -ROUNDING * fabs(model->heat)) {
        *heat = 0.0;
    }
    *slid = (model->travel - model->taken_travel) - (model->x - model->taken_x);
    if (fabs(*slid) <= ROUNDING * (fabs(model->travel) + fabs(model->x))) {
        *slid = 0.0; /* stick; the sign of rounding would tell the belt to run backwards */
    } else {
        model->taken_travel = model->travel;
        model->taken_x = model->x;
    }
    if (*heat < 0.0) {
        snprintf(message, MESSAGE_SIZE, "heat = %.15g J: has fallen by %g J; must not fall, as it is "
                 "the running total of what friction produces", model->total, -*heat);
        return false;
    }
    if (fabs(*slid) > MOST_LOOPS * model->tables.length) {
        snprintf(message, MESSAGE_SIZE, "the belt runs by %g m, more than %g loops of its %g m in one "
                 "step: take shorter steps", *slid, MOST_LOOPS, model->tables.length);
        return false;
    }
    return true;
}

bool model_step(Model *model, double values[], double end, bool *event, char message[])
{
    (void)event; /* nothing here happens at a moment of its own */
    const Tables *tables = &model->tables;
    double duration = end - model->time, heat, slid, melted = model->water.melted;
    if (!added(model, values, duration, &heat, &slid, message)) {
        return false;
    }
    double layers = heat / (tables->area * tables->volume * melt_heat(model) * LONGEST_RECESSION);
    if (!(layers <= MOST_PARTS)) {
        snprintf(message, MESSAGE_SIZE, "heat or heat_flow gives %g J in one step, more than melts "
                 "the block many times over: take shorter steps", heat);
        return false;
    }
    int parts = (int)fmax(fmax(1.0, ceil(layers)), ceil(fabs(slid) / (MOVEMENT * tables->contact)));
    for (int part = 0; part < parts; part++) {
        if (!advance(model, duration / parts, heat / parts, slid / parts, message)) {
            return false;
        }
    }
    if (slid != 0.0) {
        model->direction = copysign(1.0, slid);
    }
    model->taken_heat = fmax(model->heat, model->taken_heat);
    model->melt_rate = (model->water.melted - melted) / duration;
    model->time = end;
    show(model, values);
    return true;
}

double model_time(const Model *model)
{
    return model->time;
}

void model_show_inputs(const Model *model, double values[])
{
    (void)model, (void)values; /* inputs are held */
}

/* --- what this unit has not: tunable parameters, rates of inputs, model exchange --- */

bool model_tune(Model *model, double values[], double tolerance, char message[])
{
    (void)model, (void)values, (void)tolerance, (void)message;
    return true;
}

bool model_warns(const Model *model, const double values[], unsigned *told, char message[])
{
    (void)model, (void)values, (void)told, (void)message;
    return false;
}

void model_set_rate(Model *model, size_t input, double rate)
{
    (void)model, (void)input, (void)rate;
}

void model_show_locals(Model *model, double values[])
{
    (void)model, (void)values;
}

void model_show_moment(Model *model, double values[])
{
    (void)model, (void)values;
}

void model_hand_over(Model *model)
{
    (void)model;
}
