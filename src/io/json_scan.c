#include "io/json_scan.h"

#include <stdbool.h>

lsf_json_shape lsf_json_scan(const char *text, size_t length)
{
    lsf_json_shape shape = {0};
    uint64_t depth = 0;
    bool quoted = false;
    for (size_t i = 0; i < length; i++) {
        char c = text[i];
        if (quoted) {
            if (c == '\\')
                i++;
            else if (c == '"')
                quoted = false;
        } else if (c == '"') {
            quoted = true;
            shape.strings++;
        } else if (c == ',') {
            shape.commas++;
        } else if (c == '[' || c == '{') {
            if (c == '{')
                shape.objects++;
            else
                shape.arrays++;
            depth++;
            if (depth > shape.depth)
                shape.depth = depth;
        } else if ((c == ']' || c == '}') && depth > 0) {
            depth--;
        }
    }
    return shape;
}

void lsf_json_location(const char *text, size_t length, size_t offset, uint64_t *line,
                       uint64_t *column)
{
    *line = 1;
    *column = 1;
    for (size_t i = 0; i < offset && i < length; i++) {
        if (text[i] == '\n') {
            ++*line;
            *column = 1;
        } else {
            ++*column;
        }
    }
}
