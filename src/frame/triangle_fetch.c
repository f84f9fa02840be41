#include "frame/triangle_fetch.h"

#include <string.h>

#include "base/base.h"

#define FIRST_UNIT 6

/* Locations in lib/triangle_fetch.glsl. */
#define LOCATION_RANGE 1
#define LOCATION_TRANSFORM 2
#define LOCATION_NORMAL_TRANSFORM 5
#define LOCATION_MATERIAL 9

bool lsf_triangle_fetch_create(lsf_triangle_fetch *fetch, lsf_context *context, lsf_error *error)
{
    return lsf_buffer_textures_create(context, LSF_COUNT(fetch->streams), fetch->streams, error);
}

void lsf_triangle_fetch_bind(const lsf_triangle_fetch *fetch, const lsf_scene_gpu *scene)
{
    const struct {
        GLenum format;
        GLuint buffer;
    } streams[LSF_COUNT(fetch->streams)] = {
        {GL_R32UI, scene->indices},    {GL_RGB32F, scene->positions}, {GL_RGB32F, scene->normals},
        {GL_RGBA32F, scene->tangents}, {GL_RG32F, scene->uv0},        {GL_RG32F, scene->uv1},
        {GL_RGBA32F, scene->colors}};
    for (GLuint i = 0; i < LSF_COUNT(streams); i++) {
        glTextureBuffer(fetch->streams[i], streams[i].format, streams[i].buffer);
        lsf_bind_texture(FIRST_UNIT + i, fetch->streams[i]);
    }
}

void lsf_triangle_fetch_instance(const lsf_iteration *iteration, uint32_t instance, uint32_t first,
                                 uint32_t count)
{
    const lsf_instance_state *state = &iteration->state->instances[instance];
    const lsf_scene *scene = iteration->scene->scene;
    const lsf_primitive *primitive = &scene->primitives[state->primitive];
    struct lsf_material_data material = lsf_scene_gpu_material(
        scene, &iteration->state->animated.materials[state->material], state->material);
    float normal[12] = {0};
    for (int row = 0; row < 3; row++)
        memcpy(normal + 4 * row, state->normal_transform + 3 * row, 3 * sizeof *normal);
    glUniform4ui(LOCATION_RANGE, (GLuint)primitive->first_index + 3 * first, count, instance,
                 state->mirrored);
    glUniform4fv(LOCATION_TRANSFORM, 3, state->transform);
    glUniform4fv(LOCATION_NORMAL_TRANSFORM, 3, normal);
    glUniform4fv(LOCATION_MATERIAL, sizeof material / sizeof(lsf_vec4), &material.base_color.x);
}

void lsf_triangle_fetch_destroy(lsf_triangle_fetch *fetch)
{
    glDeleteTextures(LSF_COUNT(fetch->streams), fetch->streams);
}
