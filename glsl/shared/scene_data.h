/* The scene as shaders read it. */
#ifndef LSF_SHARED_SCENE_DATA_H
#define LSF_SHARED_SCENE_DATA_H

#include "shared/shared.h"

/* One primitive placed by one node; transforms go from object to normalised space. Vertex
 * shaders read it as attributes that advance once per draw, because software GL fetches such
 * attributes once for all vertices. */
struct lsf_instance_data {
    vec4 transform_0, transform_1, transform_2; /* rows of the 3x4 matrix */
    vec4 normal_0, normal_1, normal_2;          /* rows of the normals' 3x3 matrix in x y z;
                                                 * w: material index, mirrored (0 or 1), the
                                                 * instance's number */
};

/* A texture slot: u' = row_0.x u + row_0.y v + row_0.z, v' likewise with row_1.
 * row_0.w: 1 when there is a texture; row_1.w: the UV set, 0 or 1. */
struct lsf_texture_slot_data {
    vec4 row_0, row_1;
};
#ifndef GL_core_profile
typedef struct lsf_texture_slot_data lsf_texture_slot_data;
#endif

struct lsf_material_data {
    vec4 base_color;
    vec4 emission;   /* rgb: radiance factor [W/(m^2 sr)]; w: alpha cutoff, LSF_ALPHA_ALL or
                      * LSF_ALPHA_BLENDED */
    vec4 surface;    /* metallic, roughness, normal scale, f0 of the dielectric */
    vec4 anisotropy; /* strength, cos and sin of the rotation; transmission */
    vec4 flags;      /* double-sided, unlit, surface of a medium; 0 or 1; the material's number */
    vec4 absorption; /* rgb: of the medium, per unit of normalised space; 1 where its surface is
                        open */
    lsf_texture_slot_data base_color_slot, metallic_roughness_slot, normal_slot, emissive_slot,
        anisotropy_slot, transmission_slot;
};

/* Further parameters that few materials have, in a table of their own, in the order of the
 * materials' numbers. */
struct lsf_lobe_data {
    vec4 specular; /* rgb: tint of f0; w: weight */
    vec4 coat;     /* factor, roughness, scale of the normal */
    vec4 sheen;    /* rgb: color; w: roughness */
    lsf_texture_slot_data specular_slot, specular_color_slot, coat_slot, coat_roughness_slot,
        coat_normal_slot, sheen_color_slot, sheen_roughness_slot;
};
#define LSF_LOBE_ROWS 17 /* of four floats */

/* Largest distance along x and y by which a pipeline moves a vertex on the screen, to 1/256 of a
 * pixel: GL_SUBPIXEL_BITS is 8 on GPUs for desktops. GPUs derive depths from moved vertices, so
 * that a surface has the depth of a point that is as far away; llvmpipe does not. [pixels] */
#define LSF_RASTER_STEP (1.0f / 512.0f)

/* In place of an alpha cutoff. */
#define LSF_ALPHA_ALL -1.0f     /* nothing is cut out */
#define LSF_ALPHA_BLENDED -2.0f /* alphaMode BLEND; see lib/alpha.glsl */

/* Attribute locations of the vertex streams. */
#define LSF_ATTRIBUTE_POSITION 0
#define LSF_ATTRIBUTE_NORMAL 1
#define LSF_ATTRIBUTE_TANGENT 2
#define LSF_ATTRIBUTE_UV0 3
#define LSF_ATTRIBUTE_UV1 4
#define LSF_ATTRIBUTE_COLOR 5
#define LSF_ATTRIBUTE_TRANSFORM 6           /* 3 rows */
#define LSF_ATTRIBUTE_NORMAL_TRANSFORM 9    /* 3 rows */
#define LSF_ATTRIBUTE_PREVIOUS_TRANSFORM 12 /* 3 rows */
#define LSF_ATTRIBUTE_PREVIOUS_POSITION 15

/* Storage buffers and texture units of the scene, the same in every pass. */
#define LSF_BINDING_MATERIALS 0
#define LSF_UNIT_BASE_COLOR 0
#define LSF_UNIT_METALLIC_ROUGHNESS 1
#define LSF_UNIT_NORMAL 2
#define LSF_UNIT_EMISSIVE 3
#define LSF_UNIT_ANISOTROPY 4
#define LSF_UNIT_ENVIRONMENT 5
#define LSF_UNIT_TRANSMISSION 13
#define LSF_UNIT_LOBES 24 /* the table of lsf_lobe_data, and its textures */
#define LSF_UNIT_SPECULAR 25
#define LSF_UNIT_SPECULAR_COLOR 26
#define LSF_UNIT_COAT 27
#define LSF_UNIT_COAT_ROUGHNESS 28
#define LSF_UNIT_COAT_NORMAL 29
#define LSF_UNIT_SHEEN_COLOR 30
#define LSF_UNIT_SHEEN_ROUGHNESS 31
#define LSF_UNIT_SEEN_SURFACE 20 /* the visible surface, for those behind it */
#define LSF_UNIT_SEEN_DEPTH 14   /* depth of the visible surface, for surfaces in front of it */

