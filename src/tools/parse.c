#include "tools/options.h"

#include "base/base.h"
#include "tools/imprint.h"
#include "tools/number.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <unistd.h>

enum { MOST_OPTIONS = 128, FIRST_LONG_VALUE = 256 };

static void *place_of(lsf_settings *settings, const lsf_command_option *option)
{
    return (char *)settings + option->offset;
}

static bool append(lsf_list_setting *list, const char *item)
{
    void *items = (void *)list->items;
    if (!lsf_grow(&items, &list->capacity, (uint64_t)list->count + 1, sizeof *list->items))
        return false;
    list->items = items;
    list->items[list->count++] = item;
    return true;
}

/* --- one value --- */

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

static bool append_value(lsf_list_setting *place, const lsf_command_option *option,
                         const char *text, lsf_error *error)
{
    return append(place, text) ||
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

static bool set_choice(int *place, const lsf_command_option *option, const char *text)
{
    int value = (int)option->minimum;
    for (const char *choice = option->choices;; value++) {
        size_t length = strcspn(choice, "|");
        if (strlen(text) == length && strncmp(text, choice, length) == 0) {
            *place = value;
            return true;
        }
        if (choice[length] == '\0')
            return false;
        choice += length + 1;
    }
}

/* What stands behind --json without a thought of its value is a scene or a picture. */
static bool set_json(const char **place, const char *text)
{
    static const char *const others[] = {".gltf", ".glb", ".exr", ".hdr", ".png", ".jpg"};
    const char *ending = strrchr(text, '.');
    for (size_t i = 0; ending && i < LSF_COUNT(others); i++)
        if (strcasecmp(ending, others[i]) == 0)
            return false;
    *place = text;
    return *text != '\0';
}

static bool set_resolution(uint32_t *place, const lsf_command_option *option, const char *text)
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
    place[0] = (uint32_t)values[0];
    place[1] = (uint32_t)values[1];
    return true;
}

static bool set_aovs(uint32_t *place, const lsf_command_option *option, const char *text,
                     lsf_error *error)
{
    uint32_t aovs = *place; /* a repeated --aov adds to the list */
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
    *place = aovs;
    return true;
}

static bool set_define(lsf_list_setting *place, const lsf_command_option *option, const char *text,
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
    if (!found)
        return bad_value(option, text, lsf_nearest(key, next_key, &known), error);
    return append_value(place, option, text, error);
}

/* A list of numbers is a uniform radiance; whatever else is a file. What can only have been meant
 * as numbers (digits, signs, points and commas) is not looked for as a file, nor is a bare word, such
 * as a colour's name, unless there is one. */
static bool set_environment(lsf_environment_setting *place, const lsf_command_option *option,
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
    *place = setting;
    return true;
}

static bool set_background(lsf_background_setting *place, const lsf_command_option *option,
                           const char *text)
{
    lsf_background_setting setting = {.kind = LSF_BACKGROUND_UNIFORM};
    if (strcmp(text, "environment") == 0)
        setting.kind = LSF_BACKGROUND_ENVIRONMENT;
    else if (strcmp(text, "transparent") == 0)
        setting.kind = LSF_BACKGROUND_TRANSPARENT;
    else if (!lsf_parse_numbers(text, option->minimum, option->maximum, 3, setting.radiance))
        return false;
    *place = setting;
    return true;
}

