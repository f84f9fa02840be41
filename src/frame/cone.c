#include "frame/cone.h"
#include "frame/purpose.h"

#include <math.h>

#include "math/sampling.h"
#include "shared/brdf.h"
#include "shared/cone.h"
#include "shared/scene_data.h"
#include "shared/voxel_draw_data.h"

const lsf_option_row lsf_cone_options[LSF_CONE_OPTION_COUNT] = {
    {"cone.count", LSF_OPTION_INT, offsetof(lsf_cone_params, count), 1, LSF_CONE_MAX, NULL, "",
     "diffuse cones per point; more cones are narrower"},
    {"cone.sides", LSF_OPTION_ENUM, offsetof(lsf_cone_params, sides), 0, 0, "isotropic|anisotropic",
     "", "anisotropic: voxels look different from six directions; isotropic: the same from all"},
    {"cone.offset", LSF_OPTION_FLOAT, offsetof(lsf_cone_params, offset), 0.0, 8.0, NULL, "voxels",
     "height above the surface at which cones that march start"},
    {"cone.step", LSF_OPTION_FLOAT, offsetof(lsf_cone_params, step), 0.1, 2.0, NULL, "texels",
     "length of a step of cones that march, in texels as wide as the cone"},
    {"cone.opacity", LSF_OPTION_FLOAT, offsetof(lsf_cone_params, opacity), 0.1, 16.0, NULL, "",
     "factor of the voxels' opacity for cones that march; above 1 thin walls leak less"},
    {"cone.distance", LSF_OPTION_FLOAT, offsetof(lsf_cone_params, distance), 0.0, 4.0, NULL,
     "half extents of the scene", "maximum length of cones"},
    {"cone.draws", LSF_OPTION_INT, offsetof(lsf_cone_params, draws), 0, LSF_CONE_MAX, NULL, "",
     "sealed cones: further rays per point, towards voxels drawn by their radiance"},
    {"cone.emitters", LSF_OPTION_INT, offsetof(lsf_cone_params, emitters), 0, 16, NULL, "points",
     "sealed cones: points sampled on emissive surfaces per point; 0: cones find these by chance"},
    {"cone.jitter", LSF_OPTION_BOOL, offsetof(lsf_cone_params, jitter), 0, 0, NULL, "",
     "varies the elevation of cones in each iteration, so that the mean covers all directions"},
    {"cone.sealed", LSF_OPTION_BOOL, offsetof(lsf_cone_params, sealed), 0, 0, NULL, "",
     "cones are rays that end at the first surface, so that walls do not leak; off: cones march, "
     "which is smoother and leaks"},
    {"cone.rotate", LSF_OPTION_BOOL, offsetof(lsf_cone_params, rotate), 0, 0, NULL, "",
     "gives each pixel its own directions of cones"},
};

uint32_t lsf_cone_levels(const lsf_cone_params *params)
{
    return params->sealed ? 1 : LSF_VOXEL_LEVELS;
}

bool lsf_cone_draws(const lsf_cone_params *params)
{
    return params->sealed && params->draws > 0;
}

bool lsf_cone_emitters(const lsf_cone_params *params, const lsf_plan *plan)
{
    return params->sealed && params->emitters > 0 && plan->requirements.emissive;
}

void lsf_cone_emission_switches(lsf_plan *plan, const lsf_cone_params *params)
{
    lsf_plan_switch_add(plan, "LSF_EMISSION", lsf_plan_surfaces_shine(plan),
                        "some material emits or is unlit");
    lsf_plan_switch_add(plan, "LSF_EMITTERS", lsf_cone_emitters(params, plan),
                        "some material emits, and cone.emitters is not 0");
}

uint32_t lsf_cone_slices(const lsf_cone_params *params)
{
    if (params->sides == LSF_CONE_ISOTROPIC)
        return 1;
    return params->sealed ? LSF_VOXEL_SIDES_SURFACE : LSF_VOXEL_SIDES_AXES;
}

/* The projected disc is cut into rings of equal area, one a cone, and each is turned from the one
 * before by the golden angle (Vogel 1979, "A Better Way to Construct the Sunflower Head"). Over all
 * elevations and turns directions are then distributed exactly by their cosine. A cone is a cap of
 * the mean solid angle, 2 pi / count: cos(half aperture) = 1 - 1 / count. */
void lsf_cone_set(uint32_t count, float elevation, lsf_vec4 *cones)
{
    const double golden_angle = (double)LSF_PI * (3.0 - sqrt(5.0));
    double cosine = 1.0 - 1.0 / (double)count;
    float spread = (float)(2.0 * sqrt(1.0 - cosine * cosine) / fmax(cosine, 0.5));
    for (uint32_t i = 0; i < count; i++) {
        double radius2 = (double)lsf_cone_radius2((float)i, elevation, (float)count);
        double radius = sqrt(radius2), angle = golden_angle * (double)i;
        cones[i] = (lsf_vec4){(float)(radius * cos(angle)), (float)(radius * sin(angle)),
                              (float)sqrt(1.0 - radius2), spread};
    }
}

/* Steps that the longest cone takes: it crosses the grid's diagonal in texels that are at least an
 * eighth of its length, or voxels. See texel sizes in lib/voxel_cone.glsl. */
static int32_t most_steps(const lsf_cone_params *params, const lsf_voxel_grid *grid)
{
    float diagonal = 0.0f;
    for (int axis = 0; axis < 3; axis++)
        diagonal += (float)grid->size[axis] * (float)grid->size[axis];
    return 2 + (int32_t)ceilf(sqrtf(diagonal) / params->step);
}

void lsf_cone_bind(const lsf_cone_params *params, const lsf_voxel_grid *grid,
                   const lsf_iteration *iteration, GLuint radiance, GLuint draws)
{
    if (!params->sealed) { /* marching cones interpolate; rays read a texel */
        glTextureParameteri(radiance, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
        glTextureParameteri(radiance, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    }
    lsf_bind_texture(LSF_UNIT_VOXEL_RADIANCE, radiance);
    lsf_vec4 cones[LSF_CONE_MAX];
    uint32_t index = iteration->index;
    float elevation = 0.5f;
    if (params->jitter)
        elevation = lsf_sobol_1d(index, lsf_iteration_seed(iteration, LSF_PURPOSE_CONE_ELEVATION));
    lsf_cone_set((uint32_t)params->count, 0.5f, cones);
    glUniform4fv(LSF_LOCATION_CONE_SET, params->count, &cones[0].x);
    glUniform4f(LSF_LOCATION_CONE_ROTATION,
                lsf_sobol_1d(index, lsf_iteration_seed(iteration, LSF_PURPOSE_CONE_ROTATION)),
                params->rotate, (float)params->count, elevation);
    glUniform4f(LSF_LOCATION_CONE, params->step, params->offset, params->distance / grid->side,
                params->opacity);
    glUniform1i(LSF_LOCATION_CONE_STEPS, most_steps(params, grid));
    if (draws) {
        glUniform1i(LSF_LOCATION_VOXEL_DRAW, params->draws);
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, LSF_BINDING_VOXEL_DRAWS, draws);
    }
}
