/* Estimate of the light that the VPLs below a node contribute to a point, by which the descent chooses: 0 only
 * where they contribute nothing. Visibility is ignored. Switches LSF_LIGHT_TREE_SITES, 0 where luminance alone
 * decides, and those of lib/brdf.glsl. */
#ifndef LSF_PASSES_LIGHT_TREE_SAMPLE_WEIGHT
#define LSF_PASSES_LIGHT_TREE_SAMPLE_WEIGHT

#define LIGHT_TREE_FETCH 1
#include "lib/brdf.glsl"
#include "lib/light_tree.glsl"
#include "shared/light.h"

/* Depth of the tree: no more than the bits of a code. */
#define WALK_DEPTH 64

layout(binding = LSF_UNIT_LIGHT_TREE_AREAS) uniform samplerBuffer area_fetch;

/* Squared radius of the disc that a VPL stands for. */
float light_record_disc2(uint record)
{
    return texelFetch(area_fetch, int(record)).r;
}

/* x: squared distance below which 1/d^2 is clamped, relative to the squared radius of those discs: no VPL is
 * closer than that. y: suppression's m'/d [sr] at unit distance, relative to the same. z: least alpha of the lobes of
 * VPLs. */
layout(location = 0) uniform vec3 disc_scale;

float light_bound2(float disc2)
{
    return max(disc_scale.x * disc2, LSF_LIGHT_DISTANCE2_MIN);
}

/* `kernel` of brdf_evaluate for a VPL seen under `geometry`, its cosine over the squared distance: m' times the
 * solid angle of its disc. */
float light_kernel(float disc2, float geometry)
{
    return disc_scale.y * disc2 * geometry;
}

/* The visible point, and the direction in which it reflects light. */
struct light_receiver {
    vec3 position, view;
    surface s;
    mat3 frame;    /* about the shading normal */
    vec3 mirrored; /* the view's mirror image */
};

light_receiver light_receiver_of(vec3 position, vec3 view, surface s)
{
    light_receiver r;
    r.position = position;
    r.view = view;
    r.s = s;
    r.frame = light_tree_frame(s.normal);
    r.mirrored = reflect(-lift_to_horizon(view, s.normal), s.normal);
    return r;
}

/* Upper bound of the cosine between the frame's z and directions into a box; 0 where the box is below (B. Walter
 * et al. 2005, "Lightcuts: A Scalable Approach to Illumination", section 4.1). `center`: of the box, relative to
 * the point. */
float cosine_bound(mat3 frame, vec3 center, vec3 extent)
{
    vec3 c = center * frame;
    vec3 h = vec3(dot(abs(frame[0]), extent), dot(abs(frame[1]), extent), dot(abs(frame[2]), extent));
    float top = c.z + h.z;
    vec2 side = max(abs(c.xy) - h.xy, 0.0);
    return top > 0.0 ? top * inversesqrt(dot(side, side) + top * top) : 0.0;
}

#if LSF_SPECULAR
/* Reflection of the specular lobe for light from within a ball that encloses the box: along the mirror image of
 * the view where that hits the ball, else along the closest direction to it. Never 0, because other directions
 * into the box may be above the surface even if this one is not. */
float specular_bound(light_receiver r, vec3 center, vec3 extent, float kernel)
{
    float distance2 = dot(center, center), radius2 = dot(extent, extent);
    vec3 direction = r.mirrored;
    if (radius2 < distance2) {
        vec3 towards = center * inversesqrt(distance2);
        float cosine = dot(towards, direction), reach = sqrt(1.0 - radius2 / distance2); /* of the ball's radius */
        vec3 across = direction - cosine * towards;
        float size = length(across);
        if (cosine < reach && size > 1e-6)
            direction = reach * towards + sqrt(radius2 / distance2) * (across / size);
        else if (cosine < reach)
            direction = towards;
    }
    direction = lift_to_horizon(direction, r.s.normal);
    return luminance(brdf_evaluate(r.s, r.view, direction, kernel).specular);
}
#endif

/* Root mean square of the positive part of a normal distribution, with the integral approximated as by S. R.
 * Bowling et al. 2009, "A logistic approximation to the cumulative normal distribution". */
float height_above(float mean, float variance)
{
    if (mean * mean >= 36.0 * variance)
        return max(mean, 0.0);
    float x = mean * inversesqrt(variance);
    float density = exp(-0.5 * x * x) * inversesqrt(2.0 * LSF_PI);
    float above = 1.0 / (1.0 + exp(-x * (1.5976 + 0.07056 * x * x)));
    return sqrt(variance * max((x * x + 1.0) * above + x * density, 0.0));
}

/* By what a VPL's light is more than that of a diffuse one, in a direction above its surface. Its lobe is spread over a
 * kernel, as for receivers, and no narrower than samples can find. */
