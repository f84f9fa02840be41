#include "scene/scene.h"

#include "base/base.h"
#include "scene/animated.h"
#include "scene/hierarchy.h"
#include "scene/pose.h"
#include "scene/property.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Vertices visited for exact bounds. Beyond that number (a mesh placed a million times)
 * instances are represented by the corners of their boxes, which can only enlarge the bounds. */
#define EXACT_VISITS_MAX ((uint64_t)1 << 26)

/* --- materials --- */

static bool in_use(lsf_requirements *r, const lsf_texture_slot *slot)
{
    static const float identity[6] = {1, 0, 0, 0, 1, 0};
    if (slot->texture == LSF_NONE)
        return false;
    r->second_uv = r->second_uv || slot->uv_set == 1;
    r->texture_transformed =
        r->texture_transformed || memcmp(slot->transform, identity, sizeof(identity)) != 0;
    return true;
}

/* Occlusion maps are never read: occlusion is computed. */
static void add_material(lsf_requirements *r, const lsf_material *material, bool diffuse_only)
{
    r->masked |= material->alpha_mode == LSF_ALPHA_MASK;
    r->blended |= material->alpha_mode == LSF_ALPHA_BLEND;
    r->base_color_textured |= in_use(r, &material->base_color_texture);
    if (material->unlit) {
        r->unlit = true;
        return;
    }
    if (material->emission[0] > 0.0f || material->emission[1] > 0.0f ||
        material->emission[2] > 0.0f) {
        r->emissive = true;
        r->emissive_textured |= in_use(r, &material->emissive_texture);
    }
    if (diffuse_only)
        return;
    r->specular = true;
    bool textured = in_use(r, &material->metallic_roughness_texture);
    r->metallic_roughness_textured |= textured;
    r->glossy |= textured || material->roughness < 1.0f || material->metallic > 0.0f;
    /* Voxels mirror where alpha, of a roughness of 8 bits, is below 1/2 (lib/voxel_lamp.glsl). */
    r->smooth_metal |= material->metallic >= 0.5f && (textured || material->roughness < 0.71f);
    bool weighted = in_use(r, &material->specular_texture);
    bool tinted = in_use(r, &material->specular_color_texture);
    const float *tint = material->specular_color;
    bool varied = weighted || tinted || material->specular < 1.0f || tint[0] != 1.0f ||
                  tint[1] != 1.0f || tint[2] != 1.0f;
    r->specular_varied |= varied;
    r->specular_textured |= weighted;
    r->specular_color_textured |= tinted;
    r->variable_ior |= material->ior != 1.5f || varied;
    r->normal_mapped |= in_use(r, &material->normal_texture);
    if (material->sheen_color[0] > 0.0f || material->sheen_color[1] > 0.0f ||
        material->sheen_color[2] > 0.0f) {
        r->sheened = r->glossy = true;
        r->sheen_color_textured |= in_use(r, &material->sheen_color_texture);
        r->sheen_roughness_textured |= in_use(r, &material->sheen_roughness_texture);
    }
    if (material->coat > 0.0f) {
        r->coated = r->glossy = true;
        r->coat_textured |= in_use(r, &material->coat_texture);
        r->coat_roughness_textured |= in_use(r, &material->coat_roughness_texture);
        r->coat_normal_mapped |= in_use(r, &material->coat_normal_texture);
    }
    if (material->anisotropy_strength > 0.0f) {
        r->anisotropic = true;
        r->anisotropy_textured |= in_use(r, &material->anisotropy_texture);
    }
    if (material->transmission > 0.0f) {
        r->transmissive = true;
        r->refractive |= material->volume;
        r->thin_walls |= lsf_material_is_thin_wall(material);
        r->rough_walls |= lsf_material_is_rough_wall(material);
        r->transmission_textured |= in_use(r, &material->transmission_texture);
    }
}

/* --- nodes --- */

