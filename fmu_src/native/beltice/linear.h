/* Small dense matrices, and time integrals of u' = -rate u + p with p constant over a step. */
#ifndef LINEAR_H
#define LINEAR_H

#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* Eigenvalues, rising, and orthonormal eigenvectors, the columns of shapes, of a symmetric matrix,
   which is lost. By rows: a[i * n + j]. */
void eigen(int n, double a[], double values[], double shapes[]);

/* Solve a x = b; the matrix is lost. */
void solve(int n, double a[], double b[]);

double dot(int n, const double a[], const double b[]);

/* Of x = rate * duration: mean of exp(-x) over a step, and mean of the response to p. */
double mean_decay(double x);
double mean_response(double x);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
