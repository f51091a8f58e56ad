/* A host of model exchange in plain C, FMI 2.0 and 3.0, with an integrator of its own.

       exchange LIBRARY TOKEN VERSION STATES INDICATORS TOLERANCE STOP EVERY INPUT X HEAT COUNT
                [REFERENCE=VALUE ...]  < DRIVE

   Sets the real variables named by value reference, and leads the input INPUT along the drive: on
   each line of that `T VALUE RATE AMPLITUDE FREQUENCY` of a piece, from the time T on

       VALUE + RATE (t - T) + AMPLITUDE sin(FREQUENCY (t - T)).

   The method is that of Dormand and Prince, of order 5 with an error estimate of order 4; the input
   is set at every stage. A change of sign of an event indicator is found by integrating the step
   again, shorter, until it is as short as time can be told. Where the drive jumps the host enters
   event mode by itself; of its kinks it knows nothing. Prints every EVERY seconds, after the events
   there, X, HEAT and COUNT (an integer); on stderr how many steps, rejected ones, events and calls
   for rates it took. */
#include <math.h>
#include <string.h>

#include "fmi2FunctionTypes.h"
#include "fmi3FunctionTypes.h"
#include "library.h"

enum { MOST_STATES = 64, MOST_PIECES = 64, STAGES = 7, MOST_UPDATES = 100, MOST_TRIALS = 200 };

/* What FMI 2 and 3 call alike takes the same in C: a handle, numbers, how many they are. */
typedef int Mode(void *);
typedef int Moment(void *, double);
typedef int Numbers(void *, double[], size_t);
static Mode *ExitInitializationMode, *EnterEventMode, *EnterContinuousTimeMode, *Terminate;
static Moment *SetTime;
static Numbers *SetStates, *GetStates, *GetRates, *GetIndicators, *GetNominals;
static void (*FreeInstance)(void *);

static int version;
static void *library, *block;
static size_t states, indicators;
static double tolerance, stop_time, every;
static unsigned input, shown[3]; /* value references */
static struct { double time, value, rate, amplitude, frequency; } piece[MOST_PIECES];
static int pieces, present; /* the piece of the drive that holds behind the present moment */
static double weight[MOST_STATES], next_event;
static long accepted, rejected, events, calls;

static void *loaded(const char *name)
{
    char full[64];
    snprintf(full, sizeof full, "fmi%d%s", version, name);
    return function(library, full);
}

#define LOAD(pointer, name) *(void **)&pointer = loaded(name)
/* A function of one version, where it is used. */
#define CALL2(name) (*(fmi2##name##TYPE *)loaded(#name))
#define CALL3(name) (*(fmi3##name##TYPE *)loaded(#name))

static void say3(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                 fmi3String message)
{
    (void)environment;
    fprintf(stderr, "%d %s: %s\n", (int)status, category, message);
}

/* --- what differs between the versions --- */

static void *instantiated(const char *token)
{
    static const fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
    if (version == 2) {
        return CALL2(Instantiate)("block", fmi2ModelExchange, token, "", &callbacks, 0, 0);
    }
    return CALL3(InstantiateModelExchange)("block", token, "", 0, 0, NULL, say3);
}

static void set_real(unsigned reference, double value)
{
    check(version == 2 ? (int)CALL2(SetReal)(block, &reference, 1, &value)
                       : (int)CALL3(SetFloat64)(block, &reference, 1, &value, 1));
}

static double real(unsigned reference)
{
    double value;
    check(version == 2 ? (int)CALL2(GetReal)(block, &reference, 1, &value)
                       : (int)CALL3(GetFloat64)(block, &reference, 1, &value, 1));
    return value;
}

static int integer(unsigned reference)
{
    int value;
    check(version == 2 ? (int)CALL2(GetInteger)(block, &reference, 1, &value)
                       : (int)CALL3(GetInt32)(block, &reference, 1, &value, 1));
    return value;
}

static void begin(void)
{
    if (version == 2) {
        check(CALL2(SetupExperiment)(block, 1, tolerance, 0.0, 1, stop_time));
        check(CALL2(EnterInitializationMode)(block));
    } else {
        check(CALL3(EnterInitializationMode)(block, 1, tolerance, 0.0, 1, stop_time));
    }
    check(ExitInitializationMode(block));
}

/* One update in event mode; is another needed? Ends the host where the unit asks for that. */
static bool update(void)
{
    fmi2EventInfo told;
    bool again, end, nominals, values, timed;
    double time;
    if (version == 2) {
        check(CALL2(NewDiscreteStates)(block, &told));
        again = told.newDiscreteStatesNeeded, end = told.terminateSimulation;
        timed = told.nextEventTimeDefined, time = told.nextEventTime;
    } else {
        check(CALL3(UpdateDiscreteStates)(block, &again, &end, &nominals, &values, &timed, &time));
    }
    next_event = timed ? time : INFINITY;
    if (end) {
        exit(4);
    }
    return again;
}

