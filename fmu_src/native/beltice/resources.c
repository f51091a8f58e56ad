#include "resources.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#if defined(_WIN32)
#include <windows.h>
#endif

enum { HEADER = 64, SUM_AT = 48, VERSION = 2, ORDER = 0x01020304 };

static bool starts_with(const char *text, const char *small)
{
    while (*small != '\0' && tolower((unsigned char)*text) == *small) {
        text++;
        small++;
    }
    return *small == '\0';
}

static int hexadecimal(char digit)
{
    const char *digits = "0123456789abcdef";
    const char *found = digit == '\0' ? NULL : strchr(digits, tolower((unsigned char)digit));
    return found == NULL ? -1 : (int)(found - digits);
}

/* Text without escapes; NULL, or why not. A percent sign that escapes nothing stands for no text. */
static const char *unescape(const char *text, char path[], size_t size)
{
    size_t at = 0;
    for (; *text != '\0'; text++) {
        int value = (unsigned char)*text;
        if (*text == '%') {
            int high = hexadecimal(text[1]), low = high < 0 ? -1 : hexadecimal(text[2]);
            if (low < 0) {
                return "a % in it is not followed by two hexadecimal digits";
            }
            value = 16 * high + low;
            text += 2;
        }
        if (value == 0) {
            return "it has a zero byte in it";
        }
        if (at + 1 >= size) {
            return "it is too long";
        }
        path[at++] = (char)value;
    }
    path[at] = '\0';
    return NULL;
}

/* Where the path begins in a URI; NULL, and why, when it names no file of this machine. */
static const char *path_of(const char *uri, const char **why)
{
    if (!starts_with(uri, "file:")) {
        *why = "it does not begin with file:";
        return NULL;
    }
    const char *path = uri + strlen("file:");
    if (path[0] == '/' && path[1] == '/') {
        path += 2;
        path += starts_with(path, "localhost/") ? strlen("localhost") : 0;
        if (path[0] != '/') {
            *why = "it names another machine than this";
            return NULL;
        }
    }
    if (path[0] != '/') {
        *why = "its path is not absolute";
        return NULL;
    }
#if defined(_WIN32)
    if (isalpha((unsigned char)path[1]) && (path[2] == ':' || path[2] == '|')) {
        path += 1; /* the drive's letter */
    }
#endif
    return path;
}

bool path_in(const char *uri, bool is_uri, const char *file, char path[], size_t size, char message[],
             size_t message_size)
{
    if (uri == NULL) {
        snprintf(message, message_size, "the location of the unit's resources is not given");
        return false;
    }
    const char *why = NULL, *begin = is_uri ? path_of(uri, &why) : uri;
    if (begin != NULL && is_uri) {
        why = unescape(begin, path, size);
    } else if (begin != NULL) {
        why = uri[0] == '\0' ? "it is empty" : strlen(uri) >= size ? "it is too long" : NULL;
        strncpy(path, uri, size - 1);
        path[size - 1] = '\0';
    }
    if (why == NULL && strlen(path) + strlen(file) + 2 > size) {
        why = "it is too long";
    }
    if (why != NULL) {
        snprintf(message, message_size, "%.500s: not a location of resources that can be used: %s",
                 uri, why);
        return false;
    }
    size_t end = strlen(path);
    if (path[end - 1] != '/' && (is_uri || path[end - 1] != '\\')) {
        strcat(path, "/");
    }
    strcat(path, file);
#if defined(_WIN32)
    if (path[1] == '|') {
        path[1] = ':';
    }
#endif
    return true;
}

static FILE *opened(const char *path)
{
#if defined(_WIN32)
    wchar_t wide[2048];
    if (MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, 2048) == 0) {
        return NULL;
    }
    return _wfopen(wide, L"rb");
#else
    return fopen(path, "rb");
#endif
}

/* --- the file --- */

typedef struct {
    const unsigned char *next;
    size_t left;
    bool is_good;
} Reader;

/* FNV-1a of 64 bits. */
static uint64_t added_to(uint64_t sum, const unsigned char bytes[], size_t size)
{
    for (size_t i = 0; i < size; i++) {
        sum = (sum ^ bytes[i]) * 1099511628211u;
    }
    return sum;
}