/* Texture units of the current light. */
#define LSF_UNIT_SHADOW_DEPTH 6
#define LSF_UNIT_SHADOW_GRADIENT 7
#define LSF_UNIT_SHADOW_TINT 12 /* see lib/shadow.glsl */
#define LSF_UNIT_EMISSION 8     /* see lib/emission_pdf.glsl */
#define LSF_UNIT_BUNDLE_PDF 9   /* density of ray-bundles by direction */
#define LSF_UNIT_VPL 10         /* the VPLs of an iteration, a buffer texture: RGBA32F */

/* Location of the radiance of an environment without a map. */
#define LSF_LOCATION_ENVIRONMENT 10
/* Location of the current region; see lib/region.glsl. */
#define LSF_LOCATION_REGION 11
/* Locations of bidirectional_shade; see lib/mis.glsl and lib/shading_vertex.glsl. */
#define LSF_LOCATION_STRATEGY 12
#define LSF_LOCATION_SUPPRESSION 13
/* Kernel of suppression of a lobe that lights other surfaces, relative to that of one that is seen.
 * A spike of it lights what it reaches evenly, and shows no highlight for each sample: a sixteenth
 * of the samples are enough (src/passes/bidirectional_shade.md). */
#define LSF_HIDDEN_KERNEL (1.0f / 16.0f)
#define LSF_LOCATION_ARRIVAL 14
#define LSF_LOCATION_VPL 15
#define LSF_LOCATION_ADDED 16
/* Texture unit of the pixels at which light is gathered; see lib/sparse.glsl. */
#define LSF_UNIT_POSITION_PIXELS 17
/* Locations of lib/voxel_cone.glsl. */
#define LSF_LOCATION_CONE 18
#define LSF_LOCATION_CONE_STEPS 19
#define LSF_LOCATION_CONE_ROTATION 20
#define LSF_LOCATION_CONE_SET 21 /* LSF_CONE_MAX locations */
#define LSF_CONE_MAX 32
/* Location of the seed of stochastic transparency; see lib/chance.glsl. */
#define LSF_LOCATION_CHANCE 60
/* Locations of the grid of points at which light is gathered; see lib/sparse_grid.glsl. */
#define LSF_LOCATION_SPARSE_GRID 61
#define LSF_LOCATION_SPARSE_SHAPE 62
/* Location of the density of directions drawn by the environment's radiance; see lib/sky.glsl. */
#define LSF_LOCATION_SKY (LSF_LOCATION_CONE_SET + LSF_CONE_MAX)
/* Location of the number of rays that find the environment otherwise, in
 * passes/direct_light.frag.glsl and passes/voxel_light.comp.glsl; and of a bundle's weights
 * against them, in passes/bidirectional_shade_hit.frag.glsl. */
#define LSF_LOCATION_SKY_CHANCE (LSF_LOCATION_SKY + 1)
/* Location of the solid angle over which glossy lobes are spread; see lib/straight.glsl. */
#define LSF_LOCATION_LOBE_ANGLE (LSF_LOCATION_SKY_CHANCE + 1)

/* Location of the draws of voxels; see lib/voxel_cone.glsl. */
#define LSF_LOCATION_VOXEL_DRAW (LSF_LOCATION_LOBE_ANGLE + 1)
/* Location of the points drawn on emitters; see lib/voxel_emitter.glsl. */
#define LSF_LOCATION_EMITTERS (LSF_LOCATION_VOXEL_DRAW + 1)
/* Location of the spread of lamps that voxels mirror; see lib/voxel_surface.glsl. */
#define LSF_LOCATION_VOXEL_LAMP (LSF_LOCATION_EMITTERS + 1)
/* Location of the random numbers of lamps that voxels keep; see passes/voxel_light.comp.glsl. */
#define LSF_LOCATION_LAMP_SEED (LSF_LOCATION_VOXEL_LAMP + 1)
/* Location of the kernel that decides which lobes paths gather; see lib/specular_share.glsl. */
#define LSF_LOCATION_SPECULAR_SHARE (LSF_LOCATION_LAMP_SEED + 1)

/* Uniform buffers. */
#define LSF_BINDING_VIEW 0
#define LSF_BINDING_LIGHT 1 /* the current light, or the current VPL as a light with a map */
#define LSF_BINDING_BUNDLE 2
#define LSF_BINDING_VOXEL 3

/* Storage buffers. */
#define LSF_BINDING_VPL 1           /* the VPLs of an iteration, to be written */
#define LSF_BINDING_SPARSE_COUNTS 7 /* pixels that no point of the grid represents */
#define LSF_BINDING_BUNDLE_NODES 2  /* 2 to 7: the nodes of the current bundle */

/* Result of a ray-bundle search without a hit. */
#define LSF_NO_NODE 0xffffffffu

#include "shared/shared_end.h"
#endif