/* Does the end of a step ask for event mode? */
static bool completed(void)
{
    fmi2Boolean event2, end2 = 0;
    bool event = false, end = false;
    if (version == 2) {
        check(CALL2(CompletedIntegratorStep)(block, 1, &event2, &end2));
        event = event2;
    } else {
        check(CALL3(CompletedIntegratorStep)(block, 1, &event, &end));
    }
    if (end || end2) {
        exit(4);
    }
    return event;
}

/* --- the drive --- */

static double drive(int n, double time)
{
    double since = time - piece[n].time;
    return piece[n].value + piece[n].rate * since +
           piece[n].amplitude * sin(piece[n].frequency * since);
}

/* The input at a time before the next jump. */
static double driven(double time)
{
    int n = present;
    while (n + 1 < pieces && time > piece[n + 1].time) {
        n++;
    }
    return drive(n, time);
}

/* Time of the next jump of the drive. */
static double next_jump(void)
{
    for (int n = present + 1; n < pieces; n++) {
        double before = drive(n - 1, piece[n].time), behind = drive(n, piece[n].time);
        if (fabs(behind - before) > 1e-12) {
            return piece[n].time;
        }
    }
    return INFINITY;
}

/* --- the integrator --- */

static void put(double time, double y[])
{
    check(SetTime(block, time));
    set_real(input, driven(time));
    check(SetStates(block, y, states));
}

static void set_rates(double time, double y[], double rates[])
{
    put(time, y);
    check(GetRates(block, rates, states));
    calls++;
}

