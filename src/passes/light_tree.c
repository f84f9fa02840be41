#include "passes/light_tree.h"

#include <math.h>
#include <string.h>

#include "base/base.h"

/* Bits of a code that the sort looks at: all but the records' numbers, which are in order. */
#define FIRST_BIT LSF_LIGHT_TREE_ID_BITS
#define LAST_BIT 64

#define LOCATION_SHIFT 0    /* light_tree_sort.glsl */
#define LOCATION_LIMITS 0   /* light_tree_merge */
#define LOCATION_DISPATCH 2 /* the same */

/* A dispatch as GL reads it, and a number. */
#define DISPATCH_BYTES (4 * sizeof(uint32_t))

const lsf_option_row lsf_light_tree_options[LSF_LIGHT_TREE_OPTION_COUNT] = {
    {"light_tree.similarity", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_params, similarity), 0.0,
     1.0, NULL, "",
     "smallest product of the cosines between merged normals for which a node of the tree may "
     "represent the lights below it"},
    {"light_tree.spread", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_params, spread), 0.0, 1e6, NULL,
     "of the scene's longest side",
     "largest standard deviation of lights from the plane of their node for which the node may "
     "represent them"},
    {"light_tree.diagonal", LSF_OPTION_FLOAT, offsetof(lsf_light_tree_params, diagonal), 0.0, 1e6,
     NULL, "of the scene's longest side",
     "largest diagonal of a node's box for which the node may represent the lights below it; 0: "
     "any"},
    {"light_tree.covariance", LSF_OPTION_BOOL, offsetof(lsf_light_tree_params, covariance), 0, 0,
     NULL, "",
     "nodes store the covariance of positions along all directions instead of the variances along "
     "three axes"},
};

static const struct {
    const char *pass, *file;
} programs[LSF_LIGHT_TREE_PROGRAMS] = {
    [LSF_LIGHT_TREE_BOUNDS] = {"light_tree_sort", "passes/light_tree_bounds.comp.glsl"},
    [LSF_LIGHT_TREE_CODE] = {"light_tree_sort", "passes/light_tree_code.comp.glsl"},
    [LSF_LIGHT_TREE_COUNT] = {"light_tree_sort", "passes/light_tree_count.comp.glsl"},
    [LSF_LIGHT_TREE_SCAN] = {"light_tree_sort", "passes/light_tree_scan.comp.glsl"},
    [LSF_LIGHT_TREE_SCATTER] = {"light_tree_sort", "passes/light_tree_scatter.comp.glsl"},
    [LSF_LIGHT_TREE_LINK] = {"light_tree", "passes/light_tree_link.comp.glsl"},
    [LSF_LIGHT_TREE_MERGE] = {"light_tree", "passes/light_tree_merge.comp.glsl"},
    [LSF_LIGHT_TREE_AREA] = {"light_tree", "passes/light_tree_area.comp.glsl"},
};

static uint32_t tiles_of(uint32_t capacity)
{
    return (capacity + LSF_LIGHT_TREE_TILE - 1) / LSF_LIGHT_TREE_TILE;
}

static void switches(lsf_plan *plan, const lsf_light_tree_params *params)
{
    lsf_plan_switch_add(plan, "LSF_SPECULAR", plan->requirements.specular,
                        "materials have a specular lobe");
    lsf_plan_switch_add(plan, "LSF_LIGHT_TREE_COVARIANCE", params->covariance,
                        "light_tree.covariance");
}

void lsf_light_tree_plan(lsf_plan *plan, const lsf_light_tree_params *params, uint32_t capacity,
                         const char *cloud)
{
    uint64_t n = capacity;
    lsf_plan_pass_add(plan, "light_tree_sort", "%u virtual point lights by place and normal",
                      capacity);
    lsf_plan_reads(plan, cloud);
    switches(plan, params);
    lsf_plan_pass_add(plan, "light_tree", "a tree over virtual point lights");
    lsf_plan_reads(plan, cloud);
    switches(plan, params);
    lsf_plan_buffer_add(plan, "light_tree.tree", sizeof(struct lsf_light_tree_data),
                        "how many shine, and where");
    lsf_plan_buffer_add(plan, "light_tree.codes_0", n * 2 * sizeof(uint32_t),
                        "the order of the virtual point lights");
    lsf_plan_buffer_add(plan, "light_tree.codes_1", n * 2 * sizeof(uint32_t),
                        "the same from pass to pass of the sort");
    lsf_plan_buffer_add(plan, "light_tree.counts",
                        tiles_of(capacity) * LSF_LIGHT_TREE_DIGITS * sizeof(uint32_t),
                        "digits of each %d codes", LSF_LIGHT_TREE_TILE);
    lsf_plan_buffer_add(plan, "light_tree.nodes", n * sizeof(struct lsf_light_tree_node),
                        "inner nodes");
    lsf_plan_buffer_add(plan, "light_tree.areas", n * sizeof(float),
                        "what area each virtual point light stands for");
    lsf_plan_buffer_add(plan, "light_tree.parents", 3 * n * sizeof(uint32_t),
                        "the way up, and how many children are merged");
    lsf_plan_buffer_add(plan, "light_tree.dispatches",
                        LSF_LIGHT_TREE_DISPATCHES * DISPATCH_BYTES +
                            (n + 1) / 2 * 2 * sizeof(uint32_t),
                        "nodes that are merged together");
}

