#include "belt.h"

#include <math.h>
#include <string.h>

#include "linear.h"

/* Conduction along the belt is stepped by differences between neighbours; of a step, at most this
   part of what makes them unstable. */
static const double STABLE = 0.2;

double belt_cell(const Tables *tables)
{
    return tables->length / tables->cells;
}

int belt_node(const Tables *tables, int node)
{
    int wrapped = node % tables->cells;
    return wrapped < 0 ? wrapped + tables->cells : wrapped;
}

void belt_begin(Belt *belt, const Tables *tables, double film)
{
    int n = tables->modes;
    double matrix[MOST_MODES * MOST_MODES], shapes[MOST_MODES * MOST_MODES];
    memset(belt, 0, sizeof *belt);
    for (int i = 0; i < n * n; i++) {
        matrix[i] = tables->conduction[i] + film * tables->film[i];
    }
    eigen(n, matrix, belt->rates, shapes);
    for (int m = 0; m < n; m++) {
        for (int i = 0; i < n; i++) {
            belt->face[m] += tables->face[i] * shapes[i * n + m];
            belt->heat[m] += tables->belt_heat[i] * shapes[i * n + m];
            for (int j = 0; j < n; j++) {
                /* a film takes of each function what it takes of a belt that is as warm all over */
                belt->air[m] += film * shapes[i * n + m] * tables->film[i * n + j] *
                                tables->belt_heat[j];
                belt->along[m] += shapes[i * n + m] * tables->along[i * n + j] * shapes[j * n + m];
            }
        }
    }
}

/* Third integral of an edge of height 1 that moves, mean over the movement; x: from the edge. */
static double integral(double x, double movement)
{
    double past = fmax(x, 0.0), moved = fmax(x - movement, 0.0);
    double share = 1.0;
    if (past == 0.0 || moved == 0.0) {
        share = (past - moved) / (movement != 0.0 ? movement : 1.0);
    }
    return share * (past * past + past * moved + moved * moved) / 6.0;
}

/* The same on the hat function about x, but for a factor. */
static double hat(double x, double movement, double cell)
{
    return integral(x - cell, movement) - 2.0 * integral(x, movement) + integral(x + cell, movement);
}

void set_window(Window *window, int strips, const double edges[], double lane, double centre,
                double movement, double cell)
{
    double low = centre + fmin(movement, 0.0), high = centre + fmax(movement, 0.0);
    window->first = (int)floor((low + edges[0]) / cell);
    window->count = (int)ceil((high + edges[strips]) / cell) - window->first + 1;
    for (int s = 0; s < strips; s++) {
        double sum = 0.0, area = (edges[s + 1] - edges[s]) * lane;
        window->begin[s] = (int)floor((low + edges[s]) / cell) - window->first;
        window->end[s] = (int)ceil((high + edges[s + 1]) / cell) - window->first + 1;
        for (int k = window->begin[s]; k < window->end[s]; k++) {
            double x = (window->first + k) * cell - centre - edges[s];
            double wide = edges[s + 1] - edges[s];
            window->loads[s][k] = hat(x, movement, cell) - hat(x - wide, movement, cell);
            sum += window->loads[s][k];
        }
        for (int k = window->begin[s]; k < window->end[s]; k++) {
            window->loads[s][k] *= area / sum;
        }
    }
}

static void contact_window(Window *window, const Tables *tables, double centre, double movement)
{
    double edges[MOST_STRIPS + 1];
    for (int s = 0; s <= tables->strips; s++) {
        edges[s] = tables->contact * ((double)s / tables->strips - 0.5);
    }
    set_window(window, tables->strips, edges, tables->lane, centre, movement, belt_cell(tables));
}

/* Mean over a step of a node's face, K, for 1 W that goes in there. */
static double mean_rise(const Belt *belt, const Tables *tables, double duration)
{
    double sum = 0.0;
    for (int m = 0; m < tables->modes; m++) {
        sum += belt->face[m] * belt->face[m] * mean_response(belt->rates[m] * duration);
    }
    return sum * duration / belt_cell(tables);
}

void belt_find(const Belt *belt, const Tables *tables, double duration, double centre,
               double movement, Found *found)
{
    int modes = tables->modes, strips = tables->strips;
    Window *window = &found->window;
    contact_window(window, tables, centre, movement);
    double weights[MOST_MODES], means[MOST_WINDOW];
    for (int m = 0; m < modes; m++) {
        weights[m] = belt->face[m] * mean_decay(belt->rates[m] * duration);
    }
    for (int k = 0; k < window->count; k++) {
        const double *node = belt->field + belt_node(tables, window->first + k) * modes;
        means[k] = dot(modes, weights, node);
    }
    double area = tables->area / strips, rise = mean_rise(belt, tables, duration) / area;
    for (int s = 0; s < strips; s++) {
        int begin = window->begin[s], count = window->end[s] - begin;
        found->free[s] = dot(count, window->loads[s] + begin, means + begin) / area;
        for (int r = 0; r <= s; r++) {
            int both = window->end[r] - begin; /* nodes of this strip that the other has too */
            double value = both <= 0 ? 0.0 : rise * dot(both, window->loads[s] + begin,
                                                        window->loads[r] + begin);
            found->response[s * strips + r] = found->response[r * strips + s] = value;
        }
    }
}

