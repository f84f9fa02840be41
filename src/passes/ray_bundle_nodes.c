/* The arrays that hold a bundle's nodes: what the scene requires, how large, and how they grow. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/base.h"
#include "passes/ray_bundle_parts.h"
#include "shared/scene_data.h"

/* Slots that were too small get a quarter more than was needed, as needs differ from direction
 * to direction. */
#define GROWTH_MARGIN 4

#define SURFACE_BYTES 12

/* Texels along a side below which a map tells next to nothing. */
#define SMALLEST_SIDE 16

static const char *const array_names[LSF_RAY_BUNDLE_ARRAYS] = {
    "heads", "keys", "surfaces", "specular_params", "emission", "chain"};

static uint32_t row_texels(const lsf_ray_bundle_params *params)
{
    return (uint32_t)(params->resolution + 7) / 8 * 8;
}

uint64_t lsf_ray_bundle_texels(const lsf_ray_bundle_params *params)
{
    uint64_t row = row_texels(params);
    return row * row;
}

static uint32_t first_capacity(const lsf_ray_bundle_params *params)
{
    double capacity =
        ceil((double)params->resolution * params->resolution * (double)params->capacity);
    return (uint32_t)fmax(capacity, 1.0);
}

int32_t lsf_ray_bundle_slices(const lsf_ray_bundle_params *params)
{
    uint64_t capacity = first_capacity(params), nodes = LSF_STORAGE_BLOCK_BYTES / SURFACE_BYTES;
    uint64_t most =
        nodes > capacity ? (nodes - capacity) / lsf_ray_bundle_texels(params) / 4 * 4 : 0;
    uint64_t wanted = ((uint64_t)params->slices + 4) / 4 * 4;
    uint64_t own_nodes = most < wanted ? most : wanted;
    return params->slices > 0 && own_nodes > 0 ? (int32_t)own_nodes - 1 : 0;
}

/* The entries of a texel in slices, one of which is its counter's. */
static uint64_t own_nodes(const lsf_ray_bundle_params *params)
{
    return ((uint64_t)lsf_ray_bundle_slices(params) + 4) / 4 * 4;
}

void lsf_ray_bundle_set_sizes(const lsf_ray_bundle_params *params, struct lsf_bundle_data *data)
{
    data->side = (uint32_t)params->resolution;
    data->row = row_texels(params);
    data->sliced = (uint32_t)lsf_ray_bundle_slices(params);
    data->first_link = (uint32_t)(own_nodes(params) * lsf_ray_bundle_texels(params));
}

bool lsf_ray_bundle_has_wide_specular_params(const lsf_plan *plan)
{
    return lsf_plan_surfaces_differ(plan) && (plan->requirements.anisotropic || plan->straight);
}

/* Bytes of an array for `capacity` chained nodes; 0 when the scene does not need it. */
static uint64_t array_bytes(const lsf_plan *plan, const lsf_ray_bundle_params *params,
                            bool distances_only, int array, uint64_t capacity)
{
    uint64_t texels = lsf_ray_bundle_texels(params);
    uint64_t nodes = texels * own_nodes(params) + capacity;
    bool surface = array == LSF_RAY_BUNDLE_SURFACES || array == LSF_RAY_BUNDLE_SPECULAR_PARAMS ||
                   array == LSF_RAY_BUNDLE_EMISSION;
    if (surface && distances_only)
        return 0;
    switch (array) {
    case LSF_RAY_BUNDLE_HEADS:
        return 4 * (texels + LSF_BUNDLE_COUNTERS);
    case LSF_RAY_BUNDLE_KEYS:
        return 4 * (nodes - capacity);
    case LSF_RAY_BUNDLE_SURFACES:
        return SURFACE_BYTES * nodes;
    case LSF_RAY_BUNDLE_SPECULAR_PARAMS:
        return lsf_plan_surfaces_differ(plan)
                   ? (lsf_ray_bundle_has_wide_specular_params(plan) ? 8 : 4) * nodes
                   : 0;
    case LSF_RAY_BUNDLE_EMISSION:
        return lsf_plan_surfaces_shine(plan) ? 8 * nodes : 0;
    default:
        return 8 * capacity;
    }
}

static void array_name(char name[64], int array, uint32_t slot)
{
    snprintf(name, 64, "ray_bundle.%s_%u", array_names[array], slot);
}

