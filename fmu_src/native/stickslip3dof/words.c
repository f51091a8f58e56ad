#include "words.h"

#include <stdio.h>

#include "kernel.h"
#include "unit.h"

bool find_contradiction(const double v[], char text[], size_t size)
{
    int beyond = (int)stickslip_beyond_numbers(v);
    if (beyond >= 0) {
        const char *name = VARIABLES[FIRST_PARAMETER + beyond].name;
        snprintf(text, size, "%s = %g: %s", name, v[beyond], COMPUTABLE);
        return true;
    }
    int code = (int)stickslip_contradiction(v);
    if (code == NO_CONTRADICTION) {
        return false;
    }
    const Sentence *said = &CONTRADICTIONS[code];
    snprintf(text, size, said->form, v[said->values[0]], v[said->values[1]]); /* or one, or none */
    return true;
}