bool lsf_light_tree_create(lsf_light_tree *pass, lsf_context *context, const lsf_plan *plan,
                           const lsf_light_tree_params *params, uint32_t capacity, lsf_error *error)
{
    *pass = (lsf_light_tree){.context = context, .params = *params, .capacity = capacity};
    lsf_light_tree_buffers *out = &pass->outputs;
    if (!lsf_plan_create_buffer(plan, context, "light_tree.tree", NULL, 0, &out->tree, error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.codes_0", NULL, 0, &pass->codes[0],
                                error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.codes_1", NULL, 0, &pass->codes[1],
                                error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.counts", NULL, 0, &pass->counts,
                                error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.nodes", NULL, 0, &out->nodes, error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.areas", NULL, 0, &out->areas, error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.parents", NULL, 0, &pass->parents,
                                error) ||
        !lsf_plan_create_buffer(plan, context, "light_tree.dispatches", NULL, 0, &pass->dispatches,
                                error))
        return false;
    for (size_t i = 0; i < LSF_LIGHT_TREE_PROGRAMS; i++) {
        const char *const files[5] = {programs[i].file};
        pass->programs[i] = lsf_plan_program(plan, context, programs[i].pass, files, error);
        if (!pass->programs[i])
            return false;
    }
    pass->sort_timer = lsf_timer_create(context, "light_tree_sort", error);
    pass->timer = pass->sort_timer ? lsf_timer_create(context, "light_tree", error) : NULL;
    return pass->timer != NULL;
}

static void bind(GLuint binding, GLuint buffer)
{
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
}

/* Dispatches with the uniforms that the caller has set, and the number of records. (One driver
 * reports the length of some storage blocks' arrays as 0, so that shaders do not ask for it.) */
