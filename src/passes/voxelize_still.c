/* The part of the grid that stands still is voxelised once and copied; what moves is added to it.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "passes/voxelize_parts.h"

static const char prefix[] = "voxelize.";

static void still_name(char name[64], const char *of)
{
    snprintf(name, 64, "voxelize.still_%s", of + sizeof prefix - 1);
}

bool lsf_voxelize_always_anew(const lsf_plan *plan, bool jitter)
{
    return jitter || plan->requirements.blended || plan->voxel_chance;
}

bool lsf_voxelize_keeps_still(const lsf_plan *plan, bool jitter)
{
    return plan->requirements.moving && !lsf_voxelize_always_anew(plan, jitter);
}

void lsf_voxelize_still_plan(lsf_plan *plan, const lsf_voxel_grid *grid)
{
    lsf_voxelize none = {0};
    lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES];
    char name[64];
    if (!lsf_voxelize_keeps_still(plan, grid->jitter)) {
        lsf_plan_omit(plan, "voxelize.still", "%s",
                      grid->jitter ? "the grid moves every iteration"
                      : lsf_voxelize_always_anew(plan, false)
                          ? "surfaces that are there by chance change"
                          : "nothing moves");
        return;
    }
    lsf_voxelize_textures(&none, textures);
    for (int i = 0; i < LSF_VOXELIZE_TEXTURES; i++) {
        const lsf_plan_resource *resource = lsf_plan_find(plan, textures[i].name);
        if (!resource)
            continue;
        lsf_texture_desc desc = resource->texture; /* the list may move when it grows */
        still_name(name, textures[i].name);
        lsf_plan_texture_desc_add(plan, name, &desc, "voxels of what stands still");
    }
    lsf_plan_buffer_add(plan, "voxelize.still_bricks",
                        lsf_plan_find(plan, "voxelize.bricks")->bytes,
                        "bricks of what stands still");
}

/* --- which instances move --- */

static bool find_moving(lsf_voxelize_still *still, const lsf_scene *scene)
{
    still->scene = scene;
    still->instance_count = scene->instance_count;
    still->moves = lsf_alloc(scene->instance_count, sizeof *still->moves);
    still->transforms = lsf_alloc(scene->instance_count, sizeof *still->transforms);
    still->values = lsf_alloc(lsf_pose_value_count(scene), sizeof *still->values);
    still->drawn = lsf_alloc(scene->instance_count, sizeof *still->drawn);
    return still->moves && still->transforms && still->values && still->drawn &&
           lsf_scene_moving_instances(scene, still->moves);
}

bool lsf_voxelize_still_create(lsf_voxelize *pass, const lsf_plan *plan, const lsf_scene *scene,
                               lsf_error *error)
{
    lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES];
    char name[64];
    if (!lsf_plan_find(plan, "voxelize.still_bricks"))
        return true;
    if (!find_moving(&pass->still, scene))
        return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory for %u instances",
                             scene->instance_count);
    lsf_voxelize_textures(pass, textures);
    for (int i = 0; i < LSF_VOXELIZE_TEXTURES; i++) {
        still_name(name, textures[i].name);
        if (!lsf_plan_create_texture_if_planned(plan, pass->context, name, &pass->still.textures[i],
                                                error))
            return false;
    }
    return lsf_plan_create_buffer(plan, pass->context, "voxelize.still_bricks", NULL, 0,
                                  &pass->still.bricks, error);
}

bool lsf_voxelize_still_moved(lsf_voxelize *pass, const lsf_state *state)
{
    lsf_voxelize_still *still = &pass->still;
    bool moved = false;
    for (uint32_t i = 0; still->moves && i < still->instance_count; i++) {
        const float *now = state->instances[i].transform;
        moved = moved || memcmp(still->transforms[i], now, sizeof still->transforms[i]) != 0;
        memcpy(still->transforms[i], now, sizeof still->transforms[i]);
        moved = moved || still->drawn[i] == state->instances[i].skipped;
        still->drawn[i] = !state->instances[i].skipped;
    }
    const float *values = state->pose.values;
    if (still->moves && values) {
        size_t bytes = lsf_pose_value_count(still->scene) * sizeof *values;
        moved = moved || memcmp(still->values, values, bytes) != 0;
        memcpy(still->values, values, bytes);
    }
    return moved;
}

/* --- copies --- */

static void copy_texture(GLuint from, GLuint to)
{
    GLint width, height, depth;
    glGetTextureLevelParameteriv(from, 0, GL_TEXTURE_WIDTH, &width);
    glGetTextureLevelParameteriv(from, 0, GL_TEXTURE_HEIGHT, &height);
    glGetTextureLevelParameteriv(from, 0, GL_TEXTURE_DEPTH, &depth);
    glCopyImageSubData(from, GL_TEXTURE_3D, 0, 0, 0, 0, to, GL_TEXTURE_3D, 0, 0, 0, 0, width,
                       height, depth);
}

static void copy_bricks(GLuint from, GLuint to)
{
    GLint64 bytes;
    glGetNamedBufferParameteri64v(from, GL_BUFFER_SIZE, &bytes);
    glCopyNamedBufferSubData(from, to, 0, 0, bytes);
}

void lsf_voxelize_still_keep(lsf_voxelize *pass)
{
    lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES];
    lsf_voxelize_textures(pass, textures);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int i = 0; i < LSF_VOXELIZE_TEXTURES; i++)
        if (pass->still.textures[i])
            copy_texture(*textures[i].texture, pass->still.textures[i]);
    copy_bricks(pass->outputs.bricks, pass->still.bricks);
}

void lsf_voxelize_still_restore(lsf_voxelize *pass)
{
    lsf_voxelize_texture textures[LSF_VOXELIZE_TEXTURES];
    lsf_voxelize_textures(pass, textures);
    glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    for (int i = 0; i < LSF_VOXELIZE_TEXTURES; i++)
        if (pass->still.textures[i])
            copy_texture(pass->still.textures[i], *textures[i].texture);
    copy_bricks(pass->still.bricks, pass->outputs.bricks);
}

void lsf_voxelize_still_destroy(lsf_voxelize *pass)
{
    lsf_voxelize_still *still = &pass->still;
    for (int i = 0; i < LSF_VOXELIZE_TEXTURES; i++)
        lsf_texture_destroy(pass->context, &still->textures[i]);
    lsf_buffer_destroy(pass->context, &still->bricks);
    free(still->moves);
    free(still->transforms);
    free(still->drawn);
    free(still->values);
}
