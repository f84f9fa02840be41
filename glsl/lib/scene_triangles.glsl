/* The scene's triangles for shaders that fetch them themselves: their corners in normalised space,
 * without those of masked materials. The includer defines LSF_BINDING_TRIANGLES. */
#ifndef LSF_LIB_SCENE_TRIANGLES
#define LSF_LIB_SCENE_TRIANGLES

layout(std430, binding = LSF_BINDING_TRIANGLES) readonly buffer lsf_triangle_block
{
    float scene_corners[]; /* 9 a triangle */
};

vec3 scene_triangle_corner(uint triangle, uint corner)
{
    uint at = 9u * triangle + 3u * corner;
    return vec3(scene_corners[at], scene_corners[at + 1u], scene_corners[at + 2u]);
}

#endif