void lsf_ray_bundle_nodes_plan(lsf_plan *plan, const lsf_ray_bundle_params *params,
                               const lsf_ray_bundle_use *use)
{
    static const char *const why[LSF_RAY_BUNDLE_ARRAYS] = {
        "counters, and a chain's head for each texel",
        "number of a texel's fragments; plane of a node, coarse, 4 bytes",
        "normal, base colour and the rest of the plane of a node, 12 bytes",
        "roughness, metallic and f0 of a node",
        "radiance of a node, 8 bytes",
        "keys and links of chained nodes, 8 bytes each"};
    for (uint32_t slot = 0; slot < use->slots; slot++)
        for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++) {
            char name[64];
            array_name(name, array, slot);
            uint64_t bytes =
                array_bytes(plan, params, use->distances_only, array, first_capacity(params));
            if (bytes)
                lsf_plan_buffer_add(plan, name, bytes, "%s", why[array]);
        }
    if (use->distances_only)
        lsf_plan_omit(plan, "ray_bundle.surfaces", "distances are all that is asked for");
    if (!lsf_plan_surfaces_differ(plan))
        lsf_plan_omit(plan, "ray_bundle.specular_params", "nothing is glossy");
    if (!lsf_plan_surfaces_shine(plan))
        lsf_plan_omit(plan, "ray_bundle.emission", "nothing emits");
}

static uint64_t block_size(void)
{
    GLint64 bytes = 0;
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &bytes);
    return (uint64_t)bytes;
}

/* The number of chained nodes that storage blocks can hold. */
static uint32_t largest_capacity(const lsf_ray_bundle *pass, const lsf_plan *plan)
{
    uint64_t most = UINT32_MAX - 1, block = block_size();
    for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++) {
        uint64_t none = array_bytes(plan, &pass->params, pass->use.distances_only, array, 0);
        uint64_t node = array_bytes(plan, &pass->params, pass->use.distances_only, array, 1) - none;
        uint64_t capacity = block > none && node > 0 ? (block - none) / node : 0;
        if (node > 0 && capacity < most)
            most = capacity;
    }
    return (uint32_t)most;
}

static bool check_size(const char *name, uint64_t bytes, const lsf_ray_bundle_params *params,
                       lsf_error *error)
{
    uint64_t most = block_size();
    if (bytes <= most)
        return true;
    return lsf_error_set(error, LSF_ERROR_RENDER,
                         "%s takes %.0f MiB and this device reads %.0f at once; lower "
                         "bundle.resolution (%d) or bundle.slices (%d)",
                         name, (double)bytes / 1048576.0, (double)most / 1048576.0,
                         params->resolution, params->slices);
}

/* Where there was no room, searches follow links that were written for an earlier bundle or never:
 * they are always of nodes that exist. */
static void clear_chain(const lsf_ray_bundle_slot *slot)
{
    static const GLuint zero = 0;
    glClearNamedBufferData(slot->arrays[LSF_RAY_BUNDLE_CHAIN], GL_R32UI, GL_RED_INTEGER,
                           GL_UNSIGNED_INT, &zero);
}

static void attach_textures(lsf_ray_bundle_slot *slot)
{
    glTextureBuffer(slot->head_fetch, GL_R32UI, slot->arrays[LSF_RAY_BUNDLE_HEADS]);
    glTextureBuffer(slot->key_fetch, GL_RGBA32UI, slot->arrays[LSF_RAY_BUNDLE_KEYS]);
    glTextureBuffer(slot->chain_fetch, GL_RG32UI, slot->arrays[LSF_RAY_BUNDLE_CHAIN]);
}

