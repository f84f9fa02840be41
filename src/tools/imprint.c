#include "tools/imprint.h"

#include "tools/preset.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

void lsf_imprint_add_word(lsf_string *text, const char *word)
{
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-+=./,:%@";
    if (*word && word[strspn(word, plain)] == '\0') {
        lsf_string_add(text, " %s", word);
        return;
    }
    lsf_string_add(text, " '");
    for (; *word; word++)
        lsf_string_add(text, *word == '\'' ? "'\\''" : "%c", *word);
    lsf_string_add(text, "'");
}

void lsf_imprint_add_option(lsf_string *options, const lsf_command_option *option,
                            const char *value)
{
    static const char *const others[] = {"output", "format", "json", "quiet", "verbose", "view"};
    if (strcmp(option->name, "preset") == 0 && lsf_preset_number(option, value) == LSF_PRESET_FILE)
        return; /* what the file says is there */
    for (size_t i = 0; i < LSF_COUNT(others); i++)
        if (strcmp(option->name, others[i]) == 0)
            return;
    lsf_string_add(options, " --%s", option->name);
    if (value)
        lsf_imprint_add_word(options, value);
}

/* The environment that the command takes. */
static void add_environment(lsf_string *text, const char *weights)
{
    char *word = weights ? lsf_format("LIGHTSHEAF_DENOISER_WEIGHTS=%s", weights) : NULL;
    if (word) {
        lsf_string_add(text, "env");
        lsf_imprint_add_word(text, word);
        lsf_string_add(text, " ");
    }
    text->failed |= weights && !word;
    free(word);
}

static char *make_command(const lsf_settings *settings, const char *scene_path, const char *weights)
{
    lsf_string text = {0};
    add_environment(&text, weights);
    lsf_string_add(&text, "lightsheaf %s", settings->command->name);
    if (settings->operands.count > 0)
        lsf_imprint_add_word(&text, scene_path);
    if (settings->typed.length > 0)
        lsf_string_add_bytes(&text, settings->typed.text, settings->typed.length);
    if (text.failed || settings->typed.failed) {
        free(text.text);
        return NULL;
    }
    lsf_make_printable(text.text);
    return text.text;
}

bool lsf_imprint_make(lsf_imprint *imprint, const lsf_settings *settings, const char *scene_path,
                      const char *technique, uint32_t bounces, uint32_t samples,
                      const char *weights, lsf_error *error)
{
    *imprint = (lsf_imprint){.command = make_command(settings, scene_path, weights)};
    if (!imprint->command)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", scene_path);
    snprintf(imprint->seed, sizeof imprint->seed, "%" PRIu64, settings->seed);
    snprintf(imprint->bounces, sizeof imprint->bounces, "%u", bounces);
    snprintf(imprint->samples, sizeof imprint->samples, "%u", samples);
    const lsf_image_text texts[] = {
        {"lightsheaf.version", lsf_version()},    {"lightsheaf.command", imprint->command},
        {"lightsheaf.scene", scene_path},         {"lightsheaf.technique", technique},
        {"lightsheaf.bounces", imprint->bounces}, {"lightsheaf.samples", imprint->samples},
        {"lightsheaf.seed", imprint->seed},       {"lightsheaf.denoiser_weights", weights},
    };
    memcpy(imprint->texts, texts, sizeof texts);
    imprint->text_count = LSF_COUNT(texts) - !weights;
    return true;
}

void lsf_imprint_finish(lsf_imprint *imprint)
{
    free(imprint->command);
    *imprint = (lsf_imprint){0};
}