static void dispatch(const lsf_light_tree *pass, int program, uint32_t groups)
{
    glUseProgram(pass->programs[program]);
    glUniform1ui(LSF_LOCATION_LIGHT_TREE_RECORDS, pass->capacity);
    glDispatchCompute(groups, 1, 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

static uint32_t groups_of(uint32_t invocations)
{
    return (invocations + LSF_LIGHT_TREE_GROUP - 1) / LSF_LIGHT_TREE_GROUP;
}

/* Bounds of no VPL: their least is above their most. */
static void clear_tree(const lsf_light_tree *pass)
{
    const struct lsf_light_tree_data none = {
        .root = LSF_LIGHT_TREE_NONE, .low_x = UINT32_MAX, .low_y = UINT32_MAX, .low_z = UINT32_MAX};
    const uint32_t *words = (const uint32_t *)&none;
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT); /* shaders have written the last tree */
    for (size_t at = 0; at < sizeof none; at += 4 * sizeof *words)
        glClearNamedBufferSubData(pass->outputs.tree, GL_RGBA32UI, (GLintptr)at, 4 * sizeof *words,
                                  GL_RGBA_INTEGER, GL_UNSIGNED_INT, words + at / sizeof *words);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

static void set_shift(const lsf_light_tree *pass, int program, GLuint shift)
{
    glProgramUniform1ui(pass->programs[program], LOCATION_SHIFT, shift);
}

/* Returns the buffer that holds the codes in order. */
static GLuint sort(const lsf_light_tree *pass)
{
    uint32_t tiles = tiles_of(pass->capacity);
    int from = 0;
    bind(LSF_BINDING_LIGHT_TREE_COUNTS, pass->counts);
    for (GLuint shift = FIRST_BIT; shift < LAST_BIT; shift += LSF_LIGHT_TREE_DIGIT_BITS) {
        bind(LSF_BINDING_LIGHT_TREE_CODES, pass->codes[from]);
        bind(LSF_BINDING_LIGHT_TREE_CODES + 1, pass->codes[1 - from]);
        set_shift(pass, LSF_LIGHT_TREE_COUNT, shift);
        dispatch(pass, LSF_LIGHT_TREE_COUNT, tiles);
        dispatch(pass, LSF_LIGHT_TREE_SCAN, 1);
        set_shift(pass, LSF_LIGHT_TREE_SCATTER, shift);
        dispatch(pass, LSF_LIGHT_TREE_SCATTER, tiles);
        from = 1 - from;
    }
    return pass->codes[from];
}

static float longest_side(const lsf_state *state)
{
    float side = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        side = fmaxf(side, state->bounds_max[axis] - state->bounds_min[axis]);
    return side;
}

/* From the leaves up: in each dispatch all nodes whose children are done. */
static void merge(const lsf_light_tree *pass, float side)
{
    const lsf_light_tree_params *params = &pass->params;
    const GLuint no_groups[4] = {0, 1, 1, 0};
    glClearNamedBufferSubData(pass->dispatches, GL_RGBA32UI, 0,
                              LSF_LIGHT_TREE_DISPATCHES * DISPATCH_BYTES, GL_RGBA_INTEGER,
                              GL_UNSIGNED_INT, no_groups);
    bind(LSF_BINDING_LIGHT_TREE_DISPATCHES, pass->dispatches);
    glBindBuffer(GL_DISPATCH_INDIRECT_BUFFER, pass->dispatches);
    glUseProgram(pass->programs[LSF_LIGHT_TREE_MERGE]);
    glUniform1ui(LSF_LOCATION_LIGHT_TREE_RECORDS, pass->capacity);
    glUniform3f(LOCATION_LIMITS, params->similarity, params->spread * side,
                params->diagonal > 0.0f ? params->diagonal * side : INFINITY);
    for (GLuint i = 0; i < LSF_LIGHT_TREE_DISPATCHES; i++) {
        glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
        glUniform1ui(LOCATION_DISPATCH, i);
        if (i == 0)
            glDispatchCompute(groups_of(pass->capacity), 1, 1);
        else
            glDispatchComputeIndirect((GLintptr)(i * DISPATCH_BYTES));
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
}

void lsf_light_tree_run(lsf_light_tree *pass, const lsf_iteration *iteration, GLuint cloud)
{
    pass->outputs.cloud = cloud;
    lsf_timer_begin(pass->sort_timer);
    clear_tree(pass);
    lsf_light_tree_bind(&pass->outputs);
    bind(LSF_BINDING_LIGHT_TREE_CODES, pass->codes[0]);
    dispatch(pass, LSF_LIGHT_TREE_BOUNDS, tiles_of(pass->capacity));
    dispatch(pass, LSF_LIGHT_TREE_CODE, groups_of(pass->capacity));
    GLuint codes = sort(pass);
    lsf_timer_end(pass->sort_timer);

    lsf_timer_begin(pass->timer);
    lsf_light_tree_bind(&pass->outputs);
    bind(LSF_BINDING_LIGHT_TREE_CODES, codes);
    bind(LSF_BINDING_LIGHT_TREE_PARENTS, pass->parents);
    dispatch(pass, LSF_LIGHT_TREE_LINK, groups_of(pass->capacity));
    merge(pass, longest_side(iteration->state));
    dispatch(pass, LSF_LIGHT_TREE_AREA, groups_of(pass->capacity));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT); /* samples fetch it through buffer textures */
    lsf_timer_end(pass->timer);
}

void lsf_light_tree_destroy(lsf_light_tree *pass)
{
    if (!pass->context)
        return;
    lsf_light_tree_buffers *out = &pass->outputs;
    lsf_buffer_destroy(pass->context, &out->tree);
    lsf_buffer_destroy(pass->context, &out->nodes);
    lsf_buffer_destroy(pass->context, &out->areas);
    lsf_buffer_destroy(pass->context, &pass->codes[0]);
    lsf_buffer_destroy(pass->context, &pass->codes[1]);
    lsf_buffer_destroy(pass->context, &pass->counts);
    lsf_buffer_destroy(pass->context, &pass->parents);
    lsf_buffer_destroy(pass->context, &pass->dispatches);
    lsf_timer_destroy(pass->sort_timer);
    lsf_timer_destroy(pass->timer);
    memset(pass, 0, sizeof *pass);
}
