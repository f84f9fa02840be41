#include "sweep/reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <xxhash.h>

#include <lightsheaf/lightsheaf.h>

#include "base/base.h"

/* Seeds of rounds start here, far from those that users type. */
#define FIRST_SEED UINT64_C(0x7265666572656e63)

void lsf_kept_reference_finish(lsf_kept_reference *kept)
{
    lsf_image_destroy(kept->halves[0]);
    lsf_image_destroy(kept->halves[1]);
    *kept = (lsf_kept_reference){0};
}

static bool create_halves(lsf_kept_reference *kept, uint32_t width, uint32_t height,
                          lsf_error *error)
{
    static const char *const names[] = {"R", "G", "B"};
    kept->width = width;
    kept->height = height;
    for (int h = 0; h < 2; h++)
        if (!(kept->halves[h] = lsf_image_create(width, height, 3, names, error)))
            return false;
    return true;
}

/* --- tracing --- */

static void take_in(lsf_image *half, uint64_t samples, const lsf_image *traced, uint64_t more)
{
    double part = (double)more / (double)(samples + more);
    for (size_t i = 0; i < (size_t)half->width * half->height; i++)
        for (size_t c = 0; c < 3; c++) {
            double old = half->pixels[3 * i + c];
            double new = traced->pixels[traced->channel_count * i + c];
            half->pixels[3 * i + c] = (float)(old + part * (new - old));
        }
}

bool lsf_kept_reference_trace(lsf_kept_reference *kept, const lsf_scene *scene,
                              const lsf_render_params *params, uint32_t samples, lsf_error *error)
{
    lsf_render_params round = *params;
    lsf_image *traced[2] = {NULL, NULL};
    lsf_reference_result results[2] = {{0}};
    round.samples = samples;
    round.seed = FIRST_SEED + kept->rounds;
    bool good = true;
    for (uint32_t h = 0; good && h < 2; h++)
        good = (traced[h] = lsf_reference_render(scene, &round, h, &results[h], error)) &&
               results[h].samples == samples;
    if (good && !kept->halves[0])
        good = create_halves(kept, params->width, params->height, error);
    for (uint32_t h = 0; good && h < 2; h++) {
        take_in(kept->halves[h], kept->samples[h], traced[h], samples);
        kept->samples[h] += samples;
        kept->seconds += results[h].build_seconds + results[h].render_seconds;
    }
    kept->rounds += good;
    kept->traced |= good;
    lsf_image_destroy(traced[0]);
    lsf_image_destroy(traced[1]);
    return good;
}

/* --- the file: header, halves, checksum of both --- */

typedef struct file_header {
    char magic[8];
    uint32_t width, height, rounds, zero;
    uint64_t samples[2];
    double seconds;
} file_header;

#define MAGIC "LSFREF\0\1"

static size_t half_bytes(const file_header *header)
{
    return (size_t)header->width * header->height * 3 * sizeof(float);
}

static bool is_whole(const char *bytes, size_t length, file_header *header)
{
    XXH128_hash_t sum;
    if (length < sizeof *header + sizeof sum)
        return false;
    memcpy(header, bytes, sizeof *header);
    if (memcmp(header->magic, MAGIC, sizeof header->magic) != 0 || header->width == 0 ||
        header->width > 65535 || header->height == 0 || header->height > 65535 ||
        header->samples[0] == 0 || header->samples[1] == 0 ||
        length != sizeof *header + 2 * half_bytes(header) + sizeof sum)
        return false;
    memcpy(&sum, bytes + length - sizeof sum, sizeof sum);
    return XXH128_isEqual(sum, XXH3_128bits(bytes, length - sizeof sum));
}

