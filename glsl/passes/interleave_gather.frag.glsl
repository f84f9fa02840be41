/* Light from split order into the picture's. */
#include "lib/interleave.glsl"

layout(binding = 0) uniform sampler2D irradiance_texture;
layout(location = 0) out vec4 irradiance_out;
#if LSF_SPECULAR
layout(binding = 1) uniform sampler2D specular_texture;
layout(location = 1) out vec4 specular_out;
#endif

void main()
{
    ivec2 place = interleave_place(ivec2(gl_FragCoord.xy), textureSize(irradiance_texture, 0));
    irradiance_out = texelFetch(irradiance_texture, place, 0);
#if LSF_SPECULAR
    specular_out = texelFetch(specular_texture, place, 0);
#endif
}