bool lsf_ray_bundle_nodes_create(lsf_ray_bundle *pass, const lsf_plan *plan, lsf_error *error)
{
    static const GLuint zero = 0;
    pass->slots = lsf_alloc(pass->use.slots, sizeof *pass->slots);
    if (!pass->slots)
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u ray-bundles",
                             pass->use.slots);
    pass->capacity = first_capacity(&pass->params);
    for (uint32_t i = 0; i < pass->use.slots; i++) {
        lsf_ray_bundle_slot *slot = &pass->slots[i];
        slot->index = i;
        for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++) {
            char name[64];
            array_name(name, array, i);
            uint64_t bytes =
                array_bytes(plan, &pass->params, pass->use.distances_only, array, pass->capacity);
            if (!check_size(name, bytes, &pass->params, error) ||
                !lsf_plan_create_buffer_if_planned(plan, pass->context, name, NULL, 0,
                                                   &slot->arrays[array], error))
                return false;
        }
        if (!lsf_buffer_textures_create(pass->context, 1, &slot->head_fetch, error) ||
            !lsf_buffer_textures_create(pass->context, 1, &slot->key_fetch, error) ||
            !lsf_buffer_textures_create(pass->context, 1, &slot->chain_fetch, error))
            return false;
        glClearNamedBufferData(slot->arrays[LSF_RAY_BUNDLE_HEADS], GL_R32UI, GL_RED_INTEGER,
                               GL_UNSIGNED_INT, &zero);
        clear_chain(slot);
        attach_textures(slot);
    }
    return true;
}

static void destroy_slot(lsf_context *context, lsf_ray_bundle_slot *slot)
{
    for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++)
        lsf_buffer_destroy(context, &slot->arrays[array]);
    glDeleteTextures(1, &slot->head_fetch);
    glDeleteTextures(1, &slot->key_fetch);
    glDeleteTextures(1, &slot->chain_fetch);
}

static bool grow_slot(lsf_ray_bundle *pass, lsf_plan *plan, lsf_ray_bundle_slot *slot,
                      uint32_t capacity, lsf_error *error)
{
    for (int array = 0; array < LSF_RAY_BUNDLE_ARRAYS; array++) {
        char name[64];
        array_name(name, array, slot->index);
        uint64_t bytes =
            array_bytes(plan, &pass->params, pass->use.distances_only, array, capacity);
        if (bytes !=
                array_bytes(plan, &pass->params, pass->use.distances_only, array, pass->capacity) &&
            (!check_size(name, bytes, &pass->params, error) ||
             !lsf_plan_resize_buffer(plan, pass->context, name, bytes, 0, &slot->arrays[array],
                                     error)))
            return false;
    }
    clear_chain(slot);
    attach_textures(slot);
    return true;
}

/* So many texels are put out of use, on all sides alike, that the others need no more than `most`
 * chained nodes, and an eighth less: directions differ. */
static void use_fewer_texels(lsf_ray_bundle *pass, uint32_t needed, uint32_t most)
{
    uint32_t before = pass->side;
    double share = sqrt(0.875 * (double)most / (double)needed);
    double unused = fmin(ceil(0.5 * (1.0 - share) * before), (before - SMALLEST_SIDE) / 2);
    pass->side -= 2 * (uint32_t)unused;
    lsf_log(
        LSF_LOG_WARNING,
        "a ray-bundle of %u x %u texels hits %u surfaces and more, in addition to those in slices, "
        "and this device has memory for %u: from now on %u x %u texels are used",
        before, before, needed, most, pass->side, pass->side);
}

bool lsf_ray_bundle_nodes_grow(lsf_ray_bundle *pass, lsf_plan *plan, uint32_t needed,
                               lsf_error *error)
{
    uint32_t most = largest_capacity(pass, plan);
    uint64_t capacity = (uint64_t)needed + needed / GROWTH_MARGIN;
    bool fits = needed <= most || pass->side >= SMALLEST_SIDE + 2;
    if (fits && capacity > most)
        capacity = most;
    if (fits && needed > most)
        use_fewer_texels(pass, needed, most);
    capacity = capacity > UINT32_MAX ? UINT32_MAX : capacity;
    for (uint32_t i = 0; i < pass->use.slots; i++)
        if (!grow_slot(pass, plan, &pass->slots[i], (uint32_t)capacity, error))
            return false;
    pass->capacity = (uint32_t)capacity;
    return true;
}

void lsf_ray_bundle_nodes_bind_textures(const lsf_ray_bundle_slot *slot)
{
    lsf_bind_texture(3, slot->head_fetch);
    lsf_bind_texture(4, slot->key_fetch);
    lsf_bind_texture(5, slot->chain_fetch);
}

void lsf_ray_bundle_nodes_destroy(lsf_ray_bundle *pass)
{
    for (uint32_t i = 0; pass->slots && i < pass->use.slots; i++)
        destroy_slot(pass->context, &pass->slots[i]);
    free(pass->slots);
}
