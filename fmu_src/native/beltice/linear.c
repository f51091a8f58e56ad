#include "linear.h"

#include <math.h>
#include <stdbool.h>

/* Sweeps of Jacobi's method: it converges quadratically, a dozen is more than any matrix needs. */
enum { MOST_SWEEPS = 40 };

/* Rotate rows and columns p and q so that a[p][q] vanishes. */
static void rotate(int n, double a[], double shapes[], int p, int q)
{
    double theta = (a[q * n + q] - a[p * n + p]) / (2.0 * a[p * n + q]);
    double t = (theta >= 0.0 ? 1.0 : -1.0) / (fabs(theta) + sqrt(1.0 + theta * theta));
    double c = 1.0 / sqrt(1.0 + t * t), s = t * c;
    for (int i = 0; i < n; i++) {
        double left = a[i * n + p], right = a[i * n + q];
        a[i * n + p] = c * left - s * right;
        a[i * n + q] = s * left + c * right;
    }
    for (int i = 0; i < n; i++) {
        double upper = a[p * n + i], lower = a[q * n + i];
        a[p * n + i] = c * upper - s * lower;
        a[q * n + i] = s * upper + c * lower;
    }
    for (int i = 0; i < n; i++) {
        double left = shapes[i * n + p], right = shapes[i * n + q];
        shapes[i * n + p] = c * left - s * right;
        shapes[i * n + q] = s * left + c * right;
    }
    a[p * n + q] = a[q * n + p] = 0.0;
}

static void swap_columns(int n, double shapes[], int i, int j)
{
    for (int k = 0; k < n; k++) {
        double kept = shapes[k * n + i];
        shapes[k * n + i] = shapes[k * n + j];
        shapes[k * n + j] = kept;
    }
}

/* Jacobi's method, cyclic (Golub and Van Loan, Matrix Computations, 8.5). */
void eigen(int n, double a[], double values[], double shapes[])
{
    for (int i = 0; i < n * n; i++) {
        shapes[i] = i % (n + 1) == 0 ? 1.0 : 0.0;
    }
    bool is_diagonal = false;
    for (int sweep = 0; !is_diagonal && sweep < MOST_SWEEPS; sweep++) {
        is_diagonal = true;
        for (int p = 0; p < n; p++) {
            for (int q = p + 1; q < n; q++) {
                double size = sqrt(fabs(a[p * n + p] * a[q * n + q]));
                if (fabs(a[p * n + q]) > 1e-16 * size && fabs(a[p * n + q]) > 1e-300) {
                    rotate(n, a, shapes, p, q);
                    is_diagonal = false;
                }
            }
        }
    }
    for (int i = 0; i < n; i++) {
        values[i] = a[i * n + i];
    }
    for (int i = 0; i < n; i++) {
        for (int j = i + 1; j < n; j++) {
            if (values[j] < values[i]) {
                double kept = values[i];
                values[i] = values[j];
                values[j] = kept;
                swap_columns(n, shapes, i, j);
            }
        }
    }
}

/* Gauss, the largest number of each column as pivot. */
void solve(int n, double a[], double b[])
{
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++) {
            pivot = fabs(a[i * n + k]) > fabs(a[pivot * n + k]) ? i : pivot;
        }
        for (int j = 0; j < n; j++) {
            double kept = a[k * n + j];
            a[k * n + j] = a[pivot * n + j];
            a[pivot * n + j] = kept;
        }
        double kept = b[k];
        b[k] = b[pivot];
        b[pivot] = kept;
        for (int i = k + 1; i < n; i++) {
            double factor = a[i * n + k] / a[k * n + k];
            for (int j = k + 1; j < n; j++) {
                a[i * n + j] -= factor * a[k * n + j];
            }
            b[i] -= factor * b[k];
        }
    }
    for (int i = n - 1; i >= 0; i--) {
        for (int j = i + 1; j < n; j++) {
            b[i] -= a[i * n + j] * b[j];
        }
        b[i] /= a[i * n + i];
    }
}

double dot(int n, const double a[], const double b[])
{
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

double mean_decay(double x)
{
    return x == 0.0 ? 1.0 : -expm1(-x) / x;
}

double mean_response(double x)
{
    if (fabs(x) >= 0.7) {
        return (expm1(-x) + x) / (x * x);
    }
    double series = 0.0; /* below, the closed form cancels */
    for (int n = 17; n > 1; n--) {
        series = (1.0 - x * series) / n;
    }
    return series;
}
