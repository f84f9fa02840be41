#include "window/reach.h"

#include "base/base.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { MOST_ROWS = 1024, NAME_SIZE = 128 };

static struct row {
    const char *kind;
    char name[NAME_SIZE];
    bool used;
} rows[MOST_ROWS];
static uint32_t row_count;
static bool counting;

void lsf_reach_start(void)
{
    counting = true;
    row_count = 0;
}

static void name_of(const char *label, char name[NAME_SIZE])
{
    const char *id = strstr(label, "###"), *hidden = strstr(label, "##");
    if (id)
        label = id + 3;
    int length = !id && hidden && hidden > label ? (int)(hidden - label) : NAME_SIZE - 1;
    lsf_print(name, NAME_SIZE, "%.*s", length, label);
}

void lsf_reach_note(const char *kind, const char *label, bool used)
{
    char name[NAME_SIZE];
    uint32_t i = 0;
    if (!counting)
        return;
    name_of(label, name);
    while (i < row_count && (strcmp(rows[i].kind, kind) != 0 || strcmp(rows[i].name, name) != 0))
        i++;
    if (i == MOST_ROWS)
        return;
    if (i == row_count) {
        rows[row_count++] = (struct row){.kind = kind};
        memcpy(rows[i].name, name, sizeof name);
    }
    rows[i].used = rows[i].used || used;
}

void lsf_reach_key(size_t row, const char *keys, bool used)
{
    char name[NAME_SIZE];
    lsf_print(name, sizeof name, "%zu %s", row, keys ? keys : "more");
    lsf_reach_note("key", name, used);
}

bool lsf_reach_write(const char *path, lsf_error *error)
{
    FILE *file = fopen(path, "w");
    for (uint32_t i = 0; file && i < row_count; i++)
        fprintf(file, "%s\t%s\t%s\n", rows[i].used ? "used" : "unused", rows[i].kind, rows[i].name);
    return (file && fclose(file) == 0) ||
           lsf_error_set(error, LSF_ERROR_FILE, "%s: cannot be written: %s", path, strerror(errno));
}
