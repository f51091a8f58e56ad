#include "ice.h"

#include <math.h>
#include <string.h>

#include "linear.h"

/* Change of the height, relative, that the modes bear, and part of the first height that has to be
   left: as in the whole model. */
static const double TOLERANCE = 2e-4, LEAST_HEIGHT = 0.05;

double height_ratio(const Ice *ice, const Tables *tables, double recession)
{
    return 1.0 - (ice->melted + recession) / tables->height;
}

/* Modes for a depth to which the face has receded. */
static void diagonalise(Ice *ice, const Tables *tables, double film, double depth)
{
    int n = tables->ice;
    double ratio = 1.0 - depth / tables->height, matrix[MOST_ICE * MOST_ICE];
    ice->fitted = depth;
    for (int i = 0; i < n * n; i++) {
        matrix[i] = tables->across[i] + tables->upwards[i] / (ratio * ratio) +
                    film * (tables->side[i] + tables->top[i] / ratio);
    }
    eigen(n, matrix, ice->rates, ice->shapes);
    const double *shapes = ice->shapes;
    for (int m = 0; m < n; m++) {
        double moved[MOST_ICE];
        ice->front[m] = ice->heat[m] = ice->air[m] = 0.0;
        for (int i = 0; i < n; i++) {
            ice->front[m] += tables->front[i] * shapes[i * n + m];
            ice->heat[m] += tables->ice_heat[i] * shapes[i * n + m];
            moved[i] = 0.0;
            for (int j = 0; j < n; j++) {
                double taken = film * (tables->side[i * n + j] + tables->top[i * n + j] / ratio);
                ice->air[m] += shapes[i * n + m] * taken * tables->ice_heat[j];
                moved[i] += tables->sinking[i * n + j] * shapes[j * n + m];
            }
        }
        for (int k = 0; k < n; k++) {
            ice->sinking[k * n + m] = 0.0;
            for (int i = 0; i < n; i++) {
                ice->sinking[k * n + m] += shapes[i * n + k] * moved[i];
            }
        }
    }
}

void ice_begin(Ice *ice, const Tables *tables, double film)
{
    memset(ice, 0, sizeof *ice);
    diagonalise(ice, tables, film, 0.0);
}

void ice_prepare(const Ice *ice, const Tables *tables, double duration, IceStep *step)
{
    step->duration = duration;
    step->mean_rise = step->end_rise = 0.0;
    for (int m = 0; m < tables->ice; m++) {
        double x = ice->rates[m] * duration, square = ice->front[m] * ice->front[m];
        step->decay[m] = exp(-x);
        step->mean[m] = mean_decay(x);
        step->held[m] = duration * step->mean[m];
        step->held_mean[m] = duration * mean_response(x);
        step->mean_rise += square * step->held_mean[m];
        step->end_rise += square * step->held[m];
    }
}

void ice_free(const Ice *ice, const Tables *tables, const IceStep *step, const double sinking[],
              double recession, double *mean, double *end)
{
    *mean = *end = 0.0;
    for (int m = 0; m < tables->ice; m++) {
        *mean += ice->front[m] *
                 (ice->amplitudes[m] * step->mean[m] + step->held_mean[m] * sinking[m]);
        *end += ice->front[m] * (ice->amplitudes[m] * step->decay[m] + step->held[m] * sinking[m]);
    }
    *mean /= height_ratio(ice, tables, 0.5 * recession);
    *end /= height_ratio(ice, tables, recession);
}

static double after(const Ice *ice, const IceStep *step, double load, const double sinking[], int m)
{
    return ice->amplitudes[m] * step->decay[m] +
           step->held[m] * (ice->front[m] * load + sinking[m]);
}

void ice_sink(const Ice *ice, const Tables *tables, const IceStep *step, double recession,
              double load, double sinking[])
{
    int n = tables->ice;
    double middle[MOST_ICE];
    double speed = recession / (step->duration * height_ratio(ice, tables, 0.5 * recession));
    for (int m = 0; m < n; m++) {
        middle[m] = 0.5 * (ice->amplitudes[m] + after(ice, step, load, sinking, m));
    }
    for (int k = 0; k < n; k++) {
        sinking[k] = speed * dot(n, ice->sinking + k * n, middle);
    }
}

/* Form the modes of another depth; the field stays what it is. */
static void fit(Ice *ice, const Tables *tables, double film, double depth)
{
    int n = tables->ice;
    double field[MOST_ICE];
    for (int i = 0; i < n; i++) {
        field[i] = dot(n, ice->shapes + i * n, ice->amplitudes);
    }
    diagonalise(ice, tables, film, depth);
    for (int m = 0; m < n; m++) {
        ice->amplitudes[m] = 0.0;
        for (int i = 0; i < n; i++) {
            ice->amplitudes[m] += ice->shapes[i * n + m] * field[i];
        }
    }
}

bool ice_advance(Ice *ice, const Tables *tables, double film, const IceStep *step, double load,
                 const double sinking[], double recession, double *to_air)
{
    *to_air = 0.0;
    for (int m = 0; m < tables->ice; m++) {
        double forced = step->held_mean[m] * (ice->front[m] * load + sinking[m]);
        *to_air += step->duration * ice->air[m] * (ice->amplitudes[m] * step->mean[m] + forced);
        ice->amplitudes[m] = after(ice, step, load, sinking, m);
    }
    ice->melted += recession;
    if (height_ratio(ice, tables, 0.0) < LEAST_HEIGHT) {
        return false;
    }
    double bears = TOLERANCE * (tables->height - ice->fitted), gone = ice->melted - ice->fitted;
    if (fabs(gone) > bears) {
        fit(ice, tables, film, ice->melted + copysign(bears, gone));
    }
    return true;
}

double ice_stored(const Ice *ice, const Tables *tables)
{
    return dot(tables->ice, ice->heat, ice->amplitudes);
}

double ice_face(const Ice *ice, const Tables *tables)
{
    return dot(tables->ice, ice->front, ice->amplitudes) / height_ratio(ice, tables, 0.0);
}
