#include "tools/value.h"

#include "base/base.h"
#include "tools/number.h"
#include "tools/preset.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

/* A point light of X,Y,Z,R,G,B. */
static bool add_light(lsf_lights_setting *lights, const lsf_command_option *option,
                      const char *text)
{
    float v[6];
    void *items = lights->items;
    if (!lsf_parse_numbers(text, option->minimum, option->maximum, 6, v) ||
        !lsf_grow(&items, &lights->capacity, (uint64_t)lights->count + 1, sizeof *lights->items))
        return false;
    lights->items = items;
    lights->items[lights->count++] = (lsf_placed_light){
        .light = {.type = LSF_LIGHT_POINT, .intensity = {v[3], v[4], v[5]}, .range = INFINITY},
        .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, (double)v[0], (double)v[1], (double)v[2],
                   1}};
    return true;
}

static void *target_of(lsf_settings *settings, const lsf_command_option *option)
{
    return (char *)settings + option->offset;
}

bool lsf_list_append(lsf_list_setting *list, const char *item)
{
    void *items = (void *)list->items;
    if (!lsf_grow(&items, &list->capacity, (uint64_t)list->count + 1, sizeof *list->items))
        return false;
    list->items = items;
    list->items[list->count++] = item;
    return true;
}

static bool bad_value(const lsf_command_option *option, const char *text, const char *meant,
                      lsf_error *error)
{
    char *range = lsf_command_option_range(option);
    lsf_error_set(error, LSF_ERROR_USAGE, "--%s %s: expected %s%s%s%s", option->name,
                  *text ? text : "\"\"", range ? range : "another value",
                  meant ? "; did you mean " : "", meant ? meant : "", meant ? "?" : "");
    free(range);
    return false;
}

static bool append_value(lsf_list_setting *target, const lsf_command_option *option,
                         const char *text, lsf_error *error)
{
    return lsf_list_append(target, text) ||
           lsf_error_set(error, LSF_ERROR_RENDER, "--%s %s: no memory left", option->name, text);
}

static const char *next_technique(size_t index, void *user)
{
    (void)user;
    return lsf_technique_name((uint32_t)index);
}

static const char *next_key(size_t index, void *user)
{
    lsf_option *option = user;
    return lsf_option_list((uint32_t)index, option) ? option->key : NULL;
}

static const char *next_aov(size_t index, void *user)
{
    (void)user;
    return index < LSF_AOV_COUNT ? lsf_aov_name(1u << index) : NULL;
}

static bool set_choice(int *target, const lsf_command_option *option, const char *text)
{
    int value = (int)option->minimum;
    for (const char *choice = option->choices;; value++) {
        size_t length = strcspn(choice, "|");
        if (strlen(text) == length && strncmp(text, choice, length) == 0) {
            *target = value;
            return true;
        }
        if (choice[length] == '\0')
            return false;
        choice += length + 1;
    }
}

/* An argument of --json that ends like a scene or a picture was meant for another option. */
static bool set_json(const char **target, const char *text)
{
    static const char *const others[] = {".gltf", ".glb", ".exr", ".hdr", ".png", ".jpg"};
    const char *ending = strrchr(text, '.');
    for (size_t i = 0; ending && i < LSF_COUNT(others); i++)
        if (strcasecmp(ending, others[i]) == 0)
            return false;
    *target = text;
    return *text != '\0';
}

static bool set_frames(lsf_frames_setting *target, const lsf_command_option *option,
                       const char *text)
{
    size_t length = strcspn(text, "-");
    char first[16];
    uint64_t values[2], most = (uint64_t)option->maximum;
    if (text[length] == '\0' || length >= sizeof first)
        return false;
    memcpy(first, text, length);
    first[length] = '\0';
    if (!lsf_parse_integer(first, most, &values[0]) ||
        !lsf_parse_integer(text + length + 1, most, &values[1]) || values[0] > values[1])
        return false;
    *target = (lsf_frames_setting){true, (uint32_t)values[0], (uint32_t)values[1]};
    return true;
}

static bool set_resolution(uint32_t *target, const lsf_command_option *option, const char *text)
{
    size_t length = strcspn(text, ",xX");
    char width[16];
    uint64_t values[2];
    if (text[length] == '\0' || length >= sizeof width)
        return false;
    memcpy(width, text, length);
    width[length] = '\0';
    uint64_t most = (uint64_t)option->maximum;
    if (!lsf_parse_integer(width, most, &values[0]) ||
        !lsf_parse_integer(text + length + 1, most, &values[1]) || values[0] == 0 || values[1] == 0)
        return false;
    target[0] = (uint32_t)values[0];
    target[1] = (uint32_t)values[1];
    return true;
}

