/* Makes normals and tangents that are left out, and normalises those that are given. */
#ifndef LSF_SCENE_MESH_FRAME_H
#define LSF_SCENE_MESH_FRAME_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* Unit normal of a triangle by the right-hand rule. A triangle without area gets a unit vector
 * that is perpendicular to its longest edge. */
void lsf_triangle_normal(const float *a, const float *b, const float *c, float normal[3]);

/* One normal for three vertices each; no vertex is shared. */
void lsf_flat_normals(const float *positions, uint64_t triangle_count, float *normals);

/* Scales to unit length in double precision, so that even denormal input works. False, leaving
 * the vector alone, when its length is 0. `off` is set when the length differs from 1 by more
 * than 1 %. */
bool lsf_make_unit(float vector[3], bool *off);

/* Counts of what was repaired in normals and tangents. */
typedef struct lsf_frame_repairs {
    uint64_t normals_missing; /* lists of triangles without normals */
    uint64_t normals_scaled, normals_zero, normals_turned;
    uint64_t tangents_scaled;
    uint64_t tangents_without_uv; /* lists of triangles */
} lsf_frame_repairs;

/* Normalises normals, and returns how many have no length: these are left to
 * lsf_replace_zero_normals. */
uint64_t lsf_unit_normals(float *normals, uint64_t count, lsf_frame_repairs *repairs);
/* Normalises tangents and sets their sign to 1 or -1; those of no length are replaced by some
 * that are perpendicular to the normals. */
void lsf_unit_tangents(const float *normals, float *tangents, uint64_t count,
                       lsf_frame_repairs *repairs);

/* Replaces the normals of no length by the area-weighted mean of the triangles around them, or
 * by 0,0,1 where that has no length either. */
void lsf_replace_zero_normals(const float *positions, uint64_t vertex_count,
                              const uint32_t *indices, uint64_t index_count, float *normals);

/* Turns over unit normals that are more than 120 degrees away from those of all the triangles with
 * area that use them, which a program wrote that reversed either; what is lit from the front would
 * be dark. Normals that are bent on purpose, as those of foliage, stay. So do bitangents: the sign
 * of tangents that have been made unit changes; NULL: there are none. False without memory. */
bool lsf_turn_normals(const float *positions, uint64_t vertex_count, const uint32_t *indices,
                      uint64_t index_count, float *normals, float *tangents,
                      lsf_frame_repairs *repairs);

/* A vertex cannot serve triangles whose texture is mirrored and others whose texture is not: the
 * bitangent's sign differs. Gives the mirrored ones vertices of their own, numbered from
 * vertex_count on, and changes `indices` to use them. `copied` gets the old vertex of each new
 * one; malloc'ed. False without memory. */
bool lsf_split_mirrored(const float *uvs, uint64_t vertex_count, uint32_t *indices,
                        uint64_t index_count, uint32_t **copied, uint64_t *copied_count);

/* Tangents for vertices that lsf_split_mirrored has split. A triangle's tangent is the direction
 * of growing u; a vertex gets the mean of its triangles' tangents, each projected into the
 * vertex's tangent plane, made unit and weighted by the triangle's angle there (the weights of
 * MikkTSpace: Mikkelsen, Simulation of Wrinkled Surfaces Revisited, 2008). The bitangent
 * cross(normal, tangent) * w points towards falling v, which is up in the image. `uvs` NULL, and
 * triangles whose texture has no area, give some perpendicular vector. */
void lsf_make_tangents(const float *positions, const float *normals, const float *uvs,
                       uint64_t vertex_count, const uint32_t *indices, uint64_t index_count,
                       float *tangents);

/* A unit vector perpendicular to a unit one. */
void lsf_any_tangent(const float normal[3], float tangent[3]);

#ifdef __cplusplus
}
#endif
#endif
