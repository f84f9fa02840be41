#include "scene/scene.h"

#include "base/base.h"
#include "scene/draft.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <xxhash.h>

/* --- content --- */

/* Parts are hashed apart, so that moving bytes from one part to the next changes the hash. */
void lsf_scene_add_content(lsf_scene *scene, const void *bytes, size_t length)
{
    XXH128_hash_t part = XXH3_128bits(bytes, length);
    const uint64_t chain[] = {scene->content[0], scene->content[1], part.low64, part.high64};
    XXH128_hash_t all = XXH3_128bits(chain, sizeof chain);
    scene->content[0] = all.low64;
    scene->content[1] = all.high64;
}

bool lsf_scene_content_hash(const lsf_scene *scene, char hash[33])
{
    if (!scene || !hash || !(scene->content[0] | scene->content[1]))
        return false;
    snprintf(hash, 33, "%016llx%016llx", (unsigned long long)scene->content[1],
             (unsigned long long)scene->content[0]);
    return true;
}

/* --- notes --- */

/* A file may give cause for any number of notes; a few hundred are enough to read. */
enum { NOTES_MAX = 256 };

void lsf_scene_add_note(lsf_scene *scene, const char *format, ...)
{
    if (scene->note_count == NOTES_MAX)
        return;
    va_list arguments;
    va_start(arguments, format);
    char *note = lsf_format_arguments(format, arguments);
    va_end(arguments);
    if (!note) {
        scene->note_lost = true;
        return;
    }
    lsf_make_printable(note);
    for (uint32_t i = 0; i < scene->note_count; i++)
        if (strcmp(scene->notes[i], note) == 0) {
            free(note);
            return;
        }
    if (scene->note_count == NOTES_MAX - 1) {
        free(note);
        note = strdup("there are more such notes: they are left out");
        if (!note) {
            scene->note_lost = true;
            return;
        }
    }
    lsf_log(LSF_LOG_WARNING, "%s", note);
    char **notes = realloc(scene->notes, (scene->note_count + 1) * sizeof(char *));
    if (!notes) {
        scene->note_lost = true;
        free(note);
        return;
    }
    scene->notes = notes;
    notes[scene->note_count++] = note;
}

void lsf_scene_add_count_note(lsf_scene *scene, uint64_t count, const char *what,
                              const char *finding)
{
    if (count > 0)
        lsf_scene_add_note(scene, "%llu %s%s%s", (unsigned long long)count, what, lsf_plural(count),
                           finding);
}

void lsf_scene_note_frames(lsf_scene *scene, const lsf_frame_repairs *repairs)
{
    lsf_scene_add_count_note(scene, repairs->normals_missing, "primitive",
                             " without normals: shaded flat");
    lsf_scene_add_count_note(scene, repairs->normals_scaled, "normal",
                             " not of unit length: scaled");
    lsf_scene_add_count_note(
        scene, repairs->normals_zero, "normal",
        " without length, or not a number: replaced by those of the triangles around");
    lsf_scene_add_count_note(scene, repairs->normals_turned, "normal",
                             " on the back of all triangles around: turned over");
    lsf_scene_add_count_note(scene, repairs->tangents_scaled, "tangent",
                             " not of unit length, without a sign, or not a number: repaired");
    lsf_scene_add_count_note(
        scene, repairs->tangents_without_uv, "primitive",
        " without the texture coordinates that tangents need: arbitrary tangents are used");
}

uint32_t lsf_scene_note_count(const lsf_scene *scene)
{
    if (!scene)
        return 0;
    return scene->note_count;
}

const char *lsf_scene_note(const lsf_scene *scene, uint32_t index)
{
    if (!scene)
        return NULL;
    return index < scene->note_count ? scene->notes[index] : NULL;
}

/* --- cameras */

uint32_t lsf_scene_camera_count(const lsf_scene *scene)
{
    if (!scene)
        return 0;
    return scene->camera_count;
}

const char *lsf_scene_camera_name(const lsf_scene *scene, uint32_t index)
{
    if (!scene)
        return NULL;
    return index < scene->camera_count ? scene->cameras[index].name : NULL;
}

const lsf_requirements *lsf_scene_get_requirements(const lsf_scene *scene)
{
    if (!scene || scene->draft)
        return NULL;
    return &scene->requirements;
}

/* --- destroying */

static void free_vertices(lsf_vertices *vertices)
{
    free(vertices->position);
    free(vertices->normal);
    free(vertices->tangent);
    free(vertices->uv0);
    free(vertices->uv1);
    free(vertices->color);
}

static void free_choices(lsf_choices *choices)
{
    for (uint32_t i = 0; i < choices->count; i++)
        free(choices->items[i].name);
    free(choices->items);
}

void lsf_scene_destroy(lsf_scene *scene)
{
    if (!scene)
        return;
    if (scene->borrows) {
        lsf_scene_without_destroy(scene);
        return;
    }
    for (uint32_t i = 0; i < scene->mesh_count; i++)
        free(scene->meshes[i].name);
    for (uint32_t i = 0; i < scene->node_count; i++)
        free(scene->nodes[i].name);
    for (uint32_t i = 0; i < scene->material_count; i++)
        free(scene->materials[i].name);
    for (uint32_t i = 0; i < scene->image_count; i++) {
        free(scene->images[i].name);
        free(scene->images[i].texels);
    }
    for (uint32_t i = 0; i < scene->light_count; i++)
        free(scene->lights[i].name);
    for (uint32_t i = 0; i < scene->camera_count; i++)
        free(scene->cameras[i].name);
    for (uint32_t i = 0; i < scene->channel_count; i++) {
        free(scene->channels[i].curve.times);
        free(scene->channels[i].curve.values);
    }
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        free(scene->animated[i].curve.times);
        free(scene->animated[i].curve.values);
    }
    for (uint32_t i = 0; i < scene->shape_count; i++) {
        free(scene->shapes[i].position_deltas);
        free(scene->shapes[i].normal_deltas);
        free(scene->shapes[i].tangent_deltas);
        free(scene->shapes[i].joints);
        free(scene->shapes[i].weights);
    }
    for (uint32_t i = 0; i < scene->extension_count; i++)
        free(scene->extensions[i].name);
    for (uint32_t i = 0; i < scene->note_count; i++)
        free(scene->notes[i]);
    free_choices(&scene->scenes);
    free_choices(&scene->animations);
    free_choices(&scene->variants);
    free(scene->extensions);
    free_vertices(&scene->vertices);
    free(scene->indices);
    free(scene->primitives);
    free(scene->meshes);
    free(scene->nodes);
    free(scene->instances);
    free(scene->materials);
    free(scene->images);
    free(scene->textures);
    free(scene->lights);
    free(scene->cameras);
    free(scene->channels);
    free(scene->animated);
    free(scene->skins);
    free(scene->joints);
    free(scene->shapes);
    free(scene->deformers);
    free(scene->weights);
    free(scene->environment.texels);
    free(scene->environment.given);
    free(scene->notes);
    free(scene->path);
    free(scene->draft);
    free(scene);
}