static bool set_aovs(uint32_t *target, const lsf_command_option *option, const char *text,
                     lsf_error *error)
{
    uint32_t aovs = *target; /* a repeated --aov adds to the list */
    for (const char *part = text;; part++) {
        size_t length = strcspn(part, ",");
        char name[LSF_CHANNEL_NAME_SIZE];
        if (length >= sizeof name)
            return bad_value(option, text, NULL, error);
        memcpy(name, part, length);
        name[length] = '\0';
        uint32_t aov = 0;
        if (strcmp(name, "all") == 0)
            aov = LSF_AOV_ALL;
        else if (*name)
            aov = lsf_aov_from_name(name);
        if (!aov)
            return bad_value(option, text, lsf_nearest(name, next_aov, NULL), error);
        aovs |= aov;
        part += length;
        if (*part == '\0')
            break;
    }
    *target = aovs;
    return true;
}

static bool set_define(lsf_list_setting *target, const lsf_command_option *option, const char *text,
                       lsf_error *error)
{
    size_t length = strcspn(text, "=");
    char key[128];
    if (text[length] == '\0' || length == 0 || length >= sizeof key)
        return bad_value(option, text, NULL, error);
    memcpy(key, text, length);
    key[length] = '\0';
    lsf_option known;
    bool found = false;
    for (uint32_t i = 0; !found && lsf_option_list(i, &known); i++)
        found = strcmp(known.key, key) == 0;
    const char *instead = found ? NULL : lsf_option_replaced(key);
    if (instead)
        return lsf_error_set(error, LSF_ERROR_USAGE, "--%s %s: this option was replaced by: %s",
                             option->name, text, instead);
    if (!found)
        return bad_value(option, text, lsf_nearest(key, next_key, &known), error);
    return append_value(target, option, text, error);
}

/* A list of numbers is a uniform radiance; anything else is a file. A text that can only have
 * been meant as numbers (digits, signs, points and commas) is not looked for as a file, nor is a
 * bare word, such as a colour's name, unless there is such a file. */
static bool set_environment(lsf_environment_setting *target, const lsf_command_option *option,
                            const char *text, lsf_error *error)
{
    lsf_environment_setting setting = {0};
    if (lsf_parse_numbers(text, option->minimum, option->maximum, 3, setting.uniform.value))
        setting.uniform.given = true;
    else if (strspn(text, "0123456789+-.,eE") == strlen(text) ||
             (!strpbrk(text, "./") && access(text, F_OK) != 0))
        return bad_value(option, text, NULL, error);
    else
        setting.path = text;
    *target = setting;
    return true;
}

static bool set_background(lsf_background_setting *target, const lsf_command_option *option,
                           const char *text)
{
    lsf_background_setting setting = {.kind = LSF_BACKGROUND_UNIFORM};
    if (strcmp(text, "environment") == 0)
        setting.kind = LSF_BACKGROUND_ENVIRONMENT;
    else if (strcmp(text, "transparent") == 0)
        setting.kind = LSF_BACKGROUND_TRANSPARENT;
    else if (!lsf_parse_numbers(text, option->minimum, option->maximum, 3, setting.radiance))
        return false;
    *target = setting;
    return true;
}

static bool set_threshold(lsf_list_setting *target, const lsf_command_option *option,
                          const char *text, lsf_error *error)
{
    const char *equals = strchr(text, '=');
    double value;
    if (!equals || equals == text || !lsf_parse_number(equals + 1, -1e30, 1e30, &value))
        return bad_value(option, text, NULL, error);
    return append_value(target, option, text, error);
}

static bool bad_technique(const lsf_command_option *option, const char *text, lsf_error *error)
{
    const char *nearest = lsf_nearest(text, next_technique, NULL);
    lsf_string names = {0};
    for (uint32_t i = 0; lsf_technique_name(i); i++)
        lsf_string_add(&names, "%s%s", i ? ", " : "", lsf_technique_name(i));
    lsf_error_set(error, LSF_ERROR_USAGE, "--%s %s: expected one of %s%s%s%s", option->name,
                  *text ? text : "\"\"", names.text ? names.text : "--list-techniques",
                  nearest ? "; did you mean " : "", nearest ? nearest : "", nearest ? "?" : "");
    free(names.text);
    return false;
}

