/* A host of FMI 2.0 co-simulation units in plain C, without Python.

       host LIBRARY GUID STEPS SIZE OUTPUT INSTANCES THREADS [REFERENCE=VALUE ...]

   Each of THREADS threads makes INSTANCES instances, sets the real variables named by value
   reference, and steps all in turn. Prints OUTPUT (a value reference) of the first after every step
   as C's exact hexadecimal, with one instance; else the last value of each; and, on stderr, the
   microseconds of the processor in a step. The environment's RESOURCES is the location of the unit's
   resources. */
#define _POSIX_C_SOURCE 200809L
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmi2FunctionTypes.h"
#include "library.h"

#define FUNCTION(name) static fmi2##name##TYPE *name
FUNCTION(Instantiate);
FUNCTION(FreeInstance);
FUNCTION(SetupExperiment);
FUNCTION(EnterInitializationMode);
FUNCTION(ExitInitializationMode);
FUNCTION(SetReal);
FUNCTION(GetReal);
FUNCTION(DoStep);
FUNCTION(GetFMUstate);
FUNCTION(SetFMUstate);
FUNCTION(FreeFMUstate);
FUNCTION(Terminate);

enum { MOST_SETTINGS = 32 };
static const char *guid;
static long steps, instances;
static double size;
static fmi2ValueReference output;
static size_t settings;
static fmi2ValueReference references[MOST_SETTINGS];
static fmi2Real values[MOST_SETTINGS];

static fmi2Component begun(void)
{
    static const fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
    fmi2Component block = Instantiate("block", fmi2CoSimulation, guid, getenv("RESOURCES"), &callbacks,
                                      fmi2False, fmi2False);
    if (block == NULL) {
        exit(3);
    }
    check(SetReal(block, references, settings, values));
    check(SetupExperiment(block, fmi2False, 0.0, 0.0, fmi2False, 0.0));
    check(EnterInitializationMode(block));
    check(ExitInitializationMode(block));
    return block;
}

/* A state taken and put back every hundred steps, so that leaks of those show as well. */
static void save_and_restore(fmi2Component block)
{
    fmi2FMUstate state = NULL;
    check(GetFMUstate(block, &state));
    check(SetFMUstate(block, state));
    check(FreeFMUstate(block, &state));
}

static double show(fmi2Component block)
{
    fmi2Real value;
    check(GetReal(block, &output, 1, &value));
    return value;
}

static void *run(void *last)
{
    fmi2Component *blocks = calloc((size_t)instances, sizeof *blocks);
    for (long i = 0; i < instances; i++) {
        blocks[i] = begun();
    }
    for (long n = 0; n < steps; n++) {
        for (long i = 0; i < instances; i++) {
            check(DoStep(blocks[i], (double)n * size, size, fmi2True));
            if (n % 100 == 99) {
                save_and_restore(blocks[i]);
            }
        }
        if (last == NULL) {
            printf("%a\n", show(blocks[0]));
        }
    }
    for (long i = 0; i < instances; i++) {
        if (last != NULL) {
            ((double *)last)[i] = show(blocks[i]);
        }
        check(Terminate(blocks[i]));
        FreeInstance(blocks[i]);
    }
    free(blocks);
    return NULL;
}

static void run_threads(long threads)
{
    pthread_t *running = calloc((size_t)threads, sizeof *running);
    double *last = calloc((size_t)(threads * instances), sizeof *last);
    for (long i = 0; i < threads; i++) {
        pthread_create(&running[i], NULL, run, last + i * instances);
    }
    for (long i = 0; i < threads; i++) {
        pthread_join(running[i], NULL);
    }
    for (long i = 0; i < threads * instances; i++) {
        printf("%a\n", last[i]);
    }
    free(last);
    free(running);
}

static double busy(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

int main(int count, char *arguments[])
{
    if (count < 8) {
        return 2;
    }
    void *library = opened(arguments[1]);
#define LOAD(name) *(void **)&name = function(library, "fmi2" #name)
    LOAD(Instantiate);
    LOAD(FreeInstance);
    LOAD(SetupExperiment);
    LOAD(EnterInitializationMode);
    LOAD(ExitInitializationMode);
    LOAD(SetReal);
    LOAD(GetReal);
    LOAD(DoStep);
    LOAD(GetFMUstate);
    LOAD(SetFMUstate);
    LOAD(FreeFMUstate);
    LOAD(Terminate);
    guid = arguments[2];
    steps = atol(arguments[3]);
    size = atof(arguments[4]);
    output = (fmi2ValueReference)atol(arguments[5]);
    instances = atol(arguments[6]);
    for (int i = 8; i < count && settings < MOST_SETTINGS; i++, settings++) {
        references[settings] = (fmi2ValueReference)atol(arguments[i]);
        values[settings] = atof(strchr(arguments[i], '=') + 1);
    }
    long threads = atol(arguments[7]);
    double start = busy();
    if (threads == 1 && instances == 1) {
        run(NULL);
    } else {
        run_threads(threads);
    }
    double each = (busy() - start) / (double)(steps * instances * threads);
    fprintf(stderr, "%.3f us a step\n", 1e6 * each);
    let_go(library);
    return 0;
}