static void take(Reader *reader, size_t count, double numbers[])
{
    size_t size = count * sizeof(double);
    if (!reader->is_good || reader->left < size) {
        reader->is_good = false;
        return;
    }
    memcpy(numbers, reader->next, size);
    reader->next += size;
    reader->left -= size;
    for (size_t i = 0; i < count; i++) {
        reader->is_good = reader->is_good && isfinite(numbers[i]);
    }
}

static bool is_between(int value, int low, int high)
{
    return value >= low && value <= high;
}

static bool fits(const Tables *t)
{
    return is_between(t->cells, 8, MOST_CELLS) && is_between(t->modes, 1, MOST_MODES) &&
           (long)t->cells * t->modes <= MOST_FIELD && is_between(t->ice, 1, MOST_ICE) &&
           is_between(t->strips, 1, MOST_STRIPS);
}

/* Whether the step's longest window of nodes has room, and does not meet itself around the loop. */
static bool has_window(const Tables *t)
{
    double nodes = 1.125 * t->contact / (t->length / t->cells) + 6.0;
    return t->length > 0.0 && t->contact > 0.0 && nodes <= MOST_WINDOW && nodes <= t->cells;
}

static void take_all(Reader *reader, Tables *t)
{
    size_t modes = (size_t)t->modes, ice = (size_t)t->ice;
    double *scalars[] = {&t->length, &t->lane,   &t->contact, &t->area,
                         &t->height, &t->volume, &t->capacity};
    for (size_t i = 0; i < sizeof scalars / sizeof *scalars; i++) {
        take(reader, 1, scalars[i]);
    }
    take(reader, STARTS, t->starts);
    take(reader, modes * modes, t->conduction);
    take(reader, modes * modes, t->film);
    take(reader, modes * modes, t->along);
    take(reader, modes, t->face);
    take(reader, ice * ice, t->across);
    take(reader, ice * ice, t->upwards);
    take(reader, ice * ice, t->side);
    take(reader, ice * ice, t->top);
    take(reader, ice * ice, t->sinking);
    take(reader, ice, t->front);
    take(reader, modes, t->belt_heat);
    take(reader, ice, t->ice_heat);
}

const char *tables_in(const unsigned char bytes[], size_t size, Tables *tables)
{
    uint32_t order, version;
    uint64_t sum;
    int32_t sizes[4];
    if (size < HEADER || memcmp(bytes, "BELTICE", 8) != 0) {
        return "it is no file of this unit";
    }
    memcpy(&order, bytes + 8, sizeof order);
    memcpy(&version, bytes + 12, sizeof version);
    memcpy(sizes, bytes + 16, sizeof sizes);
    memcpy(&sum, bytes + SUM_AT, sizeof sum);
    if (order != ORDER || version != VERSION) {
        return "it is of another version, or for machines that write numbers in another order";
    }
    int *into[] = {&tables->cells, &tables->modes, &tables->ice, &tables->strips};
    for (int i = 0; i < 4; i++) {
        *into[i] = sizes[i];
    }
    if (!fits(tables)) {
        return "its sizes are beyond what this unit has room for";
    }
    Reader reader = {.next = bytes + HEADER, .left = size - HEADER, .is_good = true};
    take_all(&reader, tables);
    uint64_t found = added_to(added_to(14695981039346656037u, bytes, SUM_AT), bytes + HEADER,
                              size - HEADER);
    if (!reader.is_good || found != sum || reader.left != 0) {
        return "it is damaged";
    }
    return has_window(tables) ? NULL : "its contact is too long for its cells or its belt";
}

bool read_tables(Tables *tables, const char *path, char message[], size_t message_size)
{
    /* room for all numbers of Tables, and a byte more, by which a longer file is known */
    unsigned char bytes[HEADER + sizeof(Tables) + 1];
    FILE *file = opened(path);
    if (file == NULL) {
        snprintf(message, message_size, "%.500s: cannot be read", path);
        return false;
    }
    const char *why = tables_in(bytes, fread(bytes, 1, sizeof bytes, file), tables);
    fclose(file);
    if (why != NULL) {
        snprintf(message, message_size, "%.500s: %s", path, why);
    }
    return why == NULL;
}