static bool set_threshold(lsf_list_setting *place, const lsf_command_option *option,
                          const char *text, lsf_error *error)
{
    const char *equals = strchr(text, '=');
    double value;
    if (!equals || equals == text || !lsf_parse_number(equals + 1, -1e30, 1e30, &value))
        return bad_value(option, text, NULL, error);
    return append_value(place, option, text, error);
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

static bool set_value(lsf_settings *settings, const lsf_command_option *option, const char *text,
                      lsf_error *error)
{
    void *place = place_of(settings, option);
    uint64_t integer;
    double number;
    bool good = false;
    switch (option->type) {
    case LSF_VALUE_FLAG:
        *(bool *)place = true;
        return true;
    case LSF_VALUE_COUNT:
        good = lsf_parse_integer(text, (uint64_t)option->maximum, &integer) &&
               integer >= (uint64_t)option->minimum;
        if (good)
            *(uint32_t *)place = (uint32_t)integer;
        break;
    case LSF_VALUE_SEED:
        good = lsf_parse_integer(text, UINT64_MAX, &integer);
        if (good)
            *(uint64_t *)place = integer;
        break;
    case LSF_VALUE_DOUBLE:
        good = lsf_parse_number(text, option->minimum, option->maximum, &number);
        if (good)
            *(double *)place = number;
        break;
    case LSF_VALUE_FLOAT:
        good = lsf_parse_number(text, option->minimum, option->maximum, &number);
        if (good)
            *(float *)place = (float)number;
        break;
    case LSF_VALUE_VECTOR: {
        lsf_vector_setting vector = {.given = true};
        good = lsf_parse_numbers(text, option->minimum, option->maximum, 3, vector.value);
        if (good)
            *(lsf_vector_setting *)place = vector;
        break;
    }
    case LSF_VALUE_RESOLUTION:
        good = set_resolution(place, option, text);
        break;
    case LSF_VALUE_TEXT:
        good = *text != '\0';
        if (good)
            *(const char **)place = text;
        break;
    case LSF_VALUE_JSON:
        good = set_json(place, text);
        break;
    case LSF_VALUE_TEXTS:
        return *text ? append_value(place, option, text, error)
                     : bad_value(option, text, NULL, error);
    case LSF_VALUE_CHOICE:
        good = set_choice(place, option, text);
        break;
    case LSF_VALUE_TECHNIQUE:
        for (uint32_t i = 0; !good && lsf_technique_name(i); i++)
            good = strcmp(lsf_technique_name(i), text) == 0;
        if (!good)
            return bad_technique(option, text, error);
        *(const char **)place = text;
        break;
    case LSF_VALUE_AOVS:
        return set_aovs(place, option, text, error);
    case LSF_VALUE_DEFINE:
        return set_define(place, option, text, error);
    case LSF_VALUE_ENVIRONMENT:
        return *text ? set_environment(place, option, text, error)
                     : bad_value(option, text, NULL, error);
    case LSF_VALUE_EXPOSURE: {
        lsf_exposure_setting exposure = {.automatic = strcmp(text, "auto") == 0};
        good =
            exposure.automatic || lsf_parse_number(text, option->minimum, option->maximum, &number);
        exposure.ev = good && !exposure.automatic ? (float)number : 0.0f;
        if (good)
            *(lsf_exposure_setting *)place = exposure;
        break;
    }
    case LSF_VALUE_BACKGROUND:
        good = set_background(place, option, text);
        break;
    case LSF_VALUE_THRESHOLD:
        return set_threshold(place, option, text, error);
    }
    return good || bad_value(option, text, NULL, error);
}

/* --- the command line --- */

static const lsf_command_option *find_by_letter(const lsf_command *command, int letter)
{
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (option->letter == letter && (option->commands & command->bit))
            return option;
    }
    return NULL;
}

static const char *next_name(size_t index, void *user)
{
    const lsf_command *command = user;
    size_t seen = 0;
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if ((option->commands & command->bit) && seen++ == index)
            return option->name;
    }
    return NULL;
}

/* What other renderers call an option of this command; NULL: nothing known. */
static const char *meant_by(const char *name, const lsf_command *command)
{
    static const char *const words[][2] = {
        {"size", "resolution"},      {"width", "resolution"},     {"height", "resolution"},
        {"spp", "samples"},          {"iterations", "samples"},   {"envmap", "environment"},
        {"env", "environment"},      {"hdri", "environment"},     {"ibl", "environment"},
        {"method", "technique"},     {"integrator", "technique"}, {"max-depth", "bounces"},
        {"depth", "bounces"},        {"fov", "fov-y"},            {"out", "output"},
        {"tone-mapping", "tonemap"}, {"eye", "camera-position"},  {"look-at", "camera-target"},
        {"bg", "background"},        {"timeout", "time-limit"},
    };
    for (size_t i = 0; i < LSF_COUNT(words); i++)
        for (size_t k = 0; strcmp(words[i][0], name) == 0 && next_name(k, (void *)(uintptr_t)command);
             k++)
            if (strcmp(next_name(k, (void *)(uintptr_t)command), words[i][1]) == 0)
                return words[i][1];
    return NULL;
}

/* An option that getopt did not take: says whether it is another command's, a beginning that
 * several share, or a slip of the hand. */