static void add_lights(const lsf_scene *scene, lsf_requirements *r)
{
    for (uint32_t i = 0; i < scene->node_count; i++) {
        if (scene->nodes[i].light == LSF_NONE)
            continue;
        lsf_light_type type = scene->lights[scene->nodes[i].light].type;
        r->point_lights += type == LSF_LIGHT_POINT;
        r->spot_lights += type == LSF_LIGHT_SPOT;
        r->directional_lights += type == LSF_LIGHT_DIRECTIONAL;
    }
    r->directional_lights += scene->key_light.present;
    r->point_lights += scene->default_lamp.present;
}

/* Nodes that an animation or a program moves, by themselves or with an ancestor; a node that is
 * shown and hidden counts as moving. */
static bool *find_moving_nodes(const lsf_scene *scene)
{
    bool *moves = lsf_alloc(scene->node_count, sizeof *moves);
    for (uint32_t i = 0; moves && i < scene->channel_count; i++)
        moves[scene->channels[i].node] |= scene->channels[i].path != LSF_PATH_WEIGHTS;
    for (uint32_t i = 0; moves && i < scene->animated_count; i++)
        if (scene->animated[i].property == lsf_property_visible)
            moves[scene->animated[i].index] = true;
    for (uint32_t i = 0; moves && i < scene->node_count; i++) {
        uint32_t parent = scene->nodes[i].parent;
        moves[i] = moves[i] || scene->nodes[i].edited || (parent != LSF_NONE && moves[parent]);
    }
    return moves;
}

/* For each deformer, whether its joints move or its weights change. */
static bool *find_moving_deformers(const lsf_scene *scene, const bool *nodes)
{
    bool *moves = lsf_alloc(scene->deformer_count, sizeof *moves);
    bool *weights = lsf_alloc(scene->weight_count, sizeof *weights);
    for (uint32_t i = 0; moves && weights && i < scene->channel_count; i++) {
        const lsf_animation_channel *channel = &scene->channels[i];
        if (channel->path == LSF_PATH_WEIGHTS)
            weights[scene->nodes[channel->node].first_weight] = true;
    }
    for (uint32_t i = 0; moves && weights && i < scene->deformer_count; i++) {
        const lsf_deformer *d = &scene->deformers[i];
        const lsf_node *node = &scene->nodes[d->node];
        moves[i] = node->weight_count > 0 && weights[node->first_weight];
        if (d->skin == LSF_NONE) {
            moves[i] = moves[i] || nodes[d->node];
            continue;
        }
        const lsf_skin *skin = &scene->skins[d->skin];
        for (uint32_t k = 0; k < skin->joint_count && !moves[i]; k++)
            moves[i] = nodes[scene->joints[skin->first_joint + k].node];
    }
    if (!weights) {
        free(moves);
        return NULL;
    }
    free(weights);
    return moves;
}

bool lsf_scene_moving_instances(const lsf_scene *scene, bool *moves)
{
    bool *nodes = find_moving_nodes(scene);
    bool *deformers = nodes ? find_moving_deformers(scene, nodes) : NULL;
    for (uint32_t i = 0; deformers && i < scene->instance_count; i++) {
        uint32_t deformer = scene->primitives[scene->instances[i].primitive].deformer;
        moves[i] = deformer == LSF_NONE ? nodes[scene->instances[i].node] : deformers[deformer];
    }
    bool enough = deformers != NULL;
    free(nodes);
    free(deformers);
    return enough;
}

