/* A plane in 32 bits: depth in 16 bits, then twice 8 bits of slopes, rise over run along a map's axes. A slope s
 * is stored as c = s / (1 + |s|), which divides its angle about evenly: within 0.45 degrees, up to 89.5. */
#ifndef LSF_LIB_PLANE_KEY
#define LSF_LIB_PLANE_KEY

#define PLANE_KEY_SLOPE_STEPS 128.0

uint plane_key_slopes(vec2 slope)
{
    slope = clamp(slope, -1e6, 1e6);
    ivec2 c = ivec2(clamp(round(PLANE_KEY_SLOPE_STEPS * slope / (1.0 + abs(slope))), -127.0, 127.0));
    return uint(c.x & 255) << 8 | uint(c.y & 255);
}

uint plane_key_steps(uint key)
{
    return key >> 16;
}

vec2 plane_key_slope(uint key)
{
    vec2 c = vec2(int(key << 16) >> 24, int(key << 24) >> 24);
    return c / (PLANE_KEY_SLOPE_STEPS - abs(c));
}

#endif
