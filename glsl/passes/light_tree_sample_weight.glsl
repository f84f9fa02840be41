/* What the VPLs below a node may contribute to a point, by which the way down is chosen: nothing where they do not, an
 * estimate else. Visibility counts as given. Switches LSF_LIGHT_TREE_SITES, 0 where luminance alone decides, and those of
 * lib/brdf.glsl. */
#ifndef LSF_PASSES_LIGHT_TREE_SAMPLE_WEIGHT
#define LSF_PASSES_LIGHT_TREE_SAMPLE_WEIGHT

#include "lib/brdf.glsl"
#include "lib/light_tree.glsl"
#include "shared/light.h"

/* Nodes above a leaf are fewer than the bits of a code. */
#define WALK_DEPTH 64

layout(std430, binding = LSF_BINDING_LIGHT_TREE_AREAS) readonly buffer lsf_light_tree_area_block
{
    float discs2[]; /* by record */
};

/* x: squared distances below which 1/d^2 is held, to those discs: VPLs are no nearer than that. y: suppression's
 * m'/d [sr] at unit distance, to the same. */
layout(location = 0) uniform vec2 disc_scale;

float light_bound2(float disc2)
{
    return max(disc_scale.x * disc2, LSF_LIGHT_DISTANCE2_MIN);
}

/* As for brdf_evaluate, of a VPL that is seen under `geometry`, its cosine over the squared distance: the solid angle of its
 * disc, m' times. */
float light_kernel(float disc2, float geometry)
{
    return disc_scale.y * disc2 * geometry;
}

/* Where light arrives, and towards whom it is reflected. */
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

/* Of all directions into a box the largest cosine to the frame's z; 0 where the box is below (B. Walter et al. 2005,
 * "Lightcuts: A Scalable Approach to Illumination", section 4.1). `center` is where the box is from the point. */
float cosine_bound(mat3 frame, vec3 center, vec3 extent)
{
    vec3 c = center * frame;
    vec3 h = vec3(dot(abs(frame[0]), extent), dot(abs(frame[1]), extent), dot(abs(frame[2]), extent));
    float top = c.z + h.z;
    vec2 side = max(abs(c.xy) - h.xy, 0.0);
    return top > 0.0 ? top * inversesqrt(dot(side, side) + top * top) : 0.0;
}

#if LSF_SPECULAR
/* What the specular lobe reflects of light from within a ball that encloses the box: along the mirror image of the
 * view where that meets the ball, else along the direction next to it. Never 0, as directions above the surface may be
 * in the box even if this one is not. */
float specular_bound(light_receiver r, vec3 center, vec3 extent, float kernel)
{
    float distance2 = dot(center, center), radius2 = dot(extent, extent);
    vec3 direction = r.mirrored;
    if (radius2 < distance2) {
        vec3 towards = center * inversesqrt(distance2);
        float cosine = dot(towards, direction), reach = sqrt(1.0 - radius2 / distance2); /* cosine of the ball's own angle */
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

/* Root mean square of what is above 0 of a normal distribution, whose integral is taken as S. R. Bowling et al. 2009
 * approximate it, "A logistic approximation to the cumulative normal distribution". */
float height_above(float mean, float variance)
{
    if (mean * mean >= 36.0 * variance)
        return max(mean, 0.0);
    float x = mean * inversesqrt(variance);
    float density = exp(-0.5 * x * x) * inversesqrt(2.0 * LSF_PI);
    float above = 1.0 / (1.0 + exp(-x * (1.5976 + 0.07056 * x * x)));
    return sqrt(variance * max((x * x + 1.0) * above + x * density, 0.0));
}

/* What light comes to from a link to a receiver. */
struct light_way {
    float arrives, leaves, distance2; /* the cosines at both ends; the squared distance */
    float disc2;                      /* of each of its VPLs */
};

/* Of a VPL exact, of a node estimates; arrives is 0 where nothing in the box is above the surface. */
light_way light_way_to(light_receiver r, uint link, lsf_light_tree_node node, vec3 center, vec3 extent)
{
    light_way w;
    w.arrives = cosine_bound(r.frame, center, extent);
    vec3 way = node.position - r.position;
    mat3 frame = light_tree_frame(octahedral_decode(node.normal));
    w.distance2 = max(dot(way, way), LSF_LIGHT_DISTANCE2_MIN);
    if (light_is_leaf(link)) {
        w.leaves = max(-dot(frame[2], way) * inversesqrt(w.distance2), 0.0);
        w.disc2 = discs2[light_record(link)];
        w.distance2 = max(w.distance2, light_bound2(w.disc2));
        return w;
    }
    /* The mean squared distance: that to the box says nothing where a box is large or the point is in it. */
    w.distance2 += light_variance(node);
    /* Of a box that is partly above the surface most may be below: heights count as those of a normal distribution, yet
     * as a hundredth of the box's, or what is above could be missed. */
    float height = height_above(dot(r.s.normal, way), light_variance_along(node, r.s.normal, frame));
    w.arrives = clamp(height * inversesqrt(w.distance2), 0.01 * w.arrives, w.arrives);
    w.disc2 = light_disc2(node, frame);
    /* As far as normals are alike, a point sees the VPLs as they see it, all under one normal. */
    frame[2] = -frame[2];
    w.leaves = mix(1.0, cosine_bound(frame, center, extent), node.similarity);
    return w;
}

/* What is below a link may contribute, to the whole luminance `most`. */
float light_weight(light_receiver r, uint link, float most, bool specular)
{
    lsf_light_tree_node node = light_node(link);
    float weight = luminance(node.intensity) / most;
#if LSF_LIGHT_TREE_SITES
    vec3 center = 0.5 * (node.low + node.high) - r.position, extent = 0.5 * (node.high - node.low);
    light_way w = light_way_to(r, link, node, center, extent);
    float geometry = w.leaves / w.distance2;
    weight *= w.arrives * geometry;
#if LSF_SPECULAR
    if (specular && weight > 0.0)
        weight *= specular_bound(r, center, extent, light_kernel(w.disc2, geometry));
#endif
#endif
    return weight;
}

#endif
