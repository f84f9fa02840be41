/* Edits as text: what a command line can say, and a program can keep. */
#include <lightsheaf/edit.h>

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/checks.h"

enum { MOST_NUMBERS = 16 };

typedef union description {
    double matrix[16];
    lsf_light_desc light;
    lsf_material_desc material;
} description;

/* A value that can be set: floats of a description. */
static const struct {
    lsf_kind kind;
    const char *name;
    size_t offset;
    int least, most; /* how many numbers it takes; those that are not given stay as they are */
} rows[] = {
    {LSF_KIND_NODE, "matrix", 0, 16, 16},                           /* doubles */
    {LSF_KIND_LIGHT, "type", offsetof(lsf_light_desc, type), 1, 1}, /* a word */
    {LSF_KIND_LIGHT, "intensity", offsetof(lsf_light_desc, intensity), 3, 3},
    {LSF_KIND_LIGHT, "range", offsetof(lsf_light_desc, range), 1, 1},
    {LSF_KIND_LIGHT, "inner_cone", offsetof(lsf_light_desc, inner_cone), 1, 1},
    {LSF_KIND_LIGHT, "outer_cone", offsetof(lsf_light_desc, outer_cone), 1, 1},
    {LSF_KIND_MATERIAL, "base_color", offsetof(lsf_material_desc, base_color), 3, 4},
    {LSF_KIND_MATERIAL, "metallic", offsetof(lsf_material_desc, metallic), 1, 1},
    {LSF_KIND_MATERIAL, "roughness", offsetof(lsf_material_desc, roughness), 1, 1},
    {LSF_KIND_MATERIAL, "emission", offsetof(lsf_material_desc, emission), 3, 3},
    {LSF_KIND_MATERIAL, "ior", offsetof(lsf_material_desc, ior), 1, 1},
    {LSF_KIND_MATERIAL, "transmission", offsetof(lsf_material_desc, transmission), 1, 1},
    {LSF_KIND_MATERIAL, "coat", offsetof(lsf_material_desc, coat), 1, 1},
    {LSF_KIND_MATERIAL, "coat_roughness", offsetof(lsf_material_desc, coat_roughness), 1, 1},
};

static bool bad(const char *edit, const char *why, lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_USAGE,
                         "%s: %s; write an edit as light/0/intensity=3,3,2.5, "
                         "material/NAME/roughness=0.2, environment/rotation=90 or "
                         "node/NAME/matrix= and 16 numbers",
                         edit, why);
}

/* Reads the numbers behind the last "="; -1: they are malformed. */
static int read_numbers(const char *text, double numbers[MOST_NUMBERS])
{
    for (int count = 0; count < MOST_NUMBERS; count++) {
        char *end;
        numbers[count] = lsf_read_number(text, &end);
        if (end == text || (*end != ',' && *end != '\0'))
            return -1;
        if (*end == '\0')
            return count + 1;
        text = end + 1;
    }
    return -1;
}

/* -1: it is none of these words. */
static int type_of(const char *word)
{
    static const char *const words[] = {[LSF_LIGHT_POINT] = "point",
                                        [LSF_LIGHT_SPOT] = "spot",
                                        [LSF_LIGHT_DIRECTIONAL] = "directional"};
    for (size_t i = 0; i < LSF_COUNT(words); i++)
        if (strcmp(words[i], word) == 0)
            return (int)i;
    return -1;
}

static uint32_t find(const lsf_scene *scene, lsf_kind kind, const char *which)
{
    char *end;
    unsigned long index = strtoul(which, &end, 10);
    if (*which && *end == '\0' && index < lsf_scene_count(scene, kind))
        return (uint32_t)index;
    return *which ? lsf_scene_find(scene, kind, which) : LSF_NOT_FOUND;
}

static bool get(const lsf_scene *scene, lsf_kind kind, uint32_t index, description *d,
                lsf_error *error)
{
    return kind == LSF_KIND_NODE    ? lsf_scene_get_node(scene, index, d->matrix, error)
           : kind == LSF_KIND_LIGHT ? lsf_scene_get_light(scene, index, &d->light, error)
                                    : lsf_scene_get_material(scene, index, &d->material, error);
}