bool lsf_kept_reference_load(lsf_kept_reference *kept, const char *path, lsf_error *error)
{
    size_t length;
    file_header header;
    lsf_kept_reference loaded = {0};
    char *bytes = lsf_file_read(path, UINT64_MAX, &length, error);
    if (!bytes)
        return false;
    bool good = is_whole(bytes, length, &header) ||
                lsf_error_set(error, LSF_ERROR_FILE, "%s: is damaged; remove it", path);
    good = good && create_halves(&loaded, header.width, header.height, error);
    for (size_t h = 0; good && h < 2; h++) {
        memcpy(loaded.halves[h]->pixels, bytes + sizeof header + h * half_bytes(&header),
               half_bytes(&header));
        loaded.samples[h] = header.samples[h];
    }
    free(bytes);
    if (!good) {
        lsf_kept_reference_finish(&loaded);
        return false;
    }
    loaded.rounds = header.rounds;
    loaded.seconds = header.seconds;
    lsf_kept_reference_finish(kept);
    *kept = loaded;
    return true;
}

bool lsf_kept_reference_save(const lsf_kept_reference *kept, const char *path, lsf_error *error)
{
    file_header header = {.magic = MAGIC,
                          .width = kept->width,
                          .height = kept->height,
                          .rounds = kept->rounds,
                          .samples = {kept->samples[0], kept->samples[1]},
                          .seconds = kept->seconds};
    size_t half = half_bytes(&header), length = sizeof header + 2 * half;
    char *bytes = lsf_alloc(length + sizeof(XXH128_hash_t), 1);
    if (!bytes)
        return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", path);
    memcpy(bytes, &header, sizeof header);
    for (size_t h = 0; h < 2; h++)
        memcpy(bytes + sizeof header + h * half, kept->halves[h]->pixels, half);
    XXH128_hash_t sum = XXH3_128bits(bytes, length);
    memcpy(bytes + length, &sum, sizeof sum);
    bool good = lsf_file_write(path, bytes, length + sizeof sum, error);
    free(bytes);
    return good;
}

/* --- its dependencies --- */

/* Hexadecimal fractions, which are exact. NULL: not given. */
static void add_floats(lsf_string *text, const char *name, const float *values, uint32_t count)
{
    lsf_string_add(text, "%s", name);
    for (uint32_t i = 0; values && i < count; i++)
        lsf_string_add(text, " %a", (double)values[i]);
    lsf_string_add(text, "\n");
}

static void add_text(lsf_string *text, const char *name, const char *value)
{
    lsf_string_add(text, "%s ", name);
    lsf_string_add_json(text, value ? value : "");
    lsf_string_add(text, value ? "\n" : " not given\n");
}

bool lsf_reference_key(const char *content_hash, const lsf_scene_params *scene,
                       const lsf_render_params *params, uint32_t bounces, char key[33])
{
    lsf_string text = {0};
    lsf_string_add(&text, "lightsheaf %s\ncontent %s\n", lsf_version(), content_hash);
    add_floats(&text, "environment", scene->environment_radiance, 3);
    add_floats(&text, "rotation", &scene->environment_rotation, 1);
    add_floats(&text, "strength", &scene->environment_strength, 1);
    lsf_string_add(&text, "light %d diffuse %d back %d\n", (int)scene->default_light,
                   scene->diffuse_only, scene->show_back_faces);
    add_text(&text, "scene", scene->scene);
    add_text(&text, "variant", scene->variant);
    lsf_string_add(&text, scene->animations ? "animations %u\n" : "all animations\n",
                   scene->animation_count);
    for (uint32_t i = 0; scene->animations && i < scene->animation_count; i++)
        add_text(&text, "animation", scene->animations[i]);
    lsf_string_add(&text, "size %u %u bounces %u background %d\n", params->width, params->height,
                   bounces, (int)params->background);
    add_floats(&text, "background", params->background_radiance, 3);
    add_text(&text, "camera", params->camera);
    add_floats(&text, "position", params->camera_position, 3);
    add_floats(&text, "target", params->camera_target, 3);
    add_floats(&text, "fov", &params->fov_y, 1);
    lsf_string_add(&text, "time %a\n", params->time);
    XXH128_hash_t hash = XXH3_128bits(text.text, text.length);
    snprintf(key, 33, "%016llx%016llx", (unsigned long long)hash.high64,
             (unsigned long long)hash.low64);
    free(text.text);
    return !text.failed;
}
