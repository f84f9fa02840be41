/* What moved to a pixel, for the passes of temporal. Switch LSF_PIXEL_SIDE. */
#include "lib/pixel_side.glsl"

layout(binding = 2) uniform sampler2D motion_texture; /* motion [sample points], previous depth, instance */

/* Motion [pixels], previous depth and instance of the nearest surface that the pixel's sample points show; the means
 * over the points that show its instance. */
vec4 motion_at(ivec2 pixel)
{
    vec4 motion = texelFetch(motion_texture, pixel * LSF_PIXEL_SIDE, 0);
#if LSF_PIXEL_SIDE > 1
    float alike = 1.0;
    for (int i = 1; i < LSF_PIXEL_SIDE * LSF_PIXEL_SIDE; i++) {
        ivec2 point = pixel * LSF_PIXEL_SIDE + ivec2(i % LSF_PIXEL_SIDE, i / LSF_PIXEL_SIDE);
        vec4 other = texelFetch(motion_texture, point, 0);
        if (other.w == motion.w) {
            motion.xyz += other.xyz;
            alike += 1.0;
        } else if (alike * other.z > motion.z) {
            motion = other;
            alike = 1.0;
        }
    }
    motion.xyz /= alike * vec2(LSF_PIXEL_SIDE, 1.0).xxy;
#endif
    return motion;
}
