/* Radiance of the sky from the direction d is a + b d.y, grey. What a plane of normal n receives
 * of it is the closed form pi (a + 2/3 b n.y): the cosine keeps the mean and two thirds of the
 * linear term (R. Ramamoorthi and P. Hanrahan, "On the Relationship between Radiance and
 * Irradiance", 2001, bands 0 and 1).
 *
 * A white surface that faces the key light has radiance 1, which is displayed as white; half of it
 * comes from the key light and half from the sky, a lighting ratio of 2 to 1. The zenith is four
 * times as bright as the nadir. */
#include "scene/default_light.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/emitted_light.h"

/* The number of rows makes the error of linear interpolation of the cosine 3e-4 at most; two
 * columns are enough, for nothing changes along a row. */
enum { SKY_WIDTH = 2, SKY_HEIGHT = 64 };

/* The default camera stands at an azimuth of 31 degrees to the right of +z; the key light comes
 * from 45 degrees to its left and 45 degrees above the horizon, as portraits are lit. */
static const double key_azimuth = -14.0 * M_PI / 180.0, key_elevation = 45.0 * M_PI / 180.0;

static const double zenith_to_nadir = 4.0, key_share = 0.5;

static bool has_lamps(const lsf_requirements *r)
{
    return r->point_lights || r->spot_lights || r->directional_lights;
}

/* See lsf_emitted_light; negative without memory. */
static float emitted_light(const lsf_scene *scene)
{
    lsf_state state = {0};
    lsf_view_params view = {.fov_y = NAN, .aspect = 1.0f};
    float light =
        lsf_state_update(&state, scene, &view, NULL) ? lsf_emitted_light(scene, &state) : -1.0f;
    lsf_state_finish(&state);
    return light;
}

static void note_why(lsf_scene *scene, float emitted)
{
    if (!scene->requirements.emissive)
        lsf_scene_add_note(scene, "the file has no light and no environment was given: a default "
                                  "sky and key light are added; "
                                  "without default light it stays dark");
    else if (emitted == 0.0f)
        lsf_scene_add_note(scene,
                           "the file has no light, and its emissive materials light less than half "
                           "of its surfaces: a default sky and key light are added; without "
                           "default light only these materials light it");
    else
        lsf_scene_add_note(
            scene,
            "the file has no light but emissive materials, which would give half of its "
            "surfaces, assumed to be white, a luminance of %.2g or less, below %g: a default "
            "sky and key light are added; without default light only these materials light it",
            (double)emitted, (double)LSF_LIT_LUMINANCE_MIN);
}

static bool add_sky(lsf_environment *sky)
{
    double mean = (1.0 - key_share) / (1.0 + 2.0 / 3.0 * (zenith_to_nadir - 1.0) /
                                                 (zenith_to_nadir + 1.0) * sin(key_elevation));
    double slope = mean * (zenith_to_nadir - 1.0) / (zenith_to_nadir + 1.0);
    sky->texels = lsf_alloc(SKY_WIDTH * SKY_HEIGHT, 3 * sizeof *sky->texels);
    if (!sky->texels)
        return false;
    for (int i = 0; i < 3 * SKY_WIDTH * SKY_HEIGHT; i++) {
        int row = i / (3 * SKY_WIDTH);
        sky->texels[i] = (float)(mean + slope * cos(M_PI * (row + 0.5) / SKY_HEIGHT));
    }
    sky->width = SKY_WIDTH;
    sky->height = SKY_HEIGHT;
    sky->present = sky->by_default = true;
    return true;
}

static void add_key(lsf_key_light *key)
{
    *key =
        (lsf_key_light){.present = true,
                        .irradiance = (float)(M_PI * key_share),
                        .direction = {-sin(key_azimuth) * cos(key_elevation), -sin(key_elevation),
                                      -cos(key_azimuth) * cos(key_elevation)}};
}

bool lsf_default_light_add(lsf_scene *scene, lsf_default_light mode, lsf_error *error)
{
    const lsf_requirements *r = &scene->requirements;
    bool lit = has_lamps(r) || scene->environment.present;
    if (mode == LSF_DEFAULT_LIGHT_NEVER || (mode == LSF_DEFAULT_LIGHT_AUTO && lit))
        return true;
    if (mode == LSF_DEFAULT_LIGHT_AUTO) {
        float emitted = r->emissive ? emitted_light(scene) : 0.0f;
        if (emitted < 0.0f)
            goto no_memory;
        if (emitted >= LSF_LIT_LUMINANCE_MIN) {
            lsf_log(LSF_LOG_INFO,
                    "emissive materials light the scene: half of its surfaces, assumed to be "
                    "white, would have a luminance of %.2g or more; no default light is added",
                    (double)emitted);
            return true;
        }
        note_why(scene, emitted);
    }
    if (!scene->environment.present && !add_sky(&scene->environment))
        goto no_memory;
    add_key(&scene->key_light);
    if (!lsf_scene_compute_requirements(scene))
        goto no_memory;
    return true;

no_memory:
    return lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for its light", scene->path);
}
