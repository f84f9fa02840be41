#include "window/reach.h"

#include "base/base.h"

#include <string.h>

enum { MOST_ROWS = 1024 };

static lsf_reach_row rows[MOST_ROWS];
static uint32_t row_count;
static bool counting;

void lsf_reach_start(void)
{
    counting = true;
    row_count = 0;
}

static void name_of(const char *label, char name[128])
{
    const char *id = strstr(label, "###"), *hidden = strstr(label, "##");
    if (id)
        label = id + 3;
    int length = !id && hidden && hidden > label ? (int)(hidden - label) : 127;
    lsf_print(name, 128, "%.*s", length, label);
}

void lsf_reach_note(const char *kind, const char *label, bool used)
{
    char name[128];
    uint32_t i = 0;
    if (!counting)
        return;
    name_of(label, name);
    while (i < row_count && (rows[i].kind != kind || strcmp(rows[i].name, name) != 0))
        i++;
    if (i == MOST_ROWS)
        return;
    if (i == row_count) {
        rows[row_count++] = (lsf_reach_row){.kind = kind};
        memcpy(rows[i].name, name, sizeof name);
    }
    rows[i].used = rows[i].used || used;
}

const lsf_reach_row *lsf_reach_at(uint32_t index)
{
    return index < row_count ? &rows[index] : NULL;
}
