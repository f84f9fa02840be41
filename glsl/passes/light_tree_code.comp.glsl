/* Writes the code of each VPL. Switch LSF_SPECULAR. */
#include "passes/light_tree_codes.glsl"

layout(local_size_x = LSF_LIGHT_TREE_GROUP) in;

vec3 from_ordered(uvec3 bits)
{
    return uintBitsToFloat(bits ^ mix(uvec3(0xffffffffu), uvec3(0x80000000u), greaterThanEqual(bits, uvec3(0x80000000u))));
}

/* Inserts two zeros before each of ten bits. */
uvec3 spread_bits(uvec3 v)
{
    v = (v | (v << 16)) & 0x030000ffu;
    v = (v | (v << 8)) & 0x0300f00fu;
    v = (v | (v << 4)) & 0x030c30c3u;
    return (v | (v << 2)) & 0x09249249u;
}

/* Position within the cube on the longest side of the bounds, so that cells are cubes. */
uint position_code(vec3 position)
{
    vec3 low = from_ordered(uvec3(tree.low_x, tree.low_y, tree.low_z));
    vec3 extent = from_ordered(uvec3(tree.high_x, tree.high_y, tree.high_z)) - low;
    float side = max(extent.x, max(extent.y, extent.z));
    vec3 relative = side > 0.0 ? (position - low) / side : vec3(0.0);
    uvec3 bits = spread_bits(uvec3(clamp(relative * 1024.0, 0.0, 1023.0)));
    return (bits.x << 2) | (bits.y << 1) | bits.z;
}

/* The octant, then three subdivisions of the octant's triangle on the sphere: each picks one of the four triangles
 * that the midpoints of its sides form (G. Taubin, J. Rossignac 1998, "Geometric Compression Through Topological
 * Surgery"). */
uint normal_code(vec3 normal)
{
    vec3 n = abs(normal);
    uint code = (normal.x < 0.0 ? 4u : 0u) | (normal.y < 0.0 ? 2u : 0u) | (normal.z < 0.0 ? 1u : 0u);
    vec3 a = vec3(1.0, 0.0, 0.0), b = vec3(0.0, 1.0, 0.0), c = vec3(0.0, 0.0, 1.0);
    for (int level = 0; level < 3; level++) {
        vec3 ab = normalize(a + b), bc = normalize(b + c), ca = normalize(c + a);
        uint part = 3u;
        if (dot(n, cross(ab, ca)) > 0.0) {
            part = 0u;
            b = ab;
            c = ca;
        } else if (dot(n, cross(bc, ab)) > 0.0) {
            part = 1u;
            a = ab;
            c = bc;
        } else if (dot(n, cross(ca, bc)) > 0.0) {
            part = 2u;
            a = ca;
            b = bc;
        } else {
            a = bc;
            b = ca;
            c = ab;
        }
        code = (code << 2) | part;
    }
    return code;
}

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= record_count)
        return;
    lsf_vpl_record record = cloud[i];
    uvec2 code = uvec2(CODE_DEAD, i);
    if (!light_is_dead(record)) {
        uint normal = normal_code(octahedral_decode(record.normal));
        uint place = position_code(record.position);
#if LSF_SPECULAR
        place = (place >> 1) | (vpl_has_lobe(record) ? CODE_LOBE : 0u);
#endif
        code.x = (place << 1) | (normal >> 8);
        code.y |= normal << LSF_LIGHT_TREE_ID_BITS;
    }
    codes[i] = code;
}
