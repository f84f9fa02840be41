/* Alpha masks and blended surfaces for passes that draw the scene's depth only. Switches LSF_MASK, LSF_BLEND,
 * LSF_TEXTURED, LSF_SECOND_UV, LSF_VERTEX_COLOR; lsf_scene_gpu_mask_switches adds them. */
#ifndef LSF_LIB_MASK
#define LSF_LIB_MASK

#include "lib/alpha.glsl"
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
#if LSF_BLEND
flat in uvec2 vertex_layer;
#endif
#endif

/* Whether an alpha mask, or the draw for a blended surface, removes the fragment. */
bool masked_out()
{
#if LSF_MASK
    lsf_material_data material = materials[vertex_material];
    float alpha = material.base_color.a;
#if LSF_TEXTURED
    if (slot_used(material.base_color_slot)) {
        vec2 uv1 = vertex_uv0;
#if LSF_SECOND_UV
        uv1 = vertex_uv1;
#endif
        alpha *= slot_sample_finest(base_color_texture, material.base_color_slot, vertex_uv0, uv1).a;
    }
#endif
#if LSF_VERTEX_COLOR
    alpha *= vertex_alpha;
#endif
    uvec3 key = uvec3(0u);
#if LSF_BLEND
    key = uvec3(layer_key(vertex_layer.x, vertex_layer.y, gl_FrontFacing), uvec2(gl_FragCoord.xy));
#endif
    return alpha_cuts_out(material.emission.w, alpha, key);
#else
    return false;
#endif
}

#endif
