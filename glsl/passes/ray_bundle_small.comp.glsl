/* Rasterises the small triangles of an instance, one per invocation, and lists the large ones for GL to draw. In
 * parallel projection all attributes of a triangle are affine over it, so that they are set up once. It covers the
 * same texels as GL: vertices are snapped to the same grid, and a sample on an edge belongs to the triangle whose
 * left or top edge it is. Switches of lib/material_surface.glsl and lib/ray_bundle.glsl. */
#include "lib/triangle_fetch.glsl"
#include "passes/ray_bundle_append.glsl"

layout(local_size_x = LSF_BUNDLE_SMALL_SIZE) in;

layout(location = 8) uniform float subpixels; /* subpixel positions per texel, along each axis */
layout(location = 27) uniform uint group_stride; /* coprime to the number of work groups */

layout(std430, binding = LSF_BINDING_BUNDLE_LARGE) coherent buffer lsf_large_block
{
    uint large[]; /* draws of five words each, one for each instance; then indices */
};

/* Texel coordinates and depth of a vertex after vertex shader and viewport. */
vec3 to_map(uint vertex)
{
    vec3 q = bundle_coordinates(triangle_position(vertex));
    vec2 ndc = (q.xy - bundle.window.xy) / bundle.window.zw;
    float half_side = 0.5 * float(bundle.side);
    return vec3(ndc * half_side + half_side, (q.z - bundle.range.x) / bundle.range.y);
}

void list_large(uvec3 corners)
{
    uint at = large[5u * range.z + 2u] + atomicAdd(large[5u * range.z], 3u);
    for (uint i = 0u; i < 3u; i++)
        large[at + i] = corners[i];
}

struct edge {
    int value, right, up; /* at the first sample; change from sample to sample */
};

/* Twice the area between the edge a b and the sample at `at`, times two and with a bit for the fill rule: above 0
 * inside. `at`, a and b in subpixels. */
edge edge_of(ivec2 a, ivec2 b, ivec2 at, int step)
{
    ivec2 d = b - a;
    bool owns = d.y < 0 || (d.y == 0 && d.x < 0); /* left, or top: y points up */
    edge e;
    e.value = d.x * (at.y - a.y) - d.y * (at.x - a.x) - (owns ? 0 : 1);
    e.right = -d.y * step;
    e.up = d.x * step;
    return e;
}

