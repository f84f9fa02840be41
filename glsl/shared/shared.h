/* Lets C, C++ and GLSL include the same declarations: include shared.h first, shared_end.h last.
 * Structs shared with GPU buffers use only float, uint, vec2, vec4 and mat4 members (std430,
 * std140 and C agree on those when a struct's size is a multiple of 16 bytes and vec4 and mat4
 * are at multiples of 16), and vec3 where it is at such a multiple, too, and a float or uint
 * follows. Functions use scalars only, and literals end in f. */
#ifdef GL_core_profile
#define LSF_SHARED_FUNCTION
#define LSF_SHARED_CONSTANT const
#define LSF_SHARED_INT(x) int(x)
#define LSF_SHARED_FLOAT(x) float(x)
#define LSF_SHARED_STRUCT(name) name
#else
#ifndef LSF_SHARED_TYPES
#define LSF_SHARED_TYPES
#include <math.h>
#include <stdbool.h>
#define LSF_SHARED_FUNCTION static inline
#define LSF_SHARED_CONSTANT static const
#define LSF_SHARED_INT(x) ((int)(x))
#define LSF_SHARED_FLOAT(x) ((float)(x))
#define LSF_SHARED_STRUCT(name) struct name
typedef unsigned int lsf_uint;
typedef struct lsf_vec2 {
    float x, y;
} lsf_vec2;
typedef struct lsf_vec3 {
    float x, y, z;
} lsf_vec3;
typedef struct lsf_vec4 {
    float x, y, z, w;
} lsf_vec4;
typedef struct lsf_mat4 {
    float m[16]; /* column-major */
} lsf_mat4;
#endif
#define uint lsf_uint
#define vec2 lsf_vec2
#define vec3 lsf_vec3
#define vec4 lsf_vec4
#define mat4 lsf_mat4
#define max fmaxf
#define min fminf
#define sqrt sqrtf
#define pow powf
#define exp2 exp2f
#define log2 log2f
#define abs fabsf
#endif