static bool bad_option(const lsf_command *command, const char *word, lsf_error *error)
{
    const char *help = lsf_command_find(LSF_COMMAND_HELP)->name;
    if (strncmp(word, "--", 2) != 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "%s: not an option of %s; `lightsheaf %s %s` lists them", word,
                             command->name, help, command->name);
    char name[64];
    size_t length = strcspn(word + 2, "=");
    if (length >= sizeof name)
        length = sizeof name - 1;
    memcpy(name, word + 2, length);
    name[length] = '\0';

    lsf_string meant = {0};
    unsigned commands = 0;
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (strcmp(option->name, name) == 0)
            commands |= option->commands;
        if ((option->commands & command->bit) && strncmp(option->name, name, length) == 0)
            lsf_string_add(&meant, "%s--%s", meant.length ? ", " : "", option->name);
    }
    if (meant.length) {
        lsf_error_set(error, LSF_ERROR_USAGE, "--%s: could be %s; write more of it", name,
                      meant.text);
    } else if (commands) {
        for (size_t i = 0; lsf_command_at(i); i++)
            if (commands & lsf_command_at(i)->bit)
                lsf_string_add(&meant, "%s%s", meant.length ? ", " : "", lsf_command_at(i)->name);
        lsf_error_set(error, LSF_ERROR_USAGE, "--%s: an option of %s, not of %s", name,
                      meant.length ? meant.text : "another command", command->name);
    } else {
        const char *nearest = meant_by(name, command);
        if (!nearest)
            nearest = lsf_nearest(name, next_name, (void *)(uintptr_t)command);
        lsf_error_set(error, LSF_ERROR_USAGE,
                      "--%s: not an option of %s%s%s%s; `lightsheaf %s %s` lists them", name,
                      command->name, nearest ? "; did you mean --" : "", nearest ? nearest : "",
                      nearest ? "?" : "", help, command->name);
    }
    free(meant.text);
    return false;
}

static bool bad_argument(const lsf_command_option *option, bool missing, lsf_error *error)
{
    char *range = lsf_command_option_range(option);
    if (missing)
        lsf_error_set(error, LSF_ERROR_USAGE, "--%s: needs a value: %s", option->name,
                      range ? range : option->argument);
    else
        lsf_error_set(error, LSF_ERROR_USAGE, "--%s: takes no value; write it alone", option->name);
    free(range);
    return false;
}

static void set_defaults(lsf_settings *settings, const lsf_command *command)
{
    const lsf_render_params render = {LSF_RENDER_PARAMS_DEFAULTS};
    const lsf_scene_params scene = {LSF_SCENE_PARAMS_DEFAULTS};
    *settings = (lsf_settings){
        .command = command,
        .technique = render.technique,
        .resolution = {render.width, render.height},
        .time_limit = render.time_limit,
        .bounces = render.bounces,
        .seed = render.seed,
        .fov_y = render.fov_y,
        .environment_strength = scene.environment_strength,
        .memory_limit = (double)scene.memory_limit / 0x1p30,
        .time = render.time,
        .difference_gain = 4,
        .epsilon = NAN,
    };
}

/* What getopt needs: the long options, and the letters, each behind "-" (operands come in order,
 * whatever POSIXLY_CORRECT says) and ":" (a missing value is told apart). */
static void list_options(const lsf_command *command, struct option *longs, char *letters)
{
    *letters++ = '-';
    *letters++ = ':';
    for (size_t i = 0; lsf_command_option_at(i); i++) {
        const lsf_command_option *option = lsf_command_option_at(i);
        if (!(option->commands & command->bit))
            continue;
        *longs++ = (struct option){
            .name = option->name,
            .has_arg = option->argument ? required_argument : no_argument,
            .val = FIRST_LONG_VALUE + (int)i,
        };
        if (option->letter) {
            *letters++ = option->letter;
            if (option->argument)
                *letters++ = ':';
        }
    }
    *letters = '\0';
    *longs = (struct option){0};
}

static bool check_operands(const lsf_settings *settings, lsf_error *error)
{
    const lsf_command *command = settings->command;
    uint32_t count = settings->operands.count;
    if (settings->help || settings->version || settings->list_options || settings->list_techniques)
        return true;
    if (settings->quiet && settings->verbose)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--quiet and --verbose exclude each other; leave one out");
    if (count < command->operands_min)
        return lsf_error_set(error, LSF_ERROR_USAGE, "%s: needs %s; `lightsheaf help %s` explains",
                             command->name, command->operands, command->name);
    if (count > command->operands_max)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "%s: one operand too many; %s takes %s, and `lightsheaf help %s` "
                             "explains",
                             settings->operands.items[command->operands_max], command->name,
                             command->operands, command->name);
    return true;
}

