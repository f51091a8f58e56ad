/* StickSlip3DOF: the kernel as a unit. Parameters stand in `values` in the kernel's order, `V_...`,
   from FIRST_PARAMETER on, inputs from FIRST_INPUT on as `U_...`. */
#include "unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draws.h"
#include "words.h"

static bool pack_parameters(Model *model, const double values[], double tolerance, char message[])
{
    double v[V_SIZE], d[D_SIZE];
    memcpy(v, values + FIRST_PARAMETER, sizeof v);
    if (find_contradiction(v, message, MESSAGE_SIZE)) {
        return false;
    }
    if (tolerance > 0.0) {
        double tighter = fmax(tolerance, VARIABLES[FIRST_PARAMETER + V_SOLVER_TOLERANCE].low);
        v[V_SOLVER_TOLERANCE] = fmin(v[V_SOLVER_TOLERANCE], tighter);
    }
    draw(d, v);
    stickslip_pack(v, d, model->p);
    return true;
}

static void take_values(Model *model, const double values[])
{
    memcpy(model->g + G_VALUE, values + FIRST_INPUT, GIVEN_INPUTS * sizeof(double));
}

/* Inputs and their rates at the time for which a host of model exchange asks for something. */
static void follow_inputs(Model *model, const double values[], bool for_rates, bool for_events)
{
    take_values(model, values);
    stickslip_follow_inputs(model->p, model->g, model->u, model_time(model), for_rates, for_events);
}

void model_hear_input(Model *model, bool in_event)
{
    stickslip_hear_input(model->g, model_time(model), in_event);
}

void model_look_aside(Model *model, size_t input, double by)
{
    model->g[G_ASIDE + input] = by;
}

void model_set_rate(Model *model, size_t input, double rate)
{
    model->g[G_RATE + input] = rate;
    model->g[G_HAS_RATE + input] = 1.0;
}

/* --- what no rig bears, though the model goes on: see WATCHED in cosim/fmu/variables.py --- */

static double longest_spring(const Model *model)
{
    double longest = 0.0;
    for (int i = 0; i < 4; i++) {
        longest = fmax(longest, stickslip_spring_length(model->p, model->z, SHOWN, i));
    }
    return longest;
}

/* As it is now; whether that is otherwise than it was seen last. */
static bool look(const Model *model, const double values[], double seen[])
{
    double width = values[BELT_WIDTH], most = values[SPRINGS_LONGEST];
    bool is_belt = values[FIRST_PARAMETER + V_TURNING_SURFACE_CURVATURE] == 0.0 && width > 0.0;
    seen[0] = is_belt && fabs(model->z[SHOWN + Y]) > 0.5 * width;
    seen[1] = most > 0.0 && longest_spring(model) > most * model->p[P_NATURAL_LENGTH];
    return seen[0] != model->watched[0] || seen[1] != model->watched[1];
}

static void show_watched(const Model *model, double values[])
{
    values[OFF_BELT] = model->watched[0];
    values[SPRING_OVERSTRETCHED] = model->watched[1];
}

static void show_outputs(Model *model, double w[], double values[])
{
    double o[O_SIZE];
    stickslip_show(model->p, model->u, model->z, w, o, 0);
    for (int i = 0; i < OUTPUT_COUNT - WATCHED_COUNT; i++) {
        values[FIRST_OUTPUT + i] = o[OUTPUT_SLOTS[i]];
    }
    look(model, values, model->watched);
    show_watched(model, values);
}

static bool go_on(Model *model, double values[], double end, bool *event, char message[])
{
    double w[W_SIZE] = {0.0}, e[E_FIRST] = {0.0};
    int status;
    if (event == NULL) {
        status = (int)stickslip_advance(model->p, model->u, model->z, w, e, end);
    } else {
        status = (int)stickslip_advance_to_event(model->p, model->u, model->z, w, e, end);
        *event = status == MODE_CHANGED;
    }
    if (status != DONE && status != MODE_CHANGED) {
        snprintf(message, MESSAGE_SIZE, "no way to %g s after the start: %s", end, WHY_NOT[status]);
        return false;
    }
    show_outputs(model, w, values);
    return true;
}

bool model_read(Model *model, const char *resources, bool is_uri, char message[])
{
    (void)model, (void)resources, (void)is_uri, (void)message; /* all there is stands in the library */
    return true;
}

