/* Belt and ice for a page in a browser: BeltIceThermal, reduced, in memory that the page writes.

   As WebAssembly this is a module that imports nothing. Texts are ASCII and end with a zero. */
#include "resources.h"
#include "unit.h"

#define CALLED(name) __attribute__((export_name(#name)))

/* Of one call of `warm`; of a row: time, travel of the surface, running total of the heat, x. */
enum { MOST_ROWS = 1024, TIME = 0, TRAVEL, HEAT, X, WIDTH };

static Model model;
static unsigned char file[sizeof(Tables) + 256];
static double values[VARIABLE_COUNT], rows[WIDTH * MOST_ROWS], outputs[OUTPUT_COUNT * MOST_ROWS];
static double travelled; /* by the last row */
static char text[MESSAGE_SIZE];

CALLED(file) unsigned char *heat_file(void) { return file; }
CALLED(room) int heat_room(void) { return (int)sizeof file; }
CALLED(parameters) double *heat_parameters(void) { return values + FIRST_PARAMETER; }
CALLED(rows) double *heat_rows(void) { return rows; }
CALLED(outputs) double *heat_outputs(void) { return outputs; }

/* Take the matrices of so many bytes of `file`. What is wrong with them, or "". */
CALLED(read) const char *heat_read(int size)
{
    const char *why = tables_in(file, (size_t)size, &model.tables);
    return why == NULL ? "" : why;
}

/* Begin from `parameters`, with the block at x, m. What is not allowed in them, or "". */
CALLED(begin) const char *heat_begin(double x)
{
    text[0] = '\0';
    for (int i = 0; i < INPUT_COUNT; i++) {
        values[FIRST_INPUT + i] = 0.0;
    }
    values[FIRST_INPUT + IN_X] = x;
    travelled = 0.0;
    model_begin(&model, values, 0.0, text);
    return text;
}

/* Go on through so many `rows`, OUTPUT_COUNT `outputs` at each; the number of those that came. */
CALLED(warm) int heat_warm(int count)
{
    for (int i = 0; i < count; i++) {
        const double *row = rows + WIDTH * i;
        double duration = row[TIME] - model_time(&model), *to = outputs + OUTPUT_COUNT * i;
        if (duration > 0.0) {
            values[FIRST_INPUT + IN_SURFACE_SPEED] = (row[TRAVEL] - travelled) / duration;
            values[FIRST_INPUT + IN_HEAT] = row[HEAT];
            values[FIRST_INPUT + IN_X] = row[X];
            if (!model_step(&model, values, row[TIME], NULL, text)) {
                return i;
            }
        }
        travelled = row[TRAVEL];
        for (int k = 0; k < OUTPUT_COUNT; k++) {
            to[k] = values[FIRST_OUTPUT + k];
        }
    }
    return count;
}

/* Why fewer rows came. */
CALLED(why_not) const char *heat_why_not(void) { return text; }