static bool set_techniques(lsf_list_setting *target, const lsf_command_option *option,
                           const char *text, lsf_error *error)
{
    for (const char *part = text;; part++) {
        size_t length = strcspn(part, ",");
        const char *found = NULL;
        for (uint32_t i = 0; !found && lsf_technique_name(i); i++)
            if (strlen(lsf_technique_name(i)) == length &&
                strncmp(lsf_technique_name(i), part, length) == 0)
                found = lsf_technique_name(i);
        char name[64];
        lsf_print(name, sizeof name, "%.*s", (int)(length < 63 ? length : 63), part);
        if (!found)
            return bad_technique(option, name, error);
        if (!append_value(target, option, found, error))
            return false;
        part += length;
        if (*part == '\0')
            return true;
    }
}

bool lsf_settings_set(lsf_settings *settings, const lsf_command_option *option, const char *text,
                      lsf_error *error)
{
    void *target = target_of(settings, option);
    uint64_t integer;
    double number;
    bool good = false;
    switch (option->type) {
    case LSF_VALUE_FLAG:
        *(bool *)target = true;
        return true;
    case LSF_VALUE_COUNT:
        good = lsf_parse_integer(text, (uint64_t)option->maximum, &integer) &&
               integer >= (uint64_t)option->minimum;
        if (good)
            *(uint32_t *)target = (uint32_t)integer;
        break;
    case LSF_VALUE_SEED:
        good = lsf_parse_integer(text, UINT64_MAX, &integer);
        if (good)
            *(uint64_t *)target = integer;
        break;
    case LSF_VALUE_DOUBLE:
        good = lsf_parse_number(text, option->minimum, option->maximum, &number);
        if (good)
            *(double *)target = number;
        break;
    case LSF_VALUE_FLOAT:
        good = lsf_parse_number(text, option->minimum, option->maximum, &number);
        if (good)
            *(float *)target = (float)number;
        break;
    case LSF_VALUE_VECTOR: {
        lsf_vector_setting vector = {.given = true};
        good = lsf_parse_numbers(text, option->minimum, option->maximum, 3, vector.value);
        if (good)
            *(lsf_vector_setting *)target = vector;
        break;
    }
    case LSF_VALUE_LIGHT:
        good = add_light(target, option, text);
        break;
    case LSF_VALUE_FRAMES:
        good = set_frames(target, option, text);
        break;
    case LSF_VALUE_RESOLUTION:
        good = set_resolution(target, option, text);
        break;
    case LSF_VALUE_TEXT:
        good = *text != '\0';
        if (good)
            *(const char **)target = text;
        break;
    case LSF_VALUE_JSON:
        good = set_json(target, text);
        break;
    case LSF_VALUE_TEXTS:
        return *text ? append_value(target, option, text, error)
                     : bad_value(option, text, NULL, error);
    case LSF_VALUE_PRESET:
        *(int *)target = lsf_preset_number(option, text);
        good = *text != '\0';
        break;
    case LSF_VALUE_CHOICE:
        good = set_choice(target, option, text);
        break;
    case LSF_VALUE_TECHNIQUE:
        for (uint32_t i = 0; !good && lsf_technique_name(i); i++)
            good = strcmp(lsf_technique_name(i), text) == 0;
        if (!good)
            return bad_technique(option, text, error);
        *(const char **)target = text;
        break;
    case LSF_VALUE_TECHNIQUES:
        return set_techniques(target, option, text, error);
    case LSF_VALUE_AOVS:
        return set_aovs(target, option, text, error);
    case LSF_VALUE_DEFINE:
    case LSF_VALUE_SWEEP:
        return set_define(target, option, text, error);
    case LSF_VALUE_ENVIRONMENT:
        return *text ? set_environment(target, option, text, error)
                     : bad_value(option, text, NULL, error);
    case LSF_VALUE_EXPOSURE: {
        lsf_exposure_setting exposure = {.automatic = strcmp(text, "auto") == 0};
        good =
            exposure.automatic || lsf_parse_number(text, option->minimum, option->maximum, &number);
        exposure.ev = good && !exposure.automatic ? (float)number : 0.0f;
        if (good)
            *(lsf_exposure_setting *)target = exposure;
        break;
    }
    case LSF_VALUE_BACKGROUND:
        good = set_background(target, option, text);
        break;
    case LSF_VALUE_THRESHOLD:
        return set_threshold(target, option, text, error);
    }
    return good || bad_value(option, text, NULL, error);
}
