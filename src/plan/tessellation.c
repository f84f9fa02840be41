#include "plan/tessellation.h"

#include "scene/tessellate.h"

const lsf_option_row lsf_tessellation_options[LSF_TESSELLATION_OPTION_COUNT] = {
    {"tessellation.factor", LSF_OPTION_INT, offsetof(lsf_tessellation_params, factor), 1.0,
     LSF_TESSELLATE_MAX_FACTOR, NULL, "",
     "splits each edge of a triangle into this many, and the triangle into the square of it; "
     "rounds surfaces with smooth normals (Phong tessellation)"},
    {"tessellation.shape", LSF_OPTION_FLOAT, offsetof(lsf_tessellation_params, shape), 0.0, 1.0,
     NULL, "", "0: triangles stay flat; 1: they curve all the way towards their tangent planes"},
};
