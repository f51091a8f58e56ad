/* Sentences for what is refused, made of `stickslip/words.toml`, and where they are said. */
#ifndef WORDS_H
#define WORDS_H

#include <stdbool.h>
#include <stddef.h>

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* A sentence as printf takes it, and where in `v` the values in it are. */
typedef struct {
    const char *form;
    int values[2];
} Sentence;

/* By what `stickslip_contradiction` returns; and of a value that is too small or too large. */
extern const Sentence CONTRADICTIONS[];
extern const char COMPUTABLE[];

/* Why `advance` gave up, by its status. */
extern const char *const WHY_NOT[];

/* Are there parameters that cannot be? Says why, with the values in it. */
bool find_contradiction(const double v[], char text[], size_t size);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
