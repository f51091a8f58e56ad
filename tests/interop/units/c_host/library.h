/* A library loaded by a host in C, on Linux and on Windows; what goes wrong ends the host. */
#ifndef LIBRARY_H
#define LIBRARY_H

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

#ifdef _WIN32
static void *symbol(void *library, const char *name)
{
    return (void *)GetProcAddress(library, name);
}

static void let_go(void *library)
{
    FreeLibrary(library);
}

static void *opened(const char *file)
{
    void *library = LoadLibraryA(file);
    if (library == NULL) {
        fprintf(stderr, "%s: error %lu of Windows\n", file, GetLastError());
        exit(1);
    }
    return library;
}
#else
static void *symbol(void *library, const char *name)
{
    return dlsym(library, name);
}

static void let_go(void *library)
{
    dlclose(library);
}

static void *opened(const char *file)
{
    void *library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        fprintf(stderr, "%s: %s\n", file, dlerror());
        exit(1);
    }
    return library;
}
#endif

static void *function(void *library, const char *name)
{
    void *found = symbol(library, name);
    if (found == NULL) {
        fprintf(stderr, "%s: not in the library\n", name);
        exit(1);
    }
    return found;
}

/* What a unit of FMI 2 has to say. */
static void say(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                fmi2String category, fmi2String message, ...)
{
    va_list arguments;
    (void)environment;
    fprintf(stderr, "%s %d %s: ", name, (int)status, category);
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

/* The status that all calls return: 0 in FMI 2 and in FMI 3 where a call is carried out. */
static void check(int status)
{
    if (status != 0) {
        exit(3);
    }
}

#endif
