/* Ends the scope of shared.h: the GLSL names are no longer C macros. */
#ifndef GL_core_profile
#undef uint
#undef vec2
#undef vec3
#undef vec4
#undef mat4
#undef max
#undef min
#undef sqrt
#undef pow
#undef exp2
#undef log2
#undef abs
#endif