/* Finds whether an instance, a light or a camera moves. False without memory. */
static bool find_moving(const lsf_scene *scene, lsf_requirements *r)
{
    if (scene->channel_count == 0 && scene->animated_count == 0 && scene->edits.nodes == 0)
        return true;
    bool *nodes = find_moving_nodes(scene);
    bool *instances = lsf_alloc(scene->instance_count, sizeof *instances);
    bool enough = nodes && instances && lsf_scene_moving_instances(scene, instances);
    for (uint32_t i = 0; enough && i < scene->node_count; i++) {
        const lsf_node *node = &scene->nodes[i];
        bool carries = node->light != LSF_NONE || node->camera != LSF_NONE;
        r->moving = r->moving || (nodes[i] && carries);
    }
    for (uint32_t i = 0; enough && i < scene->instance_count; i++)
        r->moving = r->moving || instances[i];
    free(nodes);
    free(instances);
    return enough;
}

/* --- bounds --- */

static void grow(lsf_requirements *r, const double *matrix, const double point[3])
{
    double world[3];
    lsf_transform_point(matrix, point, world);
    for (int c = 0; c < 3; c++) {
        r->bounds_min[c] = fmin(r->bounds_min[c], world[c]);
        r->bounds_max[c] = fmax(r->bounds_max[c], world[c]);
    }
}

static bool covers(const lsf_requirements *outer, const lsf_requirements *inner)
{
    for (int c = 0; c < 3; c++)
        if (!(inner->bounds_min[c] >= outer->bounds_min[c] &&
              inner->bounds_max[c] <= outer->bounds_max[c]))
            return false;
    return true;
}

static void clear_bounds(lsf_requirements *r)
{
    for (int c = 0; c < 3; c++) {
        r->bounds_min[c] = INFINITY;
        r->bounds_max[c] = -INFINITY;
    }
}

static void add_bounds(const lsf_scene *scene, const lsf_pose *pose, const lsf_primitive *primitive,
                       const double *matrix, uint64_t *visits, lsf_requirements *r)
{
    lsf_requirements box;
    clear_bounds(&box);
    for (int corner = 0; corner < 8; corner++) {
        double point[3];
        for (int c = 0; c < 3; c++)
            point[c] = corner & (1 << c) ? primitive->bounds_max[c] : primitive->bounds_min[c];
        grow(&box, matrix, point);
    }
    if (covers(r, &box))
        return;
    *visits += primitive->index_count;
    if (*visits > EXACT_VISITS_MAX) {
        for (int c = 0; c < 3; c++) {
            r->bounds_min[c] = fmin(r->bounds_min[c], box.bounds_min[c]);
            r->bounds_max[c] = fmax(r->bounds_max[c], box.bounds_max[c]);
        }
        return;
    }
    for (uint64_t i = 0; i < primitive->index_count; i++) {
        const float *p =
            pose->vertices.position + 3 * (size_t)scene->indices[primitive->first_index + i];
        double point[3] = {p[0], p[1], p[2]};
        grow(r, matrix, point);
    }
}

/* The power of two that brings the half extent into (0.5, 1]. */
static double normalizing_scale(double half_extent)
{
    if (!(half_extent > 1e-200)) /* nothing, a point, or beyond what a double can normalise */
        return 1.0;
    int exponent;
    double mantissa = frexp(half_extent, &exponent); /* in [0.5, 1) */
    return ldexp(1.0, mantissa == 0.5 ? 1 - exponent : -exponent);
}

static void find_center(lsf_requirements *r)
{
    double largest = 0.0;
    for (int c = 0; c < 3; c++) {
        bool empty = r->bounds_min[c] > r->bounds_max[c];
        r->center[c] = empty ? 0.0 : 0.5 * (r->bounds_min[c] + r->bounds_max[c]);
        largest = empty ? 0.0 : fmax(largest, 0.5 * (r->bounds_max[c] - r->bounds_min[c]));
    }
    r->scale = normalizing_scale(largest);
}

/* --- all --- */

