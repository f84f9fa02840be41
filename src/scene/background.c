#include "scene/background.h"

#include <string.h>

#include "scene/scene.h"

/* Middle grey where no sky was given: a white surface in full light has radiance 1, and the
 * reflectance that looks half as light is 18 % (CIE L* = 50). White objects and black ones stand
 * out from it alike. */
#define MIDDLE_GREY 0.18f

lsf_seen_background lsf_background_resolve(const lsf_scene *scene, const lsf_render_params *params)
{
    lsf_seen_background seen = {0};
    switch (params->background) {
    case LSF_BACKGROUND_AUTO:
        seen.environment = !scene->environment.by_default;
        for (int c = 0; !seen.environment && c < 3; c++)
            seen.radiance[c] = MIDDLE_GREY;
        break;
    case LSF_BACKGROUND_ENVIRONMENT:
        seen.environment = true;
        break;
    case LSF_BACKGROUND_UNIFORM:
        memcpy(seen.radiance, params->background_radiance, sizeof seen.radiance);
        break;
    case LSF_BACKGROUND_TRANSPARENT:
        seen.coverage = true;
        break;
    }
    return seen;
}