/* A part of a step, small enough; `ratios` of the modes. */
static void conduct_part(double field[], int cells, int modes, const double ratios[])
{
    double first[MOST_MODES], before[MOST_MODES];
    memcpy(first, field, modes * sizeof *field);
    memcpy(before, field + (cells - 1) * modes, modes * sizeof *field);
    for (int i = 0; i < cells; i++) {
        double *here = field + i * modes;
        const double *after = i + 1 < cells ? here + modes : first;
        for (int m = 0; m < modes; m++) {
            double kept = here[m];
            here[m] = kept + ratios[m] * (before[m] - 2.0 * kept + after[m]);
            before[m] = kept;
        }
    }
}

void belt_conduct(Belt *belt, const Tables *tables, double duration)
{
    double square = belt_cell(tables) * belt_cell(tables), ratios[MOST_MODES], largest = 0.0;
    for (int m = 0; m < tables->modes; m++) {
        ratios[m] = belt->along[m] * duration / square;
        largest = fmax(largest, ratios[m]);
    }
    int parts = (int)ceil(largest / STABLE);
    for (int m = 0; m < tables->modes; m++) {
        ratios[m] /= parts > 0 ? parts : 1;
    }
    for (int part = 0; part < parts; part++) {
        conduct_part(belt->field, tables->cells, tables->modes, ratios);
    }
}

/* Sums of the amplitudes over all nodes. */
static void add_up(const Belt *belt, const Tables *tables, double sums[])
{
    memset(sums, 0, MOST_MODES * sizeof *sums);
    for (int i = 0; i < tables->cells; i++) {
        const double *node = belt->field + i * tables->modes;
        for (int m = 0; m < tables->modes; m++) {
            sums[m] += node[m];
        }
    }
}

double belt_stored(const Belt *belt, const Tables *tables)
{
    double sums[MOST_MODES];
    add_up(belt, tables, sums);
    return belt_cell(tables) * dot(tables->modes, belt->heat, sums);
}

/* Decay without flux; heat to the air, J. */
static double relax(Belt *belt, const Tables *tables, double duration)
{
    double decay[MOST_MODES], sums[MOST_MODES], to_air = 0.0;
    add_up(belt, tables, sums);
    for (int m = 0; m < tables->modes; m++) {
        double x = belt->rates[m] * duration;
        decay[m] = exp(-x);
        to_air += belt->air[m] * sums[m] * duration * mean_decay(x);
    }
    for (int i = 0; i < tables->cells; i++) {
        double *node = belt->field + i * tables->modes;
        for (int m = 0; m < tables->modes; m++) {
            node[m] *= decay[m];
        }
    }
    return belt_cell(tables) * to_air;
}

double belt_loss(const Belt *belt, const Tables *tables, double duration)
{
    double sum = 0.0;
    for (int m = 0; m < tables->modes; m++) {
        sum += belt->air[m] * belt->face[m] * mean_response(belt->rates[m] * duration);
    }
    return sum * duration * duration;
}

/* Amplitude at the end of a step for 1 W on a node. */
static double forced(const Belt *belt, const Tables *tables, double duration, int mode)
{
    double mean = mean_decay(belt->rates[mode] * duration);
    return belt->face[mode] * duration * mean / belt_cell(tables);
}

double belt_advance(Belt *belt, const Tables *tables, double duration, const Window *window,
                    const double fluxes[])
{
    int modes = tables->modes;
    double entering[MOST_MODES], power = 0.0;
    for (int m = 0; m < modes; m++) {
        entering[m] = forced(belt, tables, duration, m);
    }
    double to_air = relax(belt, tables, duration);
    for (int s = 0; s < tables->strips; s++) {
        for (int k = window->begin[s]; k < window->end[s]; k++) {
            double load = fluxes[s] * window->loads[s][k];
            power += load;
            double *node = belt->field + belt_node(tables, window->first + k) * modes;
            for (int m = 0; m < modes; m++) {
                node[m] += entering[m] * load;
            }
        }
    }
    return to_air + power * belt_loss(belt, tables, duration);
}

double belt_rise(const Belt *belt, const Tables *tables, double duration)
{
    double rise = 0.0;
    for (int m = 0; m < tables->modes; m++) {
        rise += belt->face[m] * forced(belt, tables, duration, m);
    }
    return rise;
}

void belt_heat_node(Belt *belt, const Tables *tables, double duration, int node, double power)
{
    for (int m = 0; m < tables->modes; m++) {
        belt->field[node * tables->modes + m] += forced(belt, tables, duration, m) * power;
    }
}

double belt_face(const Belt *belt, const Tables *tables, int node)
{
    return dot(tables->modes, belt->face, belt->field + belt_node(tables, node) * tables->modes);
}

double belt_at(const Belt *belt, const Tables *tables, double place)
{
    double nodes = place / belt_cell(tables);
    int node = (int)floor(nodes);
    double part = nodes - node;
    return (1.0 - part) * belt_face(belt, tables, node) + part * belt_face(belt, tables, node + 1);
}

double belt_mean(const Belt *belt, const Tables *tables, double centre)
{
    Window window;
    double sum = 0.0;
    contact_window(&window, tables, centre, 0.0);
    for (int s = 0; s < tables->strips; s++) {
        for (int k = window.begin[s]; k < window.end[s]; k++) {
            sum += window.loads[s][k] * belt_face(belt, tables, window.first + k);
        }
    }
    return sum / tables->area;
}
