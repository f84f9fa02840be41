#include "reference/geometry.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/base.h"
#include "math/sampling.h"
#include "reference/surface.h"

/* Bytes that Embree needs for each triangle, for its tree at good quality and while it builds
 * it. */
#define TREE_BYTES_PER_TRIANGLE 220u

/* User data that Embree passes to the filters. */
typedef struct ray_context {
    struct RTCIntersectContext embree;
    const lsf_reference_geometry *geometry;
    lsf_reference_chance chance;
    lsf_reference_hit seen; /* by a ray from the camera, so far */
} ray_context;

/* A number below 1, so that surfaces of alpha 1 are always present; the same however often
 * Embree asks. */
static float number_of(const struct RTCIntersectContext *context, const lsf_reference_hit *hit)
{
    lsf_reference_chance chance = ((const ray_context *)context)->chance;
    uint32_t seed = lsf_hash(lsf_hash(chance.seed, hit->instance), hit->triangle);
    return lsf_sobol_1d(chance.sample, seed);
}

/* Masks need no random number, and rays of lsf_reference_rays bring none. */
static bool is_there(const lsf_reference_mesh *mesh, const lsf_reference_hit *hit,
                     const struct RTCIntersectContext *context)
{
    float coverage = lsf_reference_coverage(mesh->geometry, hit);
    return coverage > 0.0f && (coverage >= 1.0f || number_of(context, hit) < coverage);
}

/* struct RTCHitN is arrays of N values: the normal's x, y and z, u, v, the triangle's number,
 * ...; Embree's accessors for them exist in C++ only. */
static void reject_cut_out(const struct RTCFilterFunctionNArguments *arguments)
{
    const lsf_reference_mesh *mesh = arguments->geometryUserPtr;
    const float *values = (const float *)arguments->hit;
    const unsigned *numbers = (const unsigned *)arguments->hit;
    size_t count = arguments->N;
    for (size_t i = 0; i < count; i++) {
        lsf_reference_hit hit = {mesh->instance, numbers[5 * count + i], values[3 * count + i],
                                 values[4 * count + i], 0.0f};
        if (arguments->valid[i] != 0 && !is_there(mesh, &hit, arguments->context))
            arguments->valid[i] = 0;
    }
}

/* Whether triangle `a` is drawn before `b`: instances are drawn material by material. */
static bool is_drawn_before(const lsf_state *state, const lsf_reference_hit *a,
                            const lsf_reference_hit *b)
{
    uint32_t material_a = state->instances[a->instance].material;
    uint32_t material_b = state->instances[b->instance].material;
    if (material_a != material_b)
        return material_a < material_b;
    return a->instance != b->instance ? a->instance < b->instance : a->triangle < b->triangle;
}

static bool hides_back(const lsf_reference_geometry *geometry, const lsf_reference_hit *hit,
                       lsf_float3 direction)
{
    const lsf_instance_state *instance = &geometry->state->instances[hit->instance];
    if (!lsf_material_hides_back(geometry->scene,
                                 &geometry->state->animated.materials[instance->material]))
        return false;
    lsf_float3 corners[3];
    lsf_reference_corners(geometry, hit->instance, hit->triangle, corners);
    lsf_float3 normal =
        lsf_f3_cross(lsf_f3_sub(corners[1], corners[0]), lsf_f3_sub(corners[2], corners[0]));
    return (lsf_f3_dot(normal, direction) > 0.0f) != instance->mirrored;
}

/* For single rays from the camera: hidden back faces are not seen, and of surfaces at the same
 * distance the one that is drawn first is, as with GL_LESS. */
static void reject_unseen(const struct RTCFilterFunctionNArguments *arguments)
{
    ray_context *context = (ray_context *)arguments->context;
    const struct RTCRay *ray = (const struct RTCRay *)arguments->ray;
    const struct RTCHit *at = (const struct RTCHit *)arguments->hit;
    lsf_reference_hit hit = {at->geomID, at->primID, at->u, at->v, ray->tfar};
    lsf_reference_hit *seen = &context->seen;
    bool behind =
        hit.distance == seen->distance && !is_drawn_before(context->geometry->state, &hit, seen);
    if (behind || hides_back(context->geometry, &hit, lsf_f3(ray->dir_x, ray->dir_y, ray->dir_z)))
        arguments->valid[0] = 0;
    else
        *seen = hit;
}

static bool transform_positions(lsf_reference_mesh *mesh, const lsf_scene *scene,
                                const lsf_state *state, const lsf_instance_state *instance)
{
    const lsf_primitive *primitive = &scene->primitives[instance->primitive];
    /* Embree loads the last vertex with a 16-byte read. */
    mesh->positions = lsf_alloc((uint64_t)primitive->vertex_count * 3 + 4, sizeof(float));
    if (mesh->positions == NULL)
        return false;
    const float *m = instance->transform;
    for (uint32_t i = 0; i < primitive->vertex_count; i++) {
        const float *p = state->pose.vertices.position + 3 * (primitive->first_vertex + i);
        for (int row = 0; row < 3; row++)
            mesh->positions[3 * (uint64_t)i + row] =
                m[4 * row] * p[0] + m[4 * row + 1] * p[1] + m[4 * row + 2] * p[2] + m[4 * row + 3];
    }
    return true;
}

