/* Unit vectors in 32 bits: octahedral map, 16 bits an axis, error below 6.5e-5 rad.
 * Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors". */
#ifndef LSF_LIB_OCTAHEDRAL
#define LSF_LIB_OCTAHEDRAL

vec2 octahedral_sign(vec2 v)
{
    return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 octahedral_position(vec3 n)
{
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    if (n.z < 0.0)
        p = (1.0 - abs(p.yx)) * octahedral_sign(p);
    return p;
}

uint octahedral_encode(vec3 n)
{
    return packSnorm2x16(octahedral_position(n));
}

vec3 octahedral_normal(vec2 p)
{
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0)
        n.xy = (1.0 - abs(n.yx)) * octahedral_sign(n.xy);
    return normalize(n);
}

vec3 octahedral_decode(uint bits)
{
    return octahedral_normal(unpackSnorm2x16(bits));
}

/* A tangent frame about n without a branch. Duff et al. 2017, "Building an Orthonormal Basis,
 * Revisited". */
void orthonormal_basis(vec3 n, out vec3 t, out vec3 b)
{
    float s = n.z >= 0.0 ? 1.0 : -1.0;
    float a = -1.0 / (s + n.z);
    float c = n.x * n.y * a;
    t = vec3(1.0 + s * n.x * n.x * a, s * c, -s * n.x);
    b = vec3(c, s + n.y * n.y * a, -n.y);
}

#endif