bool lsf_settings_parse(lsf_settings *settings, lsf_command_bit bit, int argc, char **argv,
                        lsf_error *error)
{
    const lsf_command *command = lsf_command_find(bit);
    set_defaults(settings, command);
    struct option longs[MOST_OPTIONS + 1];
    char letters[2 * MOST_OPTIONS + 3];
    list_options(command, longs, letters);

    optind = 0; /* glibc: start afresh */
    opterr = 0;
    int code;
    while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
        if (code == 1) {
            if (!append(&settings->operands, optarg))
                return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", optarg);
            continue;
        }
        int which = code == '?' || code == ':' ? optopt : code;
        const lsf_command_option *option =
            which >= FIRST_LONG_VALUE ? lsf_command_option_at((size_t)(which - FIRST_LONG_VALUE))
            : which                   ? find_by_letter(command, which)
                                      : NULL;
        if (!option) {
            char letter[] = {'-', (char)which, '\0'};
            return bad_option(command, which ? letter : argv[optind - 1], error);
        }
        if (code == '?' || code == ':')
            return bad_argument(option, code == ':', error);
        size_t row = (size_t)(option - lsf_command_option_at(0));
        settings->given[row / 64] |= (uint64_t)1 << row % 64;
        if (!set_value(settings, option, optarg, error))
            return false;
        lsf_imprint_add_option(&settings->typed, option, option->argument ? optarg : NULL);
    }
    for (; optind < argc; optind++) /* behind "--" */
        if (!append(&settings->operands, argv[optind]))
            return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", argv[optind]);
    return check_operands(settings, error);
}

void lsf_settings_finish(lsf_settings *settings)
{
    free((void *)settings->operands.items);
    free((void *)settings->animations.items);
    free((void *)settings->defines.items);
    free((void *)settings->thresholds.items);
    free(settings->typed.text);
    *settings = (lsf_settings){0};
}

bool lsf_settings_given(const lsf_settings *settings, const char *name)
{
    for (size_t i = 0; lsf_command_option_at(i); i++)
        if (strcmp(lsf_command_option_at(i)->name, name) == 0 &&
            (settings->given[i / 64] >> i % 64 & 1))
            return true;
    return false;
}

bool lsf_settings_print_json(const lsf_settings *settings)
{
    return settings->json_path && strcmp(settings->json_path, "-") == 0;
}

/* --- what the library takes --- */

lsf_render_params lsf_settings_render_params(const lsf_settings *settings)
{
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.technique = settings->technique;
    params.width = settings->resolution[0];
    params.height = settings->resolution[1];
    params.time_limit = settings->time_limit;
    if (settings->samples)
        params.samples = settings->samples;
    else if (isfinite(settings->time_limit))
        params.samples = UINT32_MAX;
    params.bounces = settings->bounces;
    params.seed = settings->seed;
    params.camera = settings->camera;
    if (settings->camera_position.given)
        params.camera_position = settings->camera_position.value;
    if (settings->camera_target.given)
        params.camera_target = settings->camera_target.value;
    params.fov_y = settings->fov_y;
    params.background = settings->background.kind;
    memcpy(params.background_radiance, settings->background.radiance,
           sizeof params.background_radiance);
    params.time = settings->time;
    params.aovs = settings->aovs;
    params.options = settings->defines.items;
    params.option_count = settings->defines.count;
    return params;
}

lsf_scene_params lsf_settings_scene_params(const lsf_settings *settings)
{
    lsf_scene_params params = {LSF_SCENE_PARAMS_DEFAULTS};
    params.environment_path = settings->environment.path;
    if (settings->environment.uniform.given)
        params.environment_radiance = settings->environment.uniform.value;
    params.environment_rotation = settings->environment_rotation;
    params.environment_strength = settings->environment_strength;
    params.default_light = (lsf_default_light)settings->default_light;
    params.diffuse_only = settings->diffuse_only;
    params.show_back_faces = settings->show_back_faces;
    params.lenient = settings->lenient;
    params.memory_limit = (uint64_t)(settings->memory_limit * 0x1p30);
    params.scene = settings->scene;
    params.variant = settings->variant;
    params.animations = settings->animations.items; /* NULL: not given */
    params.animation_count = settings->animations.count;
    if (params.animation_count == 1 && strcmp(params.animations[0], "none") == 0)
        params.animation_count = 0;
    return params;
}

lsf_context_params lsf_settings_context_params(const lsf_settings *settings)
{
    lsf_context_params params = {LSF_CONTEXT_PARAMS_DEFAULTS};
    params.backend = (lsf_backend)settings->backend;
    params.shader_dir = settings->shader_dir;
    params.debug = settings->gl_debug;
    params.fail_on_gl_error = settings->gl_debug;
    return params;
}