void main()
{
    /* Software GL gives each thread a run of work groups, and parts of a mesh may be all in view or all outside.
     * The stride mixes groups from all over the mesh. */
    uint group = gl_WorkGroupID.x * group_stride % gl_NumWorkGroups.x;
    uint triangle = group * uint(LSF_BUNDLE_SMALL_SIZE) + gl_LocalInvocationIndex;
    if (triangle >= range.y)
        return;
    uvec3 corners = triangle_corners(triangle);
    vec3 p0 = to_map(corners.x), p1 = to_map(corners.y), p2 = to_map(corners.z);
    vec2 low = min(p0.xy, min(p1.xy, p2.xy)), high = max(p0.xy, max(p1.xy, p2.xy));
    int margin = (int(bundle.side) - int(bundle.range.z)) / 2; /* texels that are not used */
    if (!(min(high.x, high.y) >= float(margin) &&
          max(low.x, low.y) <= float(int(bundle.side) - margin)))
        return;
    vec2 size = high - low + 1.0;
    if (size.x * size.y > float(LSF_BUNDLE_SMALL_TEXELS)) {
        list_large(corners);
        return;
    }
    int step = int(subpixels), middle = step / 2;
    ivec2 s0 = ivec2(round(p0.xy * subpixels)), s1 = ivec2(round(p1.xy * subpixels)),
          s2 = ivec2(round(p2.xy * subpixels));
    ivec2 d1 = s1 - s0, d2 = s2 - s0;
    int area = d1.x * d2.y - d1.y * d2.x;
    bool anticlockwise = area > 0;
    if (area == 0)
        return;
    ivec2 least = max((min(s0, min(s1, s2)) + middle - 1) / step, ivec2(margin));
    ivec2 most = min((max(s0, max(s1, s2)) - middle) / step, ivec2(int(bundle.side) - 1 - margin));
    ivec2 count = most - least + 1;
    int samples = count.x > 0 && count.y > 0 ? count.x * count.y : 0;
    ivec2 at = least * step + middle;
    edge e0 = edge_of(anticlockwise ? s1 : s2, anticlockwise ? s2 : s1, at, step);
    edge e1 = edge_of(anticlockwise ? s2 : s0, anticlockwise ? s0 : s2, at, step);
    edge e2 = edge_of(anticlockwise ? s0 : s1, anticlockwise ? s1 : s0, at, step);

    /* The plane, in normalised space. */
    vec3 to_space = vec3(bundle_texel_size(), bundle.range.y);
    vec3 n = cross((p1 - p0) * to_space, (p2 - p0) * to_space);
    vec2 slope = n.z == 0.0 ? vec2(0.0) : -n.xy / n.z;
    vec2 depth_change = slope * bundle_texel_size() / bundle.range.y;
    /* Barycentric coordinates of the second and third corner, and their change per texel. */
    vec2 f1 = p1.xy - p0.xy, f2 = p2.xy - p0.xy;
    float f_area = f1.x * f2.y - f1.y * f2.x;
    f_area = abs(f_area) > 1e-12 ? f_area : 1e-12;
    vec2 b1_change = vec2(f2.y, -f2.x) / f_area, b2_change = vec2(-f1.y, f1.x) / f_area;

    lsf_material_data material = triangle_material();
    vec3 n0 = texelFetch(normal_fetch, int(corners.x)).xyz;
    vec3 n1 = texelFetch(normal_fetch, int(corners.y)).xyz - n0;
    vec3 n2 = texelFetch(normal_fetch, int(corners.z)).xyz - n0;
    n0 = triangle_direction(normal_transform, n0);
    n1 = triangle_direction(normal_transform, n1);
    n2 = triangle_direction(normal_transform, n2);
    material_point point;
    point.front = anticlockwise != (range.w != 0u);
#if LSF_TEXTURED
    vec2 uv = texelFetch(uv0_fetch, int(corners.x)).xy;
    vec2 uv_1 = texelFetch(uv0_fetch, int(corners.y)).xy - uv;
    vec2 uv_2 = texelFetch(uv0_fetch, int(corners.z)).xy - uv;
    point.uv.uv0_dx = uv_1 * b1_change.x + uv_2 * b2_change.x;
    point.uv.uv0_dy = uv_1 * b1_change.y + uv_2 * b2_change.y;
#endif
#if LSF_SECOND_UV
    vec2 second = texelFetch(uv1_fetch, int(corners.x)).xy;
    vec2 second_1 = texelFetch(uv1_fetch, int(corners.y)).xy - second;
    vec2 second_2 = texelFetch(uv1_fetch, int(corners.z)).xy - second;
    point.uv.uv1_dx = second_1 * b1_change.x + second_2 * b2_change.x;
    point.uv.uv1_dy = second_1 * b1_change.y + second_2 * b2_change.y;
#endif
#if LSF_BLEND
    uint layer = layer_key(range.z, corners.z, point.front);
#endif
    uint sides = (material_emits(material, point.front) ? LSF_BUNDLE_EMITS_BACK : 0u) |
                 (material_emits(material, !point.front) ? LSF_BUNDLE_EMITS_AHEAD : 0u);

    int done = 0;
    uint appended = 0u;
    ivec2 cell = ivec2(0);
    for (int visited = 0; visited < LSF_BUNDLE_SMALL_TEXELS && done < samples; visited++) {
        /* Advances to the next sample inside, because the expensive part below should run in all lanes that have
         * one at once. */
        bool inside = false;
        ivec2 found = cell;
        for (int i = 0; i < LSF_BUNDLE_SMALL_TEXELS && !inside && done < samples; i++) {
            int v0 = e0.value + cell.x * e0.right + cell.y * e0.up;
            int v1 = e1.value + cell.x * e1.right + cell.y * e1.up;
            int v2 = e2.value + cell.x * e2.right + cell.y * e2.up;
            inside = min(v0, min(v1, v2)) >= 0;
            found = cell;
            cell.x++;
            if (cell.x == count.x)
                cell = ivec2(0, cell.y + 1);
            done++;
        }
        if (!inside)
            break;
        ivec2 texel = least + found;
        vec2 offset = vec2(texel) + 0.5 - p0.xy;
        float depth = p0.z + dot(depth_change, offset);
        float b1 = clamp(dot(b1_change, offset), 0.0, 1.0);
        float b2 = clamp(dot(b2_change, offset), 0.0, 1.0 - b1);
        point.normal = n0 + b1 * n1 + b2 * n2;
#if LSF_TEXTURED
        point.uv.uv0 = uv + b1 * uv_1 + b2 * uv_2;
#endif
#if LSF_SECOND_UV
        point.uv.uv1 = second + b1 * second_1 + b2 * second_2;
#elif LSF_TEXTURED
        point.uv.uv1 = point.uv.uv0;
        point.uv.uv1_dx = point.uv.uv0_dx;
        point.uv.uv1_dy = point.uv.uv0_dy;
#endif
#if LSF_TANGENT
        vec4 t = texelFetch(tangent_fetch, int(corners.x));
        vec3 t1 = texelFetch(tangent_fetch, int(corners.y)).xyz;
        vec3 t2 = texelFetch(tangent_fetch, int(corners.z)).xyz;
        point.tangent = vec4(triangle_direction(transform, (1.0 - b1 - b2) * t.xyz + b1 * t1 + b2 * t2),
                             range.w != 0u ? -t.w : t.w);
#endif
#if LSF_VERTEX_COLOR
        point.color = (1.0 - b1 - b2) * texelFetch(color_fetch, int(corners.x)) +
                      b1 * texelFetch(color_fetch, int(corners.y)) +
                      b2 * texelFetch(color_fetch, int(corners.z));
#endif
#if LSF_BLEND
        point.key = uvec3(layer, uvec2(texel));
#endif
        surface s;
        vec3 emission;
        if (!material_surface(material, point, s, emission))
            continue;
        append_surface(uint(bundle_texel(texel)), bundle_plane_pack(depth, slope), s, emission,
                       sides);
        appended++;
    }
    if (appended > 0u)
        atomicAdd(bundle_heads[LSF_BUNDLE_RASTERISED + (gl_WorkGroupID.x & 15u) * 16u], appended);
}
