#include "tools/options.h"

#include "base/base.h"
#include "tools/imprint.h"
#include "tools/number.h"
#include "tools/preset.h"
#include "tools/value.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { MOST_OPTIONS = 128, FIRST_LONG_VALUE = 256 };

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
        {"size", "resolution"},      {"width", "resolution"},
        {"height", "resolution"},    {"spp", "samples"},
        {"iterations", "samples"},   {"envmap", "environment"},
        {"env", "environment"},      {"hdri", "environment"},
        {"ibl", "environment"},      {"method", "technique"},
        {"integrator", "technique"}, {"max-depth", "bounces"},
        {"depth", "bounces"},        {"fov", "fov-y"},
        {"out", "output"},           {"tone-mapping", "tonemap"},
        {"eye", "camera-position"},  {"look-at", "camera-target"},
        {"bg", "background"},        {"timeout", "time-limit"},
    };
    for (size_t i = 0; i < LSF_COUNT(words); i++)
        for (size_t k = 0;
             strcmp(words[i][0], name) == 0 && next_name(k, (void *)(uintptr_t)command); k++)
            if (strcmp(next_name(k, (void *)(uintptr_t)command), words[i][1]) == 0)
                return words[i][1];
    return NULL;
}

/* Explains an option that getopt did not accept: it is another command's, a prefix that several
 * share, or a misspelling. */
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
    bool sandbox = command->bit == LSF_COMMAND_SANDBOX;
    *settings = (lsf_settings){
        .command = command,
        .technique = render.technique,
        .resolution = {sandbox ? 640 : render.width, sandbox ? 360 : render.height},
        .time_limit = render.time_limit,
        .bounces = render.bounces,
        .seed = render.seed,
        .fov_y = render.fov_y,
        .environment_strength = scene.environment_strength,
        .memory_limit = (double)scene.memory_limit / 0x1p30,
        .time = render.time,
        .fps = sandbox ? 60 : 24,
        .samples = sandbox ? 1 : 0,
        .watchdog = 30,
        .difference_gain = 4,
        .epsilon = NAN,
        .budget_ms = NAN,
        .error = NAN,
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
    if (settings->help || settings->version || settings->list_options ||
        settings->list_techniques || settings->list_names || settings->new_shader)
        return true;
    if (settings->quiet && settings->verbose)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--quiet and --verbose exclude each other; leave one out");
    if (count < command->operands_min)
        return lsf_error_set(error, LSF_ERROR_USAGE, "%s: needs %s; `lightsheaf help %s` explains",
                             command->name, command->operands, command->name);
    if (command->bit == LSF_COMMAND_SANDBOX && count == 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "sandbox: needs a shader; --new my.frag writes one to begin with");
    if (count > command->operands_max)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "%s: one operand too many; %s takes %s; see `lightsheaf help %s`",
                             settings->operands.items[command->operands_max], command->name,
                             command->operands, command->name);
    return true;
}

void lsf_settings_note(lsf_settings *settings, const lsf_command_option *option, const char *value)
{
    size_t row = (size_t)(option - lsf_command_option_at(0));
    settings->given[row / 64] |= (uint64_t)1 << row % 64;
    lsf_imprint_add_option(&settings->typed, option, value);
    if (option->commands & LSF_COMMAND_RENDER)
        lsf_imprint_add_option(&settings->shared, option, value);
}

/* The row that getopt's code stands for; NULL: none. */
static const lsf_command_option *find_option(const lsf_command *command, int code)
{
    if (code >= FIRST_LONG_VALUE)
        return lsf_command_option_at((size_t)(code - FIRST_LONG_VALUE));
    return code ? find_by_letter(command, code) : NULL;
}

/* What is neither a name that the option knows nor a file may be a slip of the hand. */
static bool read_preset_file(lsf_settings *settings, const lsf_command_option *option,
                             const char *path, lsf_error *error)
{
    if (option->choices && access(path, F_OK) != 0)
        return lsf_error_set(error, LSF_ERROR_USAGE,
                             "--preset %s: neither one of %s nor a file that exists", path,
                             option->choices);
    return lsf_preset_read(settings, path, error);
}

/* Options of the command line replace those of its preset, in whatever order they are given. */
static bool read_preset(lsf_settings *settings, int argc, char **argv, const char *letters,
                        const struct option *longs, lsf_error *error)
{
    const char *path = NULL, *view = NULL;
    const lsf_command_option *preset = NULL;
    bool techniques = false; /* are on the command line */
    int code;
    while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
        const lsf_command_option *option =
            code == '?' || code == ':' || code == 1 ? NULL : find_option(settings->command, code);
        if (option && strcmp(option->name, "preset") == 0) {
            preset = option;
            path = optarg;
        }
        if (option && strcmp(option->name, "view") == 0)
            view = optarg;
        techniques = techniques || (option && option->type == LSF_VALUE_TECHNIQUES);
    }
    if (path && lsf_preset_number(preset, path) == LSF_PRESET_FILE &&
        !read_preset_file(settings, preset, path, error))
        return false;
    if (techniques)
        settings->techniques.count = 0;
    return !view || lsf_view_read(settings, view, error);
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
    if (!read_preset(settings, argc, argv, letters, longs, error))
        return false;
    optind = 0;
    int code;
    while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
        if (code == 1) {
            if (!lsf_list_append(&settings->operands, optarg))
                return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", optarg);
            continue;
        }
        int which = code == '?' || code == ':' ? optopt : code;
        const lsf_command_option *option = find_option(command, which);
        if (!option) {
            char letter[] = {'-', (char)which, '\0'};
            return bad_option(command, which ? letter : argv[optind - 1], error);
        }
        if (code == '?' || code == ':')
            return bad_argument(option, code == ':', error);
        if (!lsf_settings_set(settings, option, optarg, error))
            return false;
        lsf_settings_note(settings, option, option->argument ? optarg : NULL);
    }
    for (; optind < argc; optind++) /* behind "--" */
        if (!lsf_list_append(&settings->operands, argv[optind]))
            return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", argv[optind]);
    if (settings->view_scene && settings->operands.count == 0 &&
        !lsf_list_append(&settings->operands, settings->view_scene))
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", settings->view_scene);
    return check_operands(settings, error);
}

void lsf_settings_finish(lsf_settings *settings)
{
    free((void *)settings->operands.items);
    free((void *)settings->animations.items);
    free((void *)settings->edits.items);
    free(settings->lights.items);
    free((void *)settings->channels.items);
    free((void *)settings->uniforms.items);
    free((void *)settings->defines.items);
    free((void *)settings->thresholds.items);
    free((void *)settings->techniques.items);
    free((void *)settings->sweeps.items);
    free(settings->view_text);
    free(settings->typed.text);
    free(settings->shared.text);
    free(settings->preset_text);
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
    params.raw = settings->raw;
    params.temporal = settings->temporal;
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
    params.lights = settings->lights.items;
    params.light_count = settings->lights.count;
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
