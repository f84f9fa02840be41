#include "build_scene.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/base.h"
#include "scene/property.h"

static void *grow(void *array, uint64_t count, size_t size)
{
    void *grown = realloc(array, (size_t)count * size);
    assert_non_null(grown);
    return grown;
}

lsf_scene *build_scene(void)
{
    lsf_scene *scene = calloc(1, sizeof *scene);
    assert_non_null(scene);
    scene->path = strdup("built by hand");
    scene->cameras = calloc(1, sizeof *scene->cameras);
    scene->cameras[0] = (lsf_camera){
        .name = strdup("camera"),
        .node = LSF_NONE,
        .matrix = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
        .fov_y = 0.8f,
        .near_plane = 1e-4f,
    };
    scene->camera_count = 1;
    return scene;
}

void destroy_scene(lsf_scene *scene)
{
    for (uint32_t i = 0; i < scene->node_count; i++)
        free(scene->nodes[i].name);
    for (uint32_t i = 0; i < scene->material_count; i++)
        free(scene->materials[i].name);
    for (uint32_t i = 0; i < scene->light_count; i++)
        free(scene->lights[i].name);
    for (uint32_t i = 0; i < scene->image_count; i++) {
        free(scene->images[i].name);
        free(scene->images[i].texels);
    }
    for (uint32_t i = 0; i < scene->channel_count; i++) {
        free(scene->channels[i].curve.times);
        free(scene->channels[i].curve.values);
    }
    for (uint32_t i = 0; i < scene->animated_count; i++) {
        free(scene->animated[i].curve.times);
        free(scene->animated[i].curve.values);
    }
    free(scene->animated);
    for (uint32_t i = 0; i < scene->shape_count; i++) {
        free(scene->shapes[i].position_deltas);
        free(scene->shapes[i].joints);
        free(scene->shapes[i].weights);
    }
    free(scene->shapes);
    free(scene->skins);
    free(scene->joints);
    free(scene->deformers);
    free(scene->weights);
    free(scene->channels);
    free(scene->cameras[0].name);
    free(scene->cameras);
    free(scene->vertices.position);
    free(scene->vertices.normal);
    free(scene->vertices.tangent);
    free(scene->vertices.uv0);
    free(scene->vertices.uv1);
    free(scene->vertices.color);
    free(scene->indices);
    free(scene->primitives);
    free(scene->nodes);
    free(scene->instances);
    free(scene->materials);
    free(scene->lights);
    free(scene->images);
    free(scene->textures);
    free(scene->environment.texels);
    free(scene->path);
    free(scene);
}

lsf_material *build_material(lsf_scene *scene, float r, float g, float b)
{
    scene->materials = grow(scene->materials, scene->material_count + 1, sizeof *scene->materials);
    lsf_texture_slot none = {.texture = LSF_NONE, .transform = {1, 0, 0, 0, 1, 0}};
    lsf_material *material = &scene->materials[scene->material_count++];
    *material = (lsf_material){
        .name = strdup("material"),
        .base_color = {r, g, b, 1.0f},
        .roughness = 1.0f,
        .normal_scale = 1.0f,
        .alpha_cutoff = 0.5f,
        .ior = 1.5f,
        .attenuation_distance = INFINITY,
        .specular = 1.0f,
        .coat_normal_scale = 1.0f,
        .specular_color = {1.0f, 1.0f, 1.0f},
        .attenuation_color = {1.0f, 1.0f, 1.0f},
        .base_color_texture = none,
        .metallic_roughness_texture = none,
        .normal_texture = none,
        .occlusion_texture = none,
        .emissive_texture = none,
        .anisotropy_texture = none,
        .transmission_texture = none,
        .specular_texture = none,
        .specular_color_texture = none,
        .coat_texture = none,
        .coat_roughness_texture = none,
        .coat_normal_texture = none,
        .sheen_color_texture = none,
        .sheen_roughness_texture = none,
    };
    return material;
}