static bool set(lsf_scene *scene, lsf_kind kind, uint32_t index, const description *d,
                lsf_error *error)
{
    return kind == LSF_KIND_NODE    ? lsf_scene_set_node(scene, index, d->matrix, error)
           : kind == LSF_KIND_LIGHT ? lsf_scene_set_light(scene, index, &d->light, error)
                                    : lsf_scene_set_material(scene, index, &d->material, error);
}

static bool apply(lsf_scene *scene, const char *edit, size_t row, const char *which,
                  const char *text, lsf_error *error)
{
    double numbers[MOST_NUMBERS];
    lsf_kind kind = rows[row].kind;
    bool word = kind == LSF_KIND_LIGHT && rows[row].offset == offsetof(lsf_light_desc, type);
    int type = word ? type_of(text) : 0;
    if (type < 0)
        return bad(edit, "a light's type is point, spot or directional", error);
    int count = word ? 1 : read_numbers(text, numbers);
    if (count < rows[row].least || count > rows[row].most)
        return bad(edit, count < 0 ? "no list of numbers" : "too few numbers, or too many", error);
    uint32_t index = find(scene, kind, which);
    if (index == LSF_NOT_FOUND)
        return bad(edit, "the scene has none of that name or index", error);
    description d;
    if (!get(scene, kind, index, &d, error))
        return false;
    float *values = (float *)((char *)&d + rows[row].offset);
    if (word)
        d.light.type = (lsf_light_type)type;
    for (int i = 0; !word && i < count; i++)
        if (kind == LSF_KIND_NODE)
            d.matrix[i] = numbers[i];
        else
            values[i] = (float)numbers[i];
    return set(scene, kind, index, &d, error);
}

/* Handles environment/VALUE=NUMBER, which has no index or name. */
static bool edit_environment(lsf_scene *scene, const char *edit, lsf_error *error)
{
    static const struct {
        const char *name;
        bool (*set)(lsf_scene *scene, float value, lsf_error *error);
    } values[] = {{"environment/rotation=", lsf_scene_set_environment_rotation},
                  {"environment/strength=", lsf_scene_set_environment_strength}};
    for (size_t i = 0; i < LSF_COUNT(values); i++) {
        double numbers[MOST_NUMBERS];
        if (strncmp(edit, values[i].name, strlen(values[i].name)) != 0)
            continue;
        if (read_numbers(edit + strlen(values[i].name), numbers) != 1)
            return bad(edit, "not one number", error);
        return values[i].set(scene, (float)numbers[0], error);
    }
    return bad(edit, "nothing that can be set", error);
}

bool lsf_scene_edit(lsf_scene *scene, const char *edit, lsf_error *error)
{
    static const char *const kinds[] = {"node", "light", "material"};
    if (!lsf_scene_given(scene, error) || !lsf_given(edit, "edit", error))
        return false;
    if (strncmp(edit, "environment/", strlen("environment/")) == 0)
        return edit_environment(scene, edit, error);
    char *copy = strdup(edit);
    if (!copy)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for an edit");
    /* Names may contain any character: the separators are the first slash, and the last one
     * before the last sign. */
    char *equals = strrchr(copy, '='), *which = strchr(copy, '/');
    if (equals)
        *equals++ = '\0';
    char *name = equals && which ? strrchr(which, '/') : NULL;
    bool whole = name && name > which;
    bool good = false, known = false;
    if (whole)
        *which++ = *name++ = '\0';
    for (size_t row = 0; whole && !known && row < LSF_COUNT(rows); row++) {
        known = strcmp(kinds[rows[row].kind], copy) == 0 && strcmp(rows[row].name, name) == 0;
        if (known)
            good = apply(scene, edit, row, which, equals, error);
    }
    if (!known)
        bad(edit, whole ? "nothing that can be set" : "not KIND/WHICH/VALUE=NUMBERS", error);
    free(copy);
    return good;
}