void model_clear(Model *model, double values[])
{
    (void)values;
    memset(model, 0, sizeof *model);
}

bool model_begin(Model *model, double values[], double tolerance, char message[])
{
    if (!pack_parameters(model, values, tolerance, message)) {
        return false;
    }
    memset(model->g + G_BEFORE, 0, (G_SIZE - G_BEFORE) * sizeof(double));
    model->g[G_FIRST] = values[INPUT_HOLD];
    take_values(model, values);
    memset(model->u, 0, sizeof model->u);
    memcpy(model->u, values + FIRST_INPUT, GIVEN_INPUTS * sizeof(double));
    stickslip_initialise(model->p, model->z, 0.0);
    return go_on(model, values, 0.0, NULL, message);
}

bool model_step(Model *model, double values[], double end, bool *event, char message[])
{
    double now = model->z[SHOWN + TIME];
    take_values(model, values);
    stickslip_lead_inputs(model->g, model->u, model->z[SHOWN + MODE] == STICK, now, end - now);
    if (!go_on(model, values, end, event, message)) {
        return false;
    }
    if (model_time(model) < end) {
        stickslip_cut_inputs(model->g, model->u, model_time(model));
    }
    return true;
}

double model_time(const Model *model)
{
    return model->z[SHOWN + TIME];
}

void model_show_inputs(const Model *model, double values[])
{
    double now = model_time(model);
    values[FIRST_INPUT + U_SPEED] = stickslip_driven_speed(model->u, now);
    values[FIRST_INPUT + U_FORCE_X] = stickslip_input_at(model->u, U_FORCE_X, now);
    values[FIRST_INPUT + U_FORCE_Y] = stickslip_input_at(model->u, U_FORCE_Y, now);
    values[FIRST_INPUT + U_MOMENT] = stickslip_input_at(model->u, U_MOMENT, now);
}

bool model_tune(Model *model, double values[], double tolerance, char message[])
{
    double before = stickslip_block_energy(model->p, model->z, SHOWN);
    if (!pack_parameters(model, values, tolerance, message)) {
        return false;
    }
    /* A contact that is stiffer from now on holds more: whoever tunes it has put that in. */
    model->z[Z_ENERGY] += stickslip_block_energy(model->p, model->z, SHOWN) - before;
    model->z[Z_INPUTS] = NAN; /* the kernel starts afresh from here, as after a change of inputs */
    return true;
}

bool model_warns(const Model *model, const double values[], unsigned *told, char message[])
{
    enum { CREEPS = 1, LEFT_BELT = 2, STRETCHED = 4 };
    const double *p = model->p;
    double creep = p[P_PRESLIDING] * fmax(p[P_MU_S], p[P_MU_K]) * p[P_NORMAL_FORCE];
    double speed = fabs(values[FIRST_INPUT + U_SPEED]), time = model_time(model);
    unsigned before = *told;
    if (!(*told & CREEPS) && speed != 0.0 && speed <= creep) {
        *told |= CREEPS;
        snprintf(message, MESSAGE_SIZE,
                 "surface_speed = %g m/s is not above friction.stick_creep = %g m/s: the contact "
                 "creeps as fast as the surface and never breaks away; its mode stays 0",
                 speed, creep);
    } else if (!(*told & LEFT_BELT) && model->watched[0] != 0.0) {
        *told |= LEFT_BELT;
        snprintf(message, MESSAGE_SIZE,
                 "off_belt: the block has left the belt %g s after the start: its centre is %g m "
                 "aside, the edge of belt.width = %g m is at %g m; the motion from here on is none "
                 "of a rig",
                 time, fabs(model->z[SHOWN + Y]), values[BELT_WIDTH], 0.5 * values[BELT_WIDTH]);
    } else if (!(*told & STRETCHED) && model->watched[1] != 0.0) {
        *told |= STRETCHED;
        snprintf(message, MESSAGE_SIZE,
                 "spring_overstretched: a spring is %g m long %g s after the start, more than "
                 "springs.longest = %g times its %g m without load",
                 longest_spring(model), time, values[SPRINGS_LONGEST], p[P_NATURAL_LENGTH]);
    }
    return *told != before;
}

