/* The random descent through the tree, and a point for the node at which it ends. Switch
 * LSF_LIGHT_TREE_SUBSTITUTE. */
#ifndef LSF_PASSES_LIGHT_TREE_SAMPLE_WALK
#define LSF_PASSES_LIGHT_TREE_SAMPLE_WALK

#include "lib/path_random.glsl"
#include "passes/light_tree_sample_weight.glsl"

/* Number of binary choices that are made with one random number of 24 bits, on average, before too few bits are
 * left. */
#define WALK_SHARED 8

/* Largest ratio of the variance of positions to the squared distance for nodes that stand for all VPLs below them. */
layout(location = 2) uniform float spread_bound;

struct light_walk_end {
    uint link;         /* LSF_LIGHT_TREE_NONE: the descent ended in a dead branch, or there is no tree */
    float probability; /* probability of reaching it */
    uint steps;
};

/* Descends from a link that was reached with this probability. `u`: one number, 0 <= u < 1; further ones are
 * hashed from `key` and `index`. */
light_walk_end light_walk(light_receiver r, bool specular, uint link, float probability, float u, path_random_key key,
                          uint index)
{
    light_walk_end end = light_walk_end(link, probability, 0u);
    int lobe = specular ? 1 : 0;
    for (; end.steps < WALK_DEPTH && end.link != LSF_LIGHT_TREE_NONE && !light_is_leaf(end.link); end.steps++) {
        lsf_light_tree_node node = light_inner_node(end.link);
#if LSF_LIGHT_TREE_SUBSTITUTE
        vec3 to_node = node.position - r.position;
        if (!specular && node.usable == LSF_LIGHT_TREE_USABLE && light_variance(node) <= spread_bound * dot(to_node, to_node))
            break;
#endif
        float most = luminance(node.intensity);
        float left = light_weights(r, node.left, most, specular)[lobe];
        float right = light_weights(r, node.right, most, specular)[lobe];
        if (!(left + right > 0.0)) {
            end.link = LSF_LIGHT_TREE_NONE;
            break;
        }
        if (end.steps >= WALK_SHARED)
            u = hash_unit(hash(uvec3(key.pixel, index ^ (end.steps << 24), key.seed))).x;
        float share = left / (left + right);
        bool to_left = u < share;
        u = min(to_left ? u / share : (u - share) / (1.0 - share), 1.0 - 1.0 / 16777216.0);
        end.link = to_left ? node.left : node.right;
        end.probability *= to_left ? share : 1.0 - share;
    }
    return end;
}

/* A point that emits the light of all VPLs below a node. */
struct light_point {
    vec3 position, normal, intensity;
    float disc2; /* of a VPL there */
    uint record; /* of the VPL that it is, LSF_LIGHT_TREE_NONE of a node's point */
};

/* Three normally distributed numbers (G. E. P. Box, M. E. Muller 1958). */
vec3 normal_numbers(vec4 u)
{
    vec2 radius = sqrt(-2.0 * log(1.0 - u.xz)), angle = 2.0 * LSF_PI * u.yw;
    return vec3(radius.x * vec2(cos(angle.x), sin(angle.x)), radius.y * cos(angle.y));
}

/* Scales numbers of a standard normal distribution to the node's distribution. */
vec3 light_spread(lsf_light_tree_node node, mat3 frame, vec3 g)
{
#if LSF_LIGHT_TREE_COVARIANCE
    /* Cholesky factor of the covariance; rounding may make the pivots of a flat one negative. */
    vec3 v = node.variance, c = node.covariance;
    float xx = sqrt(max(v.x, 0.0)), inverse_x = xx > 0.0 ? 1.0 / xx : 0.0;
    float yx = c.x * inverse_x, zx = c.y * inverse_x;
    float yy = sqrt(max(v.y - yx * yx, 0.0)), inverse_y = yy > 1e-4 * xx ? 1.0 / yy : 0.0;
    float zy = (c.z - yx * zx) * inverse_y;
    return vec3(xx * g.x, yx * g.x + yy * g.y, zx * g.x + zy * g.y + sqrt(max(v.z - zx * zx - zy * zy, 0.0)) * g.z);
#else
    return frame * (sqrt(node.variance) * g);
#endif
}

/* A leaf has no extent. */
light_point light_point_at(uint link, vec4 u)
{
    lsf_light_tree_node node = light_node(link);
    light_point p = light_point(node.position, octahedral_decode(node.normal), node.intensity, 0.0, LSF_LIGHT_TREE_NONE);
    if (light_is_leaf(link)) {
        p.record = light_record(link);
        p.normal = octahedral_decode(light_record_at(p.record).normal);
        p.disc2 = light_record_disc2(p.record);
        return p;
    }
    mat3 frame = light_tree_frame(p.normal);
    p.position = clamp(node.position + light_spread(node, frame, normal_numbers(u)), node.low, node.high);
    p.disc2 = light_disc2(node, frame);
    return p;
}

#endif
