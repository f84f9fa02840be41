#include "lib/light_map.glsl"
#include "lib/scene.glsl"

#if LSF_MASK
flat in uint vertex_material;
layout(binding = LSF_UNIT_BASE_COLOR) uniform sampler2D base_color_texture;
#if LSF_TEXTURED
in vec2 vertex_uv0;
#endif
#if LSF_SECOND_UV
in vec2 vertex_uv1;
#endif
#if LSF_VERTEX_COLOR
in float vertex_alpha;
#endif
#endif
#if LSF_GRADIENT
layout(location = 0) out vec2 gradient;
#endif

void main()
{
#if LSF_GRADIENT
    /* Before any discard, while the whole quad is alive. */
    float z = gl_FragCoord.z;
    gradient = vec2(dFdx(z), dFdy(z)) / light_map_depth_unit(z);
#endif
#if LSF_MASK
    lsf_material_data material = materials[vertex_material];
    float alpha = material.base_color.a;
#if LSF_TEXTURED
    if (slot_used(material.base_color_slot)) {
        /* No footprint: the sharpest level. */
        texture_place place = texture_place(vertex_uv0, vec2(0.0), vec2(0.0), vertex_uv0,
                                            vec2(0.0), vec2(0.0));
#if LSF_SECOND_UV
        place.uv1 = vertex_uv1;
#endif
        alpha *= slot_sample(base_color_texture, material.base_color_slot, place).a;
    }
#endif
#if LSF_VERTEX_COLOR
    alpha *= vertex_alpha;
#endif
    if (alpha < material.emission.w)
        discard;
#endif
}