static bool local_indices(lsf_reference_geometry *geometry, uint32_t primitive_index)
{
    const lsf_primitive *primitive = &geometry->scene->primitives[primitive_index];
    if (geometry->indices[primitive_index] != NULL)
        return true;
    uint32_t *list = lsf_alloc(primitive->index_count, sizeof *list);
    if (list == NULL)
        return false;
    for (uint32_t i = 0; i < primitive->index_count; i++)
        list[i] = geometry->scene->indices[primitive->first_index + i] -
                  (uint32_t)primitive->first_vertex;
    geometry->indices[primitive_index] = list;
    return true;
}

static bool add_instance(lsf_reference_geometry *geometry, uint32_t index, lsf_reference_use use)
{
    const lsf_scene *scene = geometry->scene;
    const lsf_instance_state *instance = &geometry->state->instances[index];
    lsf_reference_mesh *mesh = &geometry->meshes[index];
    mesh->geometry = geometry;
    mesh->instance = index;
    if (instance->skipped)
        return true;
    if (!transform_positions(mesh, scene, geometry->state, instance) ||
        !local_indices(geometry, instance->primitive))
        return false;
    const lsf_primitive *primitive = &scene->primitives[instance->primitive];
    mesh->triangle_count = primitive->index_count / 3;
    mesh->indices = geometry->indices[instance->primitive];

    RTCGeometry shape = rtcNewGeometry(geometry->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, mesh->positions,
                               0, 3 * sizeof(float), primitive->vertex_count);
    rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->indices, 0,
                               3 * sizeof(uint32_t), mesh->triangle_count);
    lsf_alpha_mode mode = geometry->state->animated.materials[instance->material].alpha_mode;
    if (mode == LSF_ALPHA_MASK || (mode == LSF_ALPHA_BLEND && use == LSF_REFERENCE_USE_PICTURE)) {
        rtcSetGeometryUserData(shape, mesh);
        rtcSetGeometryIntersectFilterFunction(shape, reject_cut_out);
        rtcSetGeometryOccludedFilterFunction(shape, reject_cut_out);
    }
    rtcCommitGeometry(shape);
    rtcAttachGeometryByID(geometry->tree, shape, index);
    rtcReleaseGeometry(shape);
    return true;
}

static bool fits_in_memory(const lsf_scene *scene, const lsf_state *state, lsf_error *error)
{
    double bytes = 0.0;
    for (uint32_t i = 0; i < state->instance_count; i++) {
        const lsf_primitive *primitive = &scene->primitives[state->instances[i].primitive];
        bytes += primitive->index_count / 3 * (double)TREE_BYTES_PER_TRIANGLE +
                 primitive->vertex_count * 12.0;
    }
    double memory = (double)sysconf(_SC_PHYS_PAGES) * (double)sysconf(_SC_PAGESIZE);
    if (bytes <= 0.75 * memory)
        return true;
    return lsf_error_set(error, LSF_ERROR_RENDER,
                         "the reference needs about %.1f GiB for this scene's triangles and the "
                         "machine has %.1f; use a scene with fewer instances",
                         bytes * 0x1p-30, memory * 0x1p-30);
}

bool lsf_reference_geometry_init(lsf_reference_geometry *geometry, const lsf_scene *scene,
                                 const lsf_state *state, lsf_reference_use use, lsf_error *error)
{
    memset(geometry, 0, sizeof *geometry);
    geometry->scene = scene;
    geometry->state = state;
    if (!fits_in_memory(scene, state, error))
        return false;
    /* One thread builds the tree: trees built by several may differ in the order of coplanar
     * triangles, and with it the bits of the picture. */
    geometry->device = rtcNewDevice("threads=1");
    geometry->tree = geometry->device ? rtcNewScene(geometry->device) : NULL;
    geometry->meshes = lsf_alloc(state->instance_count, sizeof *geometry->meshes);
    geometry->indices = lsf_alloc(scene->primitive_count, sizeof *geometry->indices);
    bool ok = geometry->tree != NULL && geometry->meshes != NULL && geometry->indices != NULL;
    if (ok) {
        /* Robust mode: no ray slips between two triangles that share an edge. */
        bool fast = use == LSF_REFERENCE_USE_SPEED;
        rtcSetSceneFlags(geometry->tree,
                         fast ? RTC_SCENE_FLAG_NONE
                              : RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION);
        rtcSetSceneBuildQuality(geometry->tree,
                                fast ? RTC_BUILD_QUALITY_HIGH : RTC_BUILD_QUALITY_MEDIUM);
    }
    for (uint32_t i = 0; ok && i < state->instance_count; i++)
        ok = add_instance(geometry, i, use);
    if (ok) {
        rtcCommitScene(geometry->tree);
        ok = rtcGetDeviceError(geometry->device) == RTC_ERROR_NONE;
    }
    if (!ok) {
        lsf_reference_geometry_finish(geometry);
        return lsf_error_set(error, LSF_ERROR_RENDER,
                             "the reference cannot build its ray tracing tree: out of memory");
    }
    return true;
}