/* Dormand and Prince (1980): the last row is the solution, and the first stage of the next step. */
static const double NODE[STAGES] = {0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0};
static const double PART[STAGES][STAGES - 1] = {
    {0.0},
    {0.2},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
static const double ERROR[STAGES] = {71.0 / 57600,      0.0,          -71.0 / 16695, 71.0 / 1920,
                                     -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/* A step from y with the rates k[0], to `end`; its error over what is allowed. The unit is left at
   the end of it. */
static double step(double time, const double y[], double size, double k[][MOST_STATES],
                   double end[])
{
    for (int stage = 1; stage < STAGES; stage++) {
        for (size_t i = 0; i < states; i++) {
            double slope = 0.0;
            for (int j = 0; j < stage; j++) {
                slope += PART[stage][j] * k[j][i];
            }
            end[i] = y[i] + size * slope;
        }
        set_rates(time + NODE[stage] * size, end, k[stage]);
    }
    double worst = 0.0;
    for (size_t i = 0; i < states; i++) {
        double error = 0.0;
        for (int j = 0; j < STAGES; j++) {
            error += ERROR[j] * k[j][i];
        }
        double allowed = tolerance * fmax(weight[i], fmax(fabs(y[i]), fabs(end[i])));
        worst = fmax(worst, fabs(size * error) / allowed);
    }
    return worst;
}

/* --- events --- */

/* Least indicator of those that have changed sign since `before`, relative to what it was there:
   above 0 where none has. */
static double remains(const double before[])
{
    double now[MOST_STATES], least = 1.0;
    check(GetIndicators(block, now, indicators));
    for (size_t i = 0; i < indicators; i++) {
        if ((before[i] > 0.0) != (now[i] > 0.0)) {
            double size = fabs(before[i]) > 0.0 ? fabs(before[i]) : 1.0;
            least = fmin(least, -fabs(now[i]) / size);
        } else if (before[i] != 0.0) {
            least = fmin(least, now[i] / before[i]);
        }
    }
    return least;
}

/* Size of the shortest step that leads behind an event which a step of `size` leads behind: by the
   method of Illinois, and by halves where that is slow. The unit and `end` are left there. */
static double size_to_event(double time, const double y[], double size, double k[][MOST_STATES],
                            double end[], const double before[], double at_size)
{
    double low = 0.0, high = size, at_low = 1.0, at_high = at_size, trial = size;
    double finest = 4e-16 * fmax(1.0, fabs(time));
    for (int n = 0; high - low > finest && n < MOST_TRIALS; n++) {
        trial = low + (high - low) * (n % 3 == 2 ? 0.5 : at_low / (at_low - at_high));
        trial = fmin(fmax(trial, low + 0.25 * finest), high - 0.25 * finest);
        step(time, y, trial, k, end);
        double here = remains(before);
        if (here > 0.0) {
            low = trial, at_low = here, at_high *= 0.5;
        } else {
            high = trial, at_high = fmin(here, -1e-300), at_low *= 0.5;
        }
    }
    step(time, y, high, k, end);
    return high;
}

static void handle_event(double time, double y[], double before[])
{
    check(EnterEventMode(block));
    if (time == next_jump()) {
        while (present + 1 < pieces && piece[present + 1].time <= time) {
            present++;
        }
        set_real(input, drive(present, time));
    }
    for (int n = 0; update(); n++) {
        if (n == MOST_UPDATES) {
            exit(5);
        }
    }
    check(EnterContinuousTimeMode(block));
    check(GetStates(block, y, states));
    check(GetNominals(block, weight, states));
    check(GetIndicators(block, before, indicators));
    events++;
}

static void show(void)
{
    printf("%.17g %.17g %d\n", real(shown[0]), real(shown[1]), integer(shown[2]));
}

/* From one time to the next at which something is shown or known to happen; the size of the step
   that is tried next. */
static double advance(double *time, double until, double size, double y[], double before[])
{
    double k[STAGES][MOST_STATES], end[MOST_STATES];
    set_rates(*time, y, k[0]);
    while (*time < until) {
        bool last = *time + 1.01 * size >= until;
        double tried = last ? until - *time : size;
        double error = step(*time, y, tried, k, end);
        size = tried * fmin(5.0, fmax(0.2, 0.9 * pow(fmax(error, 1e-10), -0.2)));
        if (error > 1.0) {
            rejected++;
            continue;
        }
        double at_end = remains(before);
        bool event = at_end <= 0.0;
        if (event) {
            tried = size_to_event(*time, y, tried, k, end, before, at_end);
            last = false;
        }
        *time = last ? until : *time + tried;
        accepted++;
        memcpy(y, end, states * sizeof *y);
        event = completed() || event;
        if (event) {
            handle_event(*time, y, before);
            set_rates(*time, y, k[0]);
            size = fmin(size, 1e-4);
        } else {
            check(GetIndicators(block, before, indicators));
            memcpy(k[0], k[STAGES - 1], states * sizeof *y);
        }
    }
    return size;
}

static void run(void)
{
    double y[MOST_STATES], before[MOST_STATES], time = 0.0, size = 1e-4;
    begin();
    while (update()) {
    }
    check(EnterContinuousTimeMode(block));
    check(GetStates(block, y, states));
    check(GetNominals(block, weight, states));
    check(GetIndicators(block, before, indicators));
    show();
    for (long row = 1; row <= lround(stop_time / every); row++) {
        double sample = (double)row * every;
        while (time < sample) {
            double known = fmin(next_event, next_jump());
            size = advance(&time, fmin(sample, known), size, y, before);
            if (time >= fmin(next_event, next_jump())) {
                handle_event(time, y, before);
            }
        }
        show();
    }
    check(Terminate(block));
}

int main(int count, char *arguments[])
{
    if (count < 13) {
        return 2;
    }
    version = atoi(arguments[3]);
    states = (size_t)atol(arguments[4]), indicators = (size_t)atol(arguments[5]);
    tolerance = atof(arguments[6]), stop_time = atof(arguments[7]), every = atof(arguments[8]);
    input = (unsigned)atol(arguments[9]);
    for (int i = 0; i < 3; i++) {
        shown[i] = (unsigned)atol(arguments[10 + i]);
    }
    while (pieces < MOST_PIECES &&
           scanf("%lf %lf %lf %lf %lf", &piece[pieces].time, &piece[pieces].value,
                 &piece[pieces].rate, &piece[pieces].amplitude, &piece[pieces].frequency) == 5) {
        pieces++;
    }
    if (states > MOST_STATES || indicators > MOST_STATES || pieces == 0) {
        return 2;
    }
    library = opened(arguments[1]);
    LOAD(ExitInitializationMode, "ExitInitializationMode");
    LOAD(EnterEventMode, "EnterEventMode");
    LOAD(EnterContinuousTimeMode, "EnterContinuousTimeMode");
    LOAD(Terminate, "Terminate");
    LOAD(SetTime, "SetTime");
    LOAD(SetStates, "SetContinuousStates");
    LOAD(GetStates, "GetContinuousStates");
    LOAD(GetRates, version == 2 ? "GetDerivatives" : "GetContinuousStateDerivatives");
    LOAD(GetIndicators, "GetEventIndicators");
    LOAD(GetNominals, "GetNominalsOfContinuousStates");
    LOAD(FreeInstance, "FreeInstance");
    block = instantiated(arguments[2]);
    if (block == NULL) {
        return 3;
    }
    for (int i = 13; i < count; i++) {
        set_real((unsigned)atol(arguments[i]), atof(strchr(arguments[i], '=') + 1));
    }
    run();
    FreeInstance(block);
    let_go(library);
    fprintf(stderr, "%ld steps, %ld rejected, %ld events, %ld rates\n", accepted, rejected, events,
            calls);
    return 0;
}
