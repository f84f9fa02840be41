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
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "scene/default_lamp.h"
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

static void note_why(lsf_scene *scene, float emitted)
{
    const char *added = scene->default_lamp.present
                            ? "a default sky and key light are added, and a lamp, for they do not "
                              "reach more than a quarter of what the first camera shows"
                            : "a default sky and key light are added";
    if (!scene->requirements.emissive)
        lsf_scene_add_note(scene,
                           "the file has no light and no environment was given: %s; "
                           "without default light it stays dark",
                           added);
    else if (emitted == 0.0f)
        lsf_scene_add_note(scene,
                           "the file has no light, and its emissive materials light less than half "
                           "of what its first camera shows: %s; without default light only these "
                           "materials light it",
                           added);
    else
        lsf_scene_add_note(
            scene,
            "the file has no light but emissive materials, which would give half of what its "
            "first camera shows, assumed to be white, a luminance of %.2g or less, below %g: %s; "
            "without default light only these materials light it",
            (double)emitted, (double)LSF_LIT_LUMINANCE_MIN, added);
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

/* Adds the light as `emitted` (lsf_emitted_light) and the camera's view ask for it. False without
 * memory. */
static bool add_light(lsf_scene *scene, lsf_default_light mode, const lsf_state *state,
                      const lsf_seen *seen, float emitted)
{
    bool lit = has_lamps(&scene->requirements) || emitted >= LSF_LIT_LUMINANCE_MIN;
    if (mode == LSF_DEFAULT_LIGHT_AUTO && lit) {
        lsf_log(LSF_LOG_INFO,
                "emissive materials light the scene: half of what its first camera shows, assumed "
                "to be white, would have a luminance of %.2g or more; no default light is added",
                (double)emitted);
        return true;
    }
    if (!scene->environment.present && !add_sky(&scene->environment))
        return false;
    add_key(&scene->key_light);
    if (!lit)
        scene->default_lamp =
            lsf_default_lamp_place(state, seen, (double)scene->key_light.irradiance);
    if (mode == LSF_DEFAULT_LIGHT_AUTO)
        note_why(scene, emitted);
    return lsf_scene_compute_requirements(scene);
}

/* Of the first camera, or, where that one cannot show the scene, of the last one, which frames it.
 */
static bool update_state(lsf_state *state, const lsf_scene *scene)
{
    char last[16];
    lsf_view_params params = {.fov_y = NAN, .aspect = 1.0f};
    lsf_error error;
    if (lsf_state_update(state, scene, &params, &error))
        return true;
    snprintf(last, sizeof last, "%u", scene->camera_count - 1);
    params.camera = last;
    return error.code == LSF_ERROR_USAGE && lsf_state_update(state, scene, &params, NULL);
}

bool lsf_default_light_add(lsf_scene *scene, lsf_default_light mode, lsf_error *error)
{
    bool lit = has_lamps(&scene->requirements) || scene->environment.present;
    if (mode == LSF_DEFAULT_LIGHT_NEVER || (mode == LSF_DEFAULT_LIGHT_AUTO && lit))
        return true;
    lsf_state state = {0};
    lsf_seen *seen = NULL;
    bool good = update_state(&state, scene) && (seen = lsf_seen_create(scene, &state)) != NULL;
    float emitted = good ? lsf_emitted_light(scene, &state, seen) : -1.0f;
    good = emitted >= 0.0f && add_light(scene, mode, &state, seen, emitted);
    lsf_seen_free(seen);
    lsf_state_finish(&state);
    return good ||
           lsf_error_set(error, LSF_ERROR_FILE, "%s: not enough memory for its light", scene->path);
}