float light_lobe(uint record, vec3 normal, vec3 direction, float kernel)
{
#if LSF_SPECULAR
    lsf_vpl_record vpl = light_record_at(record);
    if (vpl_has_lobe(vpl) && dot(normal, direction) > 0.0) {
        vpl_lobe lobe = vpl_lobe_unpack(vpl);
        float nv = dot(normal, lobe.from), alpha = lsf_alpha_from_roughness(lobe.roughness);
        alpha = max(max(alpha, disc_scale.z), kernel_alpha(kernel, 1.0, sqrt(mix(nv * nv, 1.0, alpha * alpha))));
        return vpl_lobe_towards(normal, lobe.from, direction, alpha);
    }
#endif
    return 1.0;
}

#if LSF_SPECULAR
/* The same of all below a node, with the cosine: half as if the lobes' axes and the places below it, seen from the point,
 * were one distribution of von Mises and Fisher (K. V. Mardia, P. E. Jupp 2000, "Directional Statistics"; its
 * concentration by A. Banerjee et al. 2005, equation 4.4), half as if they shone evenly over a hemisphere, for lobes have
 * long tails. */
float lobes_share(lsf_light_tree_node node, vec3 towards, float distance2, float kernel)
{
    float mean = node.similarity, alpha2 = max(kernel_alpha(kernel, 1.0, 1.0), disc_scale.z);
    alpha2 *= alpha2;
    float inverse = (1.0 - mean * mean) / max(mean * (3.0 - mean * mean), 1e-6);
    float kappa = 1.0 / clamp(max(inverse, 2.0 * alpha2) + light_variance(node) / distance2, 1e-6, 1e3);
    float cosine = dot(towards, octahedral_decode(node.normal)) * inversesqrt(max(dot(towards, towards), 1e-30));
    float density = kappa / (2.0 * LSF_PI * (1.0 - exp(-2.0 * kappa))) * exp(kappa * (cosine - 1.0));
    return 0.5 * (LSF_PI * density + 0.5);
}
#endif

/* What light comes to from a link to a receiver. */
struct light_geometry {
    float arrives, leaves, distance2; /* the cosines at both ends, that of the VPL times its lobe; the squared distance */
    float kernel;                     /* as light_kernel has it, of each of its VPLs */
};

/* Exact for a VPL, estimated for a node; `arrives` is 0 where nothing in the box is above the surface. */
light_geometry light_geometry_to(light_receiver r, uint link, lsf_light_tree_node node, vec3 center, vec3 extent)
{
    light_geometry w;
    w.arrives = cosine_bound(r.frame, center, extent);
    vec3 to_node = node.position - r.position;
    w.distance2 = max(dot(to_node, to_node), LSF_LIGHT_DISTANCE2_MIN);
    if (light_is_leaf(link)) {
        uint record = light_record(link);
        vec3 back = -to_node * inversesqrt(w.distance2), normal = octahedral_decode(light_record_at(record).normal);
        w.leaves = max(dot(normal, back), 0.0);
        float disc2 = light_record_disc2(record);
        w.distance2 = max(w.distance2, light_bound2(disc2));
        w.kernel = light_kernel(disc2, w.leaves / w.distance2);
        w.leaves *= light_lobe(record, normal, back, w.kernel);
        return w;
    }
    mat3 frame = light_tree_frame(octahedral_decode(node.normal));
    /* The mean squared distance is used: the distance to the box means nothing where the box is large or holds the
     * point. */
    w.distance2 += light_variance(node);
    /* Most of a box that is partly above the surface may be below it. Heights count as normally distributed, yet
     * at least as a hundredth of the box's bound, so that no part above is missed. */
    float height = height_above(dot(r.s.normal, to_node), light_variance_along(node, r.s.normal, frame));
    w.arrives = clamp(height * inversesqrt(w.distance2), 0.01 * w.arrives, w.arrives);
    float disc2 = light_disc2(node, frame);
#if LSF_SPECULAR
    if (node.usable == LSF_LIGHT_TREE_LOBES) {
        w.kernel = light_kernel(disc2, 1.0 / w.distance2);
        w.leaves = lobes_share(node, -to_node, w.distance2, w.kernel);
        return w;
    }
#endif
    /* The more similar the normals are, the more the VPLs count as one with a common normal. */
    frame[2] = -frame[2];
    w.leaves = mix(1.0, cosine_bound(frame, center, extent), node.similarity);
    w.kernel = light_kernel(disc2, w.leaves / w.distance2);
    return w;
}

/* Estimates of what all VPLs below a link contribute to the diffuse lobe (x) and, where `specular`, to the specular one
 * (y; else it is x again), relative to `most`: the luminance of a node that the link is below, or is. */
vec2 light_weights(light_receiver r, uint link, float most, bool specular)
{
    lsf_light_tree_node node = light_node(link);
    float weight = luminance(node.intensity) / most;
#if LSF_LIGHT_TREE_SITES
    vec3 center = 0.5 * (node.low + node.high) - r.position, extent = 0.5 * (node.high - node.low);
    light_geometry w = light_geometry_to(r, link, node, center, extent);
    float geometry = w.leaves / w.distance2;
    weight *= w.arrives * geometry;
#if LSF_SPECULAR
    if (specular && weight > 0.0)
        return weight * vec2(1.0, specular_bound(r, center, extent, w.kernel));
#endif
#endif
    return vec2(weight);
}

#endif