static uint64_t count_degenerate(const lsf_scene *scene, const lsf_primitive *primitive)
{
    uint64_t count = 0;
    for (uint64_t i = 0; i < primitive->index_count; i += 3) {
        const uint32_t *corner = scene->indices + primitive->first_index + i;
        const float *a = scene->vertices.position + 3 * (size_t)corner[0];
        const float *b = scene->vertices.position + 3 * (size_t)corner[1];
        const float *c = scene->vertices.position + 3 * (size_t)corner[2];
        double u[3], v[3];
        for (int k = 0; k < 3; k++) {
            u[k] = (double)b[k] - (double)a[k];
            v[k] = (double)c[k] - (double)a[k];
        }
        count +=
            u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2] && u[0] * v[1] == u[1] * v[0];
    }
    return count;
}

/* Cosine of half a degree, the angle up to which a vertex normal is taken for its triangle's:
 * 8-bit normals are rounded by as much. */
#define FLAT_COSINE 0.99996

static bool is_flat(const lsf_scene *scene, const uint32_t corners[3])
{
    double p[3][3], face[3], length2 = 0.0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            p[i][k] = (double)scene->vertices.position[3 * (size_t)corners[i] + (size_t)k];
    for (int k = 0; k < 3; k++) {
        int u = (k + 1) % 3, v = (k + 2) % 3;
        face[k] =
            (p[1][u] - p[0][u]) * (p[2][v] - p[0][v]) - (p[1][v] - p[0][v]) * (p[2][u] - p[0][u]);
        length2 += face[k] * face[k];
    }
    for (int i = 0; i < 3; i++) {
        const float *n = scene->vertices.normal + 3 * (size_t)corners[i];
        double along = 0.0, n2 = 0.0;
        for (int k = 0; k < 3; k++) {
            along += face[k] * (double)n[k];
            n2 += (double)n[k] * (double)n[k];
        }
        if (along < FLAT_COSINE * sqrt(length2 * n2))
            return false;
    }
    return true;
}

static bool is_smooth(const lsf_scene *scene, const lsf_primitive *primitive)
{
    bool flat = true;
    for (uint64_t i = 0; scene->vertices.normal && flat && i < primitive->index_count; i += 3)
        flat = is_flat(scene, scene->indices + primitive->first_index + i);
    return !flat;
}

/* A surface that is flat at rest is not when it is bent, unless normals are recomputed. */
static void note_deformer(lsf_requirements *r, const lsf_scene *scene,
                          const lsf_primitive *primitive)
{
    if (primitive->deformer == LSF_NONE)
        return;
    const lsf_deformer *deformer = &scene->deformers[primitive->deformer];
    const lsf_shape *shape = &scene->shapes[deformer->shape];
    r->skinned = r->skinned || deformer->skin != LSF_NONE;
    r->morphed = r->morphed || shape->target_count > 0;
    r->smooth = r->smooth || !shape->flat;
}

/* False without memory. */
static bool add_instances(const lsf_scene *scene, lsf_requirements *r)
{
    double *matrices = lsf_alloc(scene->node_count, 16 * sizeof(double));
    bool *primitive_seen = lsf_alloc(scene->primitive_count, sizeof(bool));
    /* Keyed by the first triangle of a list: primitives may share lists. */
    bool *list_seen = lsf_alloc(scene->index_count / 3, sizeof(bool));
    bool enough = matrices && primitive_seen && list_seen;
    lsf_pose pose = {0};
    uint64_t visits = 0;
    if (enough) {
        lsf_scene_world_matrices(scene, 0.0, matrices);
        enough = lsf_pose_update(&pose, scene, 0.0, matrices);
    }
    for (uint32_t i = 0; enough && i < scene->instance_count; i++) {
        const lsf_instance *instance = &scene->instances[i];
        const lsf_primitive *primitive = &pose.primitives[instance->primitive];
        if (primitive->index_count == 0)
            continue;
        r->instances++;
        r->triangles += primitive->index_count / 3;
        if (isfinite(primitive->bounds_max[0]))
            add_bounds(scene, &pose, primitive, lsf_pose_world(&pose, scene, matrices, i), &visits,
                       r);
        if (!primitive_seen[instance->primitive]) {
            primitive_seen[instance->primitive] = true;
            r->primitives++;
        }
        if (!list_seen[primitive->first_index / 3]) {
            list_seen[primitive->first_index / 3] = true;
            r->unique_triangles += primitive->index_count / 3;
            r->degenerate_triangles += count_degenerate(scene, primitive);
            r->smooth = r->smooth || is_smooth(scene, primitive);
            note_deformer(r, scene, primitive);
        }
    }
    lsf_pose_finish(&pose);
    free(matrices);
    free(primitive_seen);
    free(list_seen);
    return enough;
}

