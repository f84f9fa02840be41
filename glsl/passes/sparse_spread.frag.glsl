/* Light of the points that pixels have, at their places among the pixels' sample points: it stands for all of
 * these. See src/passes/sparse.md. Switches LSF_SPARSE, LSF_PIXEL_SIDE, LSF_SPECULAR. */
#include "lib/sparse_grid.glsl"

layout(binding = 4) uniform sampler2D irradiance_texture; /* of the grid's points */
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 5) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

void main()
{
    ivec2 at = ivec2(gl_FragCoord.xy), point = at / LSF_PIXEL_SIDE;
    float weight = sparse_pixel(point) == at ? float(LSF_PIXEL_SIDE * LSF_PIXEL_SIDE) : 0.0;
    irradiance_out = weight * texelFetch(irradiance_texture, point, 0);
#if LSF_SPECULAR
    specular_out = weight * texelFetch(specular_texture, point, 0);
#endif
}
