/* Random numbers as Python's `random.Random(seed)` draws them. */
#ifndef DRAWS_H
#define DRAWS_H

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* The kernel's array d, D_SIZE numbers, by the seeds among the parameters v. */
void draw(double d[], const double v[]);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
