/* A unit of FMI 3.0 with an event every `period` s, which it announces or not. y = p u, x is the
   integral of u[1] + f, `events` counts rounds at events, `seen` follows n, `high` follows e. */
#include <stdlib.h>
#include <string.h>
#include "fmi3FunctionTypes.h"

enum { U, F, N, B, E, P, ANNOUNCES, PERIOD, Y, X, EVENTS, SEEN, HIGH };

typedef struct {
    double u[2], p[4], x, period, time, next;
    float f;
    unsigned char n, seen;
    bool b, announces;
    int events, rounds, mode; /* 0 before, 1 steps, 2 at an event */
    long long e;
} Memory;
typedef struct { Memory m; bool with_events, may_end_early; fmi3LogMessageCallback log; } Unit;

static fmi3Status refuse(Unit *unit, const char *why)
{
    unit->log(NULL, fmi3Error, "logStatusError", why);
    return fmi3Error;
}

const char *fmi3GetVersion(void) { return "3.0"; }
fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String where,
    fmi3Boolean visible, fmi3Boolean on, fmi3Boolean events, fmi3Boolean early,
    const fmi3ValueReference r[], size_t n, fmi3InstanceEnvironment env, fmi3LogMessageCallback log,
    fmi3IntermediateUpdateCallback update)
{
    (void)token, (void)where, (void)visible, (void)on, (void)r, (void)n, (void)env,
        (void)update;
    if (events && strcmp(name, "without events") == 0) {
        log(NULL, fmi3Error, "logStatusError", "there is no event mode");
        return NULL;
    }
    Unit *unit = calloc(1, sizeof(Unit));
    unit->m = (Memory){.p = {1.0, 2.0, 3.0, 4.0}, .e = 1};
    unit->with_events = events, unit->may_end_early = early, unit->log = log;
    return unit;
}
void fmi3FreeInstance(fmi3Instance c) { free(c); }
fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean d, fmi3Float64 e,
                                       fmi3Float64 start, fmi3Boolean f, fmi3Float64 stop)
{
    (void)d, (void)e, (void)f, (void)stop;
    Memory *m = &((Unit *)c)->m;
    m->time = start, m->next = m->period > 0.0 ? start + m->period : 1e300;
    return fmi3OK;
}
fmi3Status fmi3ExitInitializationMode(fmi3Instance c)
{ Unit *unit = c; unit->m.mode = unit->with_events ? 2 : 1; unit->m.seen = unit->m.n; return fmi3OK; }
fmi3Status fmi3EnterEventMode(fmi3Instance c) { ((Unit *)c)->m.mode = 2; return fmi3OK; }
fmi3Status fmi3EnterStepMode(fmi3Instance c) { ((Unit *)c)->m.mode = 1; return fmi3OK; }
fmi3Status fmi3Terminate(fmi3Instance c) { (void)c; return fmi3OK; }

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, fmi3Boolean *more, fmi3Boolean *ends,
                                    fmi3Boolean *a, fmi3Boolean *b, fmi3Boolean *announced,
                                    fmi3Float64 *next)
{
    Memory *m = &((Unit *)c)->m;
    if (m->mode != 2) return refuse(c, "an update outside event mode");
    *ends = *a = *b = false;
    m->seen = m->n;
    *more = m->time >= m->next - 1e-12 && m->rounds++ == 0; /* an event takes two rounds */
    if (m->rounds == 2) m->events++, m->rounds = 0, m->next += m->period;
    *announced = m->announces && !*more;
    *next = m->next;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 size, fmi3Boolean prior,
                      fmi3Boolean *event, fmi3Boolean *ends, fmi3Boolean *early, fmi3Float64 *last)
{
    (void)prior;
    Unit *unit = c;
    Memory *m = &unit->m;
    double end = time + size;
    if (m->mode != 1) return refuse(c, "a step outside step mode");
    if (unit->with_events && m->announces && end > m->next + 1e-12)
        return refuse(c, "a step over the event that was announced");
    *event = *ends = *early = false;
    if (end > m->next - 1e-12) {
        if (unit->may_end_early && end > m->next + 1e-12) end = m->next, *early = true;
        if (unit->with_events) *event = !m->announces; /* what is announced needs no word */
        else m->events++, m->next += m->period;
    }
    m->x += (m->u[0] + (double)m->f) * (end - time);
    m->time = *last = end;
    return fmi3OK;
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference r[], size_t n,
                          const fmi3Float64 v[], size_t all)
{
    Memory *m = &((Unit *)c)->m;
    const fmi3Float64 *end = v + all;
    for (size_t i = 0; i < n; i++) {
        if (r[i] == U) memcpy(m->u, v, sizeof m->u), v += 2;
        else if (r[i] == P) memcpy(m->p, v, sizeof m->p), v += 4;
        else m->period = *v++;
    }
    return v == end ? fmi3OK : refuse(c, "another number of values");
}
fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Float64 v[],
                          size_t all)
{
    Memory *m = &((Unit *)c)->m;
    fmi3Float64 *end = v + all;
    for (size_t i = 0; i < n; i++) {
        if (r[i] == Y) {
            *v++ = m->p[0] * m->u[0] + m->p[1] * m->u[1];
            *v++ = m->p[2] * m->u[0] + m->p[3] * m->u[1];
        } else *v++ = m->x;
    }
    return v == end ? fmi3OK : refuse(c, "another number of values");
}
fmi3Status fmi3SetFloat32(fmi3Instance c, const fmi3ValueReference r[], size_t n,
                          const fmi3Float32 v[], size_t all)
{ (void)r, (void)n, (void)all; ((Unit *)c)->m.f = v[0]; return fmi3OK; }