/* Adds what materials require, with all values that animations give them. False without memory. */
static bool add_materials(const lsf_scene *scene, lsf_requirements *r)
{
    bool *seen = lsf_alloc(scene->material_count, sizeof(bool));
    lsf_animated_range range;
    if (!seen || !lsf_animated_find_range(&range, scene)) {
        free(seen);
        return false;
    }
    for (uint32_t i = 0; i < scene->instance_count; i++) {
        const lsf_primitive *primitive = &scene->primitives[scene->instances[i].primitive];
        if (primitive->index_count == 0 || seen[primitive->material])
            continue;
        seen[primitive->material] = true;
        r->materials++;
        for (int end = 0; end < 2; end++)
            add_material(r, &range.materials[end][primitive->material], scene->diffuse_only);
    }
    free(seen);
    lsf_animated_range_finish(&range);
    /* docs/measuring.md has what three bounces leave out. Every crossing of a surface is a bounce.
     * Seen through a vase or a bottle, the world lies behind two walls of glass with two sides
     * each; through solid bodies, behind two of them. */
    r->bounces = r->transmissive ? 7 : 3;
    return true;
}

static void add_environment(const lsf_scene *scene, lsf_requirements *r)
{
    const lsf_environment *environment = &scene->environment;
    r->environment_map = environment->present && environment->width > 0;
    r->environment = r->environment_map ||
                     (environment->present &&
                      (environment->radiance[0] > 0.0f || environment->radiance[1] > 0.0f ||
                       environment->radiance[2] > 0.0f));
}

bool lsf_scene_compute_requirements(lsf_scene *scene)
{
    lsf_requirements *r = &scene->requirements;
    memset(r, 0, sizeof(*r));
    clear_bounds(r);
    add_lights(scene, r);
    if (!add_instances(scene, r) || !add_materials(scene, r) || !find_moving(scene, r) ||
        !lsf_scene_find_open_media(scene))
        return false;
    find_center(r);
    add_environment(scene, r);
    r->vertex_colored = scene->vertices.color != NULL && r->instances > 0;
    r->vertices = scene->vertices.count;
    r->textures = scene->texture_count;
    return true;
}

bool lsf_scene_update_requirements(lsf_scene *scene)
{
    const lsf_requirements old = scene->requirements;
    lsf_requirements r;
    memset(&r, 0, sizeof r); /* clears padding, too: requirements are compared as bytes */
    add_lights(scene, &r);
    if (!add_materials(scene, &r) || !find_moving(scene, &r))
        return false;
    add_environment(scene, &r);
    r.smooth = old.smooth;
    r.skinned = old.skinned;
    r.morphed = old.morphed;
    r.vertex_colored = old.vertex_colored;
    r.triangles = old.triangles;
    r.unique_triangles = old.unique_triangles;
    r.degenerate_triangles = old.degenerate_triangles;
    r.vertices = old.vertices;
    r.instances = old.instances;
    r.primitives = old.primitives;
    r.textures = old.textures;
    r.scale = old.scale;
    memcpy(r.center, old.center, sizeof r.center);
    memcpy(r.bounds_min, old.bounds_min, sizeof r.bounds_min);
    memcpy(r.bounds_max, old.bounds_max, sizeof r.bounds_max);
    memcpy(&scene->requirements, &r, sizeof r);
    return true;
}