static lsf_node *build_node(lsf_scene *scene)
{
    scene->nodes = grow(scene->nodes, scene->node_count + 1, sizeof *scene->nodes);
    lsf_node *node = &scene->nodes[scene->node_count++];
    *node = (lsf_node){
        .name = strdup("node"),
        .parent = LSF_NONE,
        .mesh = LSF_NONE,
        .camera = LSF_NONE,
        .light = LSF_NONE,
        .rotation = {0, 0, 0, 1},
        .scale = {1, 1, 1},
    };
    return node;
}

lsf_node *build_triangles(lsf_scene *scene, const lsf_float3 *corners, uint32_t triangle_count)
{
    uint32_t count = 3 * triangle_count;
    lsf_vertices *v = &scene->vertices;
    v->position = grow(v->position, 3 * (v->count + count), sizeof(float));
    v->normal = grow(v->normal, 3 * (v->count + count), sizeof(float));
    scene->indices = grow(scene->indices, scene->index_count + count, sizeof *scene->indices);
    scene->primitives =
        grow(scene->primitives, scene->primitive_count + 1, sizeof *scene->primitives);
    scene->instances = grow(scene->instances, scene->instance_count + 1, sizeof *scene->instances);
    lsf_primitive *primitive = &scene->primitives[scene->primitive_count];
    *primitive = (lsf_primitive){
        .first_index = scene->index_count,
        .index_count = count,
        .first_vertex = v->count,
        .vertex_count = count,
        .material = scene->material_count - 1,
        .deformer = LSF_NONE,
        .bounds_min = {INFINITY, INFINITY, INFINITY},
        .bounds_max = {-INFINITY, -INFINITY, -INFINITY},
    };
    for (uint32_t i = 0; i < count; i++) {
        const lsf_float3 *t = corners + i / 3 * 3;
        lsf_float3 normal = lsf_f3_normalize_or(
            lsf_f3_cross(lsf_f3_sub(t[1], t[0]), lsf_f3_sub(t[2], t[0])), lsf_f3(0, 1, 0));
        float *position = v->position + 3 * (v->count + i);
        lsf_f3_store(position, corners[i]);
        lsf_f3_store(v->normal + 3 * (v->count + i), normal);
        scene->indices[scene->index_count + i] = (uint32_t)v->count + i;
        for (int axis = 0; axis < 3; axis++) {
            primitive->bounds_min[axis] = fminf(primitive->bounds_min[axis], position[axis]);
            primitive->bounds_max[axis] = fmaxf(primitive->bounds_max[axis], position[axis]);
        }
    }
    v->count += count;
    scene->index_count += count;
    lsf_node *node = build_node(scene);
    scene->instances[scene->instance_count++] =
        (lsf_instance){scene->node_count - 1, scene->primitive_count++};
    return node;
}

lsf_node *build_quad(lsf_scene *scene, lsf_float3 a, lsf_float3 b, lsf_float3 c, lsf_float3 d)
{
    return build_triangles(scene, (lsf_float3[]){a, b, c, a, c, d}, 2);
}

lsf_node *build_floor(lsf_scene *scene, float height, float size)
{
    return build_quad(scene, lsf_f3(-size, height, size), lsf_f3(size, height, size),
                      lsf_f3(size, height, -size), lsf_f3(-size, height, -size));
}