static void show_states_and_rates(const Model *model, const double rates[], double values[])
{
    double states[2 * EXCHANGED];
    stickslip_take_states(model->z, states);
    memcpy(states + EXCHANGED, rates, EXCHANGED * sizeof *rates);
    for (int i = 0; i < LOCAL_COUNT; i++) {
        values[FIRST_LOCAL + i] = states[LOCAL_SLOTS[i]];
    }
}

void model_show_locals(Model *model, double values[])
{
    double w[W_SIZE] = {0.0}, rates[EXCHANGED];
    stickslip_set_ramp(model->p, model->z);
    stickslip_set_exchanged_rates(model->p, model->u, model->z, w, rates);
    show_states_and_rates(model, rates, values);
}

/* --- model exchange --- */

void model_hand_over(Model *model)
{
    double w[W_SIZE] = {0.0};
    stickslip_begin_memory(model->g, model->u, model_time(model));
    stickslip_begin_exchange(model->p, model->u, model->z, w);
}

void model_put_time(Model *model, double time)
{
    model->z[SHOWN + TIME] = time;
}

void model_put_states(Model *model, const double states[])
{
    stickslip_put_states(model->z, states);
}

void model_take_states(const Model *model, double states[])
{
    stickslip_take_states(model->z, states);
}

void model_nominals(const Model *model, const double values[], double nominals[])
{
    stickslip_set_nominals(model->p, values + FIRST_INPUT, nominals);
}

void model_rates(Model *model, const double values[], double rates[])
{
    double w[W_SIZE] = {0.0};
    follow_inputs(model, values, true, false);
    stickslip_set_exchanged_rates(model->p, model->u, model->z, w, rates);
}

void model_indicators(Model *model, const double values[], double indicators[])
{
    double w[W_SIZE] = {0.0};
    follow_inputs(model, values, false, true);
    stickslip_set_indicators(model->p, model->u, model->z, w, indicators);
    bool sticks = model->z[SHOWN + MODE] == STICK;
    double now = model_time(model);
    double reserve = stickslip_course_reserve(model->p, model->u, model->g, now, sticks);
    indicators[INDICATOR_COUNT - 1] = fmin(indicators[INDICATOR_COUNT - 1], reserve);
}

void model_show_moment(Model *model, double values[])
{
    double w[W_SIZE] = {0.0}, o[O_SIZE], rates[EXCHANGED];
    follow_inputs(model, values, false, false);
    stickslip_show_moment(model->p, model->u, model->z, w, rates, o);
    for (int i = 0; i < OUTPUT_COUNT - WATCHED_COUNT; i++) {
        values[FIRST_OUTPUT + i] = o[OUTPUT_SLOTS[i]];
    }
    show_watched(model, values); /* of the last event: a Boolean changes at no other time */
    show_states_and_rates(model, rates, values);
}

void model_update(Model *model, const double values[])
{
    double w[W_SIZE] = {0.0}, e[E_FIRST] = {0.0};
    take_values(model, values);
    bool sticks = model->z[SHOWN + MODE] == STICK;
    bool anew = stickslip_take_given(model->p, model->g, model->u, model_time(model), sticks);
    anew = anew || isnan(model->z[Z_INPUTS]); /* see model_tune */
    memcpy(model->z + Z_INPUTS, model->u, sizeof model->u);
    stickslip_update_event(model->p, model->u, model->z, w, e, anew);
    look(model, values, model->watched);
}

double model_next_event(const Model *model)
{
    return model->z[Z_RAMPING] == 1.0 ? model->p[P_RUN_UP] : INFINITY;
}

bool model_complete_step(Model *model, const double values[], bool *event, char message[])
{
    double w[W_SIZE] = {0.0};
    follow_inputs(model, values, false, true);
    model->g[G_ACCEPTED] = model_time(model);
    int status = (int)stickslip_complete_step(model->p, model->u, model->z, w);
    double seen[WATCHED_COUNT];
    *event = look(model, values, seen) || status == MODE_CHANGED;
    if (status != DONE && status != MODE_CHANGED) {
        snprintf(message, MESSAGE_SIZE, "no way on from %g s after the start: %s",
                 model->z[SHOWN + TIME], WHY_NOT[status]);
        return false;
    }
    return true;
}
