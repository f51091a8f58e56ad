/* A unit of FMI 2.0 that goes wrong as it is told. x is the integral of u, which may have a slope;
   n follows k, b follows c. From time `at` on, a step does `fault`. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "fmi2Functions.h"

enum { U, K, C, X, N, B, FAULT = 10, AT, TEXT };
enum { NONE, SEGFAULT, HANG, ABORT, EXIT, RESTORES_WRONGLY, PRINTS, LOGS, LOGS_ERROR, DISCARD, FATAL,
       CLOSES, FLOOD };

typedef struct { double u, slope, x, at, reached; int k, c, fault, hidden; } Memory;
typedef struct { Memory m; const fmi2CallbackFunctions *call; } Unit;

static void say(Unit *unit, fmi2Status status, const char *category, const char *text)
{
    unit->call->logger(unit->call->componentEnvironment, "faulty", status, category, "%s", text);
}

const char *fmi2GetTypesPlatform(void) { return "default"; }
const char *fmi2GetVersion(void) { return "2.0"; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String s[])
{ (void)c, (void)on, (void)n, (void)s; return fmi2OK; }

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String where,
                              const fmi2CallbackFunctions *call, fmi2Boolean visible, fmi2Boolean on)
{
    (void)name, (void)type, (void)guid, (void)where, (void)visible, (void)on;
    Unit *unit = calloc(1, sizeof(Unit));
    unit->call = call;
    return unit;
}
void fmi2FreeInstance(fmi2Component c) { free(c); }
fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean d, fmi2Real t, fmi2Real a, fmi2Boolean e,
                               fmi2Real b)
{ (void)c, (void)d, (void)t, (void)a, (void)e, (void)b; return fmi2OK; }
fmi2Status fmi2EnterInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { (void)c; return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { (void)c; return fmi2OK; }

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[])
{
    Memory *m = &((Unit *)c)->m;
    for (size_t i = 0; i < n; i++) v[i] = r[i] == U ? m->u : r[i] == X ? m->x : m->at;
    return fmi2OK;
}
fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Integer v[])
{
    Memory *m = &((Unit *)c)->m;
    for (size_t i = 0; i < n; i++) v[i] = r[i] == FAULT ? m->fault : m->k;
    return fmi2OK;
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Boolean v[])
{ (void)r; for (size_t i = 0; i < n; i++) v[i] = ((Unit *)c)->m.c; return fmi2OK; }
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2String v[])
{ (void)c, (void)r, (void)n, (void)v; return fmi2Error; }

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[])
{
    Memory *m = &((Unit *)c)->m;
    for (size_t i = 0; i < n; i++) *(r[i] == U ? &m->u : r[i] == X ? &m->x : &m->at) = v[i];
    return fmi2OK;
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n,
                          const fmi2Integer v[])
{
    Memory *m = &((Unit *)c)->m;
    for (size_t i = 0; i < n; i++) { if (r[i] == FAULT) m->fault = v[i]; else m->k = v[i]; }
    return fmi2OK;
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference r[], size_t n,
                          const fmi2Boolean v[])
{ (void)r; for (size_t i = 0; i < n; i++) ((Unit *)c)->m.c = v[i]; return fmi2OK; }
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference r[], size_t n,
                         const fmi2String v[])
{ (void)r, (void)n; say(c, fmi2Warning, "texts", v[0]); return fmi2OK; }

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *s)
{
    if (*s == NULL) *s = malloc(sizeof(Memory));
    memcpy(*s, &((Unit *)c)->m, sizeof(Memory));
    return fmi2OK;
}
fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate s)
{
    Memory *m = &((Unit *)c)->m;
    const int hidden = m->hidden;
    memcpy(m, s, sizeof(Memory));
    if (m->fault == RESTORES_WRONGLY) m->hidden = hidden;
    return fmi2OK;
}
fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *s)
{ (void)c; free(*s); *s = NULL; return fmi2OK; }
fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate s, size_t *n)
{ (void)c, (void)s; *n = sizeof(Memory); return fmi2OK; }
fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate s, fmi2Byte b[], size_t n)
{ (void)c; memcpy(b, s, n); return fmi2OK; }
fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte b[], size_t n, fmi2FMUstate *s)
{ (void)c; *s = malloc(n); memcpy(*s, b, n); return fmi2OK; }
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference a[], size_t n,
                                        const fmi2ValueReference b[], size_t o, const fmi2Real d[],
                                        fmi2Real e[])
{ (void)c, (void)a, (void)n, (void)b, (void)o, (void)d, (void)e; return fmi2Error; }

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n,
                                       const fmi2Integer order[], const fmi2Real v[])
{
    for (size_t i = 0; i < n; i++) {
        if (r[i] != U || order[i] != 1) { say(c, fmi2Error, "", "only u, order 1"); return fmi2Error; }
        ((Unit *)c)->m.slope = v[i];
    }
    return fmi2OK;
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference r[], size_t n,
                                        const fmi2Integer o[], fmi2Real v[])
{ (void)c, (void)r, (void)n, (void)o, (void)v; return fmi2Error; }

static fmi2Status go_wrong(Unit *unit, double time, double size)
{
    switch (unit->m.fault) {
    case SEGFAULT: { volatile int *nowhere = NULL; *nowhere = 1; } break;
    case HANG: for (;;) sleep(1);
    case ABORT: fprintf(stderr, "the unit's last words\n"); abort();
    case EXIT: _exit(3);
    case PRINTS: printf("a line of the unit\n"); fflush(stdout); fprintf(stderr, "another\n"); break;
    case LOGS: say(unit, fmi2OK, "debug", "all is well"); say(unit, fmi2Warning, "heat", "warm");
        break;
    case LOGS_ERROR: say(unit, fmi2Error, "heat", "too hot"); break;
    case DISCARD: unit->m.reached = time + 0.5 * size; return fmi2Discard;
    case FATAL: say(unit, fmi2Fatal, "", "broken for good"); return fmi2Fatal;
    case CLOSES: for (int fd = 3; fd < 100; fd++) close(fd); for (;;) sleep(1);
    case FLOOD: for (int i = 0; i < 100000; i++) printf("line %d of a flood\n", i); fflush(stdout);
        break;
    default: break;
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean prior)
{
    (void)prior;
    Unit *unit = c;
    Memory *m = &unit->m;
    if (time >= m->at) {
        const fmi2Status status = go_wrong(unit, time, size);
        if (status != fmi2OK) return status;
    }
    m->hidden++;
    m->x += m->u * size + 0.5 * m->slope * size * size;
    m->u += m->slope * size;
    if (m->fault == RESTORES_WRONGLY) m->x += 1e-12 * m->hidden;
    return fmi2OK;
}
fmi2Status fmi2CancelStep(fmi2Component c) { (void)c; return fmi2Error; }
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind k, fmi2Status *v)
{ (void)c, (void)k, (void)v; return fmi2Discard; }
fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind k, fmi2Real *v)
{ (void)k; *v = ((Unit *)c)->m.reached; return fmi2OK; }
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind k, fmi2Integer *v)
{ (void)c, (void)k, (void)v; return fmi2Discard; }
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind k, fmi2Boolean *v)
{ (void)c, (void)k, (void)v; return fmi2Discard; }
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind k, fmi2String *v)
{ (void)c, (void)k, (void)v; return fmi2Discard; }