lsf_node *build_box(lsf_scene *scene, lsf_float3 low, lsf_float3 high, bool inside)
{
    static const int faces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                    {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    lsf_float3 corners[36];
    uint32_t count = 0;
    for (int f = 0; f < 6; f++) {
        static const int order[2][6] = {{0, 1, 2, 0, 2, 3}, {0, 2, 1, 0, 3, 2}};
        for (int i = 0; i < 6; i++) {
            int corner = faces[f][order[inside][i]];
            corners[count++] = lsf_f3(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                                      corner & 4 ? high.z : low.z);
        }
    }
    return build_triangles(scene, corners, 12);
}

static uint32_t subdivide(lsf_float3 *out, lsf_float3 a, lsf_float3 b, lsf_float3 c,
                          uint32_t levels)
{
    if (levels == 0) {
        out[0] = a;
        out[1] = b;
        out[2] = c;
        return 3;
    }
    lsf_float3 ab = lsf_f3_normalize(lsf_f3_add(a, b));
    lsf_float3 bc = lsf_f3_normalize(lsf_f3_add(b, c));
    lsf_float3 ca = lsf_f3_normalize(lsf_f3_add(c, a));
    uint32_t n = subdivide(out, a, ab, ca, levels - 1);
    n += subdivide(out + n, ab, b, bc, levels - 1);
    n += subdivide(out + n, ca, bc, c, levels - 1);
    n += subdivide(out + n, ab, bc, ca, levels - 1);
    return n;
}

lsf_node *build_sphere(lsf_scene *scene, uint32_t levels, bool inside)
{
    static const float g = 1.6180340f;
    static const int faces[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                     {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                     {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                     {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const lsf_float3 p[12] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                              {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                              {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    uint32_t count = 60u << (2 * levels);
    lsf_float3 *corners = lsf_alloc(count, sizeof *corners);
    assert_non_null(corners);
    uint32_t n = 0;
    for (int f = 0; f < 20; f++) {
        lsf_float3 a = lsf_f3_normalize(p[faces[f][0]]);
        lsf_float3 b = lsf_f3_normalize(p[faces[f][inside ? 2 : 1]]);
        lsf_float3 c = lsf_f3_normalize(p[faces[f][inside ? 1 : 2]]);
        n += subdivide(corners + n, a, b, c, levels);
    }
    lsf_node *node = build_triangles(scene, corners, count / 3);
    free(corners);
    return node;
}

static void build_joint(lsf_scene *scene, lsf_float3 at)
{
    lsf_node *node = build_node(scene);
    const double translation[3] = {(double)at.x, (double)at.y, (double)at.z};
    memcpy(node->translation, translation, sizeof translation);
    scene->joints[scene->joint_count++] =
        (lsf_joint){.node = scene->node_count - 1,
                    .inverse_bind = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -at.x, -at.y, -at.z, 1}};
}

static lsf_shape build_shape(const lsf_scene *scene, const lsf_primitive *primitive,
                             lsf_float3 shift)
{
    uint32_t count = primitive->vertex_count;
    lsf_shape shape = {.vertex_count = count,
                       .target_count = 1,
                       .position_deltas = grow(NULL, 3 * count, sizeof(float)),
                       .influences = 2,
                       .joints = grow(NULL, 2 * count, sizeof(uint16_t)),
                       .weights = grow(NULL, 2 * count, sizeof(float))};
    float low = primitive->bounds_min[1], height = primitive->bounds_max[1] - low;
    for (uint32_t i = 0; i < count; i++) {
        float y = scene->vertices.position[3 * (primitive->first_vertex + i) + 1];
        lsf_f3_store(shape.position_deltas + 3 * (size_t)i, shift);
        shape.joints[2 * i] = 0;
        shape.joints[2 * i + 1] = 1;
        shape.weights[2 * i + 1] = (y - low) / height;
        shape.weights[2 * i] = 1.0f - shape.weights[2 * i + 1];
    }
    return shape;
}

uint32_t build_deformer(lsf_scene *scene, lsf_float3 shift)
{
    lsf_primitive *primitive = &scene->primitives[scene->primitive_count - 1];
    const float *low = primitive->bounds_min, *high = primitive->bounds_max;
    float x = 0.5f * (low[0] + high[0]), z = 0.5f * (low[2] + high[2]);
    lsf_node *node = &scene->nodes[scene->node_count - 1];
    primitive->deformer = scene->deformer_count;
    node->first_weight = scene->weight_count;
    node->weight_count = 1;
    scene->weights = grow(scene->weights, ++scene->weight_count, sizeof *scene->weights);
    scene->weights[scene->weight_count - 1] = 0.0f;
    scene->shapes = grow(scene->shapes, scene->shape_count + 1, sizeof *scene->shapes);
    scene->shapes[scene->shape_count++] = build_shape(scene, primitive, shift);
    scene->deformers = grow(scene->deformers, scene->deformer_count + 1, sizeof *scene->deformers);
    scene->deformers[scene->deformer_count++] =
        (lsf_deformer){.shape = scene->shape_count - 1,
                       .node = scene->node_count - 1,
                       .skin = scene->skin_count,
                       .first_vertex = primitive->first_vertex};
    scene->skins = grow(scene->skins, scene->skin_count + 1, sizeof *scene->skins);
    scene->skins[scene->skin_count++] = (lsf_skin){scene->joint_count, 2};
    scene->joints = grow(scene->joints, scene->joint_count + 2, sizeof *scene->joints);
    build_joint(scene, lsf_f3(x, low[1], z));
    build_joint(scene, lsf_f3(x, 0.5f * (low[1] + high[1]), z));
    return scene->node_count - 1;
}

void build_channel(lsf_scene *scene, uint32_t node, lsf_animation_path path, const float *values,
                   size_t bytes)
{
    static const float times[] = {0, 1};
    scene->channels = grow(scene->channels, scene->channel_count + 1, sizeof *scene->channels);
    lsf_animation_channel *channel = &scene->channels[scene->channel_count++];
    *channel = (lsf_animation_channel){.node = node,
                                       .path = path,
                                       .curve = {.interpolation = LSF_LINEAR,
                                                 .key_count = 2,
                                                 .width = path == LSF_PATH_WEIGHTS
                                                              ? scene->nodes[node].weight_count
                                                          : path == LSF_PATH_ROTATION ? 4
                                                                                      : 3,
                                                 .times = malloc(sizeof times),
                                                 .values = malloc(bytes)}};
    memcpy(channel->curve.times, times, sizeof times);
    memcpy(channel->curve.values, values, bytes);
}

void build_value(lsf_scene *scene, lsf_kind kind, uint32_t index, const char *name,
                 const float *values)
{
    static const float times[] = {0, 1};
    scene->animated = grow(scene->animated, scene->animated_count + 1, sizeof *scene->animated);
    lsf_animated_value *value = &scene->animated[scene->animated_count++];
    *value = (lsf_animated_value){.index = index, .first = scene->animated_width};
    value->property = lsf_property_find(kind, name, &value->slot);
    assert_non_null(value->property);
    size_t bytes = 2 * value->property->width * sizeof *values;
    value->curve = (lsf_curve){.interpolation = kind == LSF_KIND_NODE ? LSF_STEP : LSF_LINEAR,
                               .key_count = 2,
                               .width = value->property->width,
                               .times = malloc(sizeof times),
                               .values = malloc(bytes)};
    memcpy(value->curve.times, times, sizeof times);
    memcpy(value->curve.values, values, bytes);
    scene->animated_width += value->curve.width;
}

lsf_light *build_light(lsf_scene *scene, lsf_light_type type, lsf_float3 position,
                       lsf_float3 direction, float intensity)
{
    scene->lights = grow(scene->lights, scene->light_count + 1, sizeof *scene->lights);
    lsf_node *node = build_node(scene);
    node->light = scene->light_count;
    node->has_matrix = true;
    lsf_basis frame = lsf_basis_about(lsf_f3_normalize(lsf_f3_scale(direction, -1.0f)));
    const double matrix[16] = {frame.t.x,  frame.t.y,  frame.t.z,  0,         frame.b.x, frame.b.y,
                               frame.b.z,  0,          frame.n.x,  frame.n.y, frame.n.z, 0,
                               position.x, position.y, position.z, 1};
    memcpy(node->matrix, matrix, sizeof matrix);
    lsf_light *light = &scene->lights[scene->light_count++];
    *light = (lsf_light){
        .name = strdup("light"),
        .type = type,
        .intensity = {intensity, intensity, intensity},
        .range = INFINITY,
        .outer_cone = 0.7853982f,
    };
    return light;
}

void build_environment(lsf_scene *scene, float radiance)
{
    scene->environment.present = true;
    for (int c = 0; c < 3; c++)
        scene->environment.radiance[c] = radiance;
}

float *build_environment_map(lsf_scene *scene, uint32_t width, uint32_t height)
{
    float *texels = calloc((size_t)width * height, 3 * sizeof *texels);
    scene->environment =
        (lsf_environment){.present = true, .width = width, .height = height, .texels = texels};
    return texels;
}

lsf_material *build_glass(lsf_scene *scene, float base, float roughness, float ior)
{
    lsf_material *material = build_material(scene, base, base, base);
    material->roughness = roughness;
    material->transmission = 1.0f;
    material->volume = ior > 0.0f;
    material->ior = ior > 0.0f ? ior : 1.5f;
    return material;
}

void build_corner(lsf_scene *scene)
{
    build_material(scene, 0.7f, 0.6f, 0.5f);
    build_floor(scene, 0.0f, 2.0f);
    build_material(scene, 0.3f, 0.6f, 0.8f);
    build_quad(scene, lsf_f3(-2, 0, -2), lsf_f3(2, 0, -2), lsf_f3(2, 3, -2), lsf_f3(-2, 3, -2));
    build_material(scene, 0.8f, 0.3f, 0.2f);
    build_quad(scene, lsf_f3(-2, 0, 2), lsf_f3(-2, 0, -2), lsf_f3(-2, 3, -2), lsf_f3(-2, 3, 2));
    build_material(scene, 0.6f, 0.6f, 0.6f)->roughness = 0.5f;
    build_box(scene, lsf_f3(0.2f, 0, -1), lsf_f3(1.1f, 0.9f, -0.1f), false);
}

void build_lit_corner(lsf_scene *scene)
{
    build_corner(scene);
    lsf_material *lamp = build_material(scene, 0.5f, 0.5f, 0.5f);
    lamp->emission[0] = lamp->emission[1] = lamp->emission[2] = 4.0f;
    build_quad(scene, lsf_f3(-1, 2, -1), lsf_f3(0, 2, -1), lsf_f3(0, 2, 0), lsf_f3(-1, 2, 0));
    build_glass(scene, 0.9f, 0.2f, 0.0f);
    build_quad(scene, lsf_f3(-1.5f, 0, 0.5f), lsf_f3(0, 0, 0.5f), lsf_f3(0, 1, 0.5f),
               lsf_f3(-1.5f, 1, 0.5f));
    build_light(scene, LSF_LIGHT_POINT, lsf_f3(1, 2, 1), lsf_f3(0, -1, 0), 5.0f);
}

uint32_t build_texture(lsf_scene *scene, uint32_t width, uint32_t height, uint32_t channels,
                       const uint8_t *texels, bool srgb)
{
    scene->images = grow(scene->images, scene->image_count + 1, sizeof *scene->images);
    scene->textures = grow(scene->textures, scene->texture_count + 1, sizeof *scene->textures);
    size_t size = (size_t)width * height * channels;
    lsf_texture_image *image = &scene->images[scene->image_count];
    *image = (lsf_texture_image){
        .name = strdup("image"),
        .width = width,
        .height = height,
        .channels = channels,
        .type = LSF_TEXEL_U8,
        .texels = malloc(size),
    };
    memcpy(image->texels, texels, size);
    scene->textures[scene->texture_count] =
        (lsf_texture){.image = scene->image_count++, .srgb = srgb};
    return scene->texture_count++;
}

void finish_scene(lsf_scene *scene)
{
    lsf_requirements *r = &scene->requirements;
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint64_t i = 0; i < 3 * scene->vertices.count; i++) {
        low[i % 3] = fmin(low[i % 3], scene->vertices.position[i]);
        high[i % 3] = fmax(high[i % 3], scene->vertices.position[i]);
    }
    double extent = 0.0;
    for (int axis = 0; axis < 3 && scene->vertices.count != 0; axis++) {
        r->center[axis] = 0.5 * (low[axis] + high[axis]);
        extent = fmax(extent, 0.5 * (high[axis] - low[axis]));
    }
    r->scale = extent > 0.0 ? exp2(-ceil(log2(extent))) : 1.0;
}
