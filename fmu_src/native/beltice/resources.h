/* The unit's resources: where they are, and the file with the matrices of the heat model. */
#ifndef RESOURCES_H
#define RESOURCES_H

#include <stddef.h>

#include "model.h"

#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* Path of a file in a folder that a URI of the scheme "file" names: file:/a, file:///a and
   file://localhost/a, with escapes or without (RFC 3986, RFC 8089); or that a path names, where it is
   no URI. False, with the reason in `message`, for what is none. */
bool path_in(const char *uri, bool is_uri, const char *file, char path[], size_t size, char message[],
             size_t message_size);

/* The matrices of a file that stands in memory. NULL, or what is wrong with it. */
const char *tables_in(const unsigned char bytes[], size_t size, Tables *tables);

/* Read the matrices. False, with the reason in `message`, when the file is not what it must be. */
bool read_tables(Tables *tables, const char *path, char message[], size_t message_size);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