void lsf_reference_geometry_finish(lsf_reference_geometry *geometry)
{
    if (geometry->tree != NULL)
        rtcReleaseScene(geometry->tree);
    if (geometry->device != NULL)
        rtcReleaseDevice(geometry->device);
    for (uint32_t i = 0; geometry->meshes != NULL && i < geometry->state->instance_count; i++)
        free(geometry->meshes[i].positions);
    for (uint32_t i = 0; geometry->indices != NULL && i < geometry->scene->primitive_count; i++)
        free(geometry->indices[i]);
    free(geometry->meshes);
    free(geometry->indices);
    memset(geometry, 0, sizeof *geometry);
}

static struct RTCRay make_ray(lsf_float3 origin, lsf_float3 direction, float near, float far)
{
    return (struct RTCRay){
        .org_x = origin.x,
        .org_y = origin.y,
        .org_z = origin.z,
        .tnear = near,
        .dir_x = direction.x,
        .dir_y = direction.y,
        .dir_z = direction.z,
        .tfar = far,
        .mask = ~0u,
    };
}

/* Embree's manual bounds the coordinates of rays by 1.844e18. The scene lies about the origin,
 * so that a ray from farther away hits nothing. */
static bool within_range(lsf_float3 v)
{
    return lsf_f3_max_abs(v) < 1e18f;
}

/* For rays between surfaces and lights. */
static void bound_direction(lsf_float3 *direction, float *far)
{
    if (within_range(*direction))
        return;
    *direction = lsf_f3_scale(*direction, 1.0f / lsf_f3_max_abs(*direction));
    *far = INFINITY;
}

static bool nearest(ray_context *context, struct RTCRay ray, lsf_reference_hit *hit)
{
    struct RTCRayHit query = {.ray = ray};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    rtcIntersect1(context->geometry->tree, &context->embree, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID)
        return false;
    *hit = (lsf_reference_hit){query.hit.geomID, query.hit.primID, query.hit.u, query.hit.v,
                               query.ray.tfar};
    return true;
}

bool lsf_reference_see(const lsf_reference_geometry *geometry, lsf_float3 origin,
                       lsf_float3 direction, float near, lsf_reference_chance chance,
                       lsf_reference_hit *hit)
{
    if (!within_range(origin) || !within_range(direction))
        return false;
    ray_context context = {.geometry = geometry, .chance = chance, .seen.distance = INFINITY};
    rtcInitIntersectContext(&context.embree);
    context.embree.filter = reject_unseen;
    return nearest(&context, make_ray(origin, direction, near, INFINITY), hit);
}

bool lsf_reference_trace(const lsf_reference_geometry *geometry, lsf_float3 origin,
                         lsf_float3 direction, float near, float far, lsf_reference_chance chance,
                         lsf_reference_hit *hit)
{
    bound_direction(&direction, &far);
    ray_context context = {.geometry = geometry, .chance = chance};
    rtcInitIntersectContext(&context.embree);
    return nearest(&context, make_ray(origin, direction, near, far), hit);
}

bool lsf_reference_occluded(const lsf_reference_geometry *geometry, lsf_float3 origin,
                            lsf_float3 direction, float far, lsf_reference_chance chance)
{
    bound_direction(&direction, &far);
    ray_context context = {.geometry = geometry, .chance = chance};
    rtcInitIntersectContext(&context.embree);
    struct RTCRay ray = make_ray(origin, direction, 0.0f, far);
    rtcOccluded1(geometry->tree, &context.embree, &ray);
    return ray.tfar < 0.0f;
}

void lsf_reference_corners(const lsf_reference_geometry *geometry, uint32_t instance,
                           uint32_t triangle, lsf_float3 corners[3])
{
    const lsf_reference_mesh *mesh = &geometry->meshes[instance];
    for (int i = 0; i < 3; i++)
        corners[i] =
            lsf_f3_load(mesh->positions + 3 * (uint64_t)mesh->indices[3 * (uint64_t)triangle + i]);
}

void lsf_reference_vertices(const lsf_reference_geometry *geometry, uint32_t instance,
                            uint32_t triangle, uint64_t vertices[3])
{
    const lsf_primitive *primitive =
        &geometry->scene->primitives[geometry->state->instances[instance].primitive];
    for (int i = 0; i < 3; i++)
        vertices[i] = geometry->scene->indices[primitive->first_index + 3 * (uint64_t)triangle + i];
}

float lsf_reference_ray_offset(const lsf_float3 corners[3])
{
    float largest = fmaxf(lsf_f3_max_abs(corners[0]),
                          fmaxf(lsf_f3_max_abs(corners[1]), lsf_f3_max_abs(corners[2])));
    return fmaxf(0x1p-20f * largest, 0x1p-100f); /* 8 to 16 units in the last place */
}