static fmi3Status at_an_event(Unit *unit)
{
    const bool wrong = unit->with_events && unit->m.mode == 1;
    return wrong ? refuse(unit, "a discrete input in step mode") : fmi3OK;
}
fmi3Status fmi3SetUInt8(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3UInt8 v[],
                        size_t all)
{
    Unit *unit = c;
    (void)r, (void)n, (void)all;
    unit->m.n = v[0];
    if (!unit->with_events) unit->m.seen = v[0];
    return at_an_event(unit);
}
fmi3Status fmi3GetUInt8(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3UInt8 v[],
                        size_t all)
{ (void)r, (void)n, (void)all; v[0] = ((Unit *)c)->m.seen; return fmi3OK; }
fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference r[], size_t n,
                          const fmi3Boolean v[], size_t all)
{
    (void)all;
    for (size_t i = 0; i < n; i++) {
        if (r[i] == B) { ((Unit *)c)->m.b = v[i]; if (at_an_event(c) != fmi3OK) return fmi3Error; }
        else ((Unit *)c)->m.announces = v[i];
    }
    return fmi3OK;
}
fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Boolean v[],
                          size_t all)
{ (void)r, (void)n, (void)all; v[0] = ((Unit *)c)->m.e == 2; return fmi3OK; }
fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference r[], size_t n, const fmi3Int64 v[],
                        size_t all)
{ (void)r, (void)n, (void)all; ((Unit *)c)->m.e = v[0]; return at_an_event(c); }
fmi3Status fmi3GetInt32(fmi3Instance c, const fmi3ValueReference r[], size_t n, fmi3Int32 v[],
                        size_t all)
{ (void)r, (void)n, (void)all; v[0] = ((Unit *)c)->m.events; return fmi3OK; }

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState *s)
{
    if (*s == NULL) *s = malloc(sizeof(Memory));
    memcpy(*s, &((Unit *)c)->m, sizeof(Memory));
    return fmi3OK;
}
fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState s)
{ memcpy(&((Unit *)c)->m, s, sizeof(Memory)); return fmi3OK; }
fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState *s)
{ (void)c; free(*s); *s = NULL; return fmi3OK; }
fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState s, size_t *n)
{ (void)c, (void)s; *n = sizeof(Memory); return fmi3OK; }
fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState s, fmi3Byte b[], size_t n)
{ (void)c; memcpy(b, s, n); return fmi3OK; }
fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte b[], size_t n, fmi3FMUState *s)
{ (void)c; *s = malloc(n); memcpy(*s, b, n); return fmi3OK; }
