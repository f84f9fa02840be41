/* Coordinates along a bundle's axes, from which the empty gaps between distant parts of the scene have been
 * removed. Switch LSF_BUNDLE_GAPS: there are gaps. shared/bundle_data.h has the formula. */
#ifndef LSF_LIB_BUNDLE_MAP
#define LSF_LIB_BUNDLE_MAP

#include "shared/bundle_data.h"
#include "shared/scene_data.h"

#if LSF_BUNDLE_GAPS
float bundle_closed(float q, vec4 starts, vec4 lengths)
{
    return q - dot(clamp(vec4(q) - starts, vec4(0.0), lengths), vec4(1.0));
}

/* Length of the gaps that were removed before a closed coordinate. */
float bundle_left_out(float closed, vec4 starts, vec4 lengths)
{
    float before = 0.0;
    for (int i = 0; i < 4; i++)
        before += closed + before > starts[i] ? lengths[i] : 0.0;
    return before;
}

vec3 bundle_close(lsf_bundle_data b, vec3 q)
{
    return vec3(bundle_closed(q.x, b.gap_starts[0], b.gap_lengths[0]),
                bundle_closed(q.y, b.gap_starts[1], b.gap_lengths[1]),
                bundle_closed(q.z, b.gap_starts[2], b.gap_lengths[2]));
}
#endif

vec3 bundle_map_coordinates(lsf_bundle_data b, vec3 p)
{
    vec3 q = vec3(dot(b.right.xyz, p), dot(b.up.xyz, p), dot(b.forward.xyz, p));
#if LSF_BUNDLE_GAPS
    q = bundle_close(b, q);
#endif
    return q;
}

#endif
