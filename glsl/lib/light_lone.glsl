/* Marks of light_filter.lone. */
#ifndef LSF_LIB_LIGHT_LONE
#define LSF_LIB_LIGHT_LONE

#define APART 0.5 /* few neighbours show the pixel's surface */
#define LONE 1.0  /* and a single sample brings its light */

bvec2 marked(vec2 marks, float mark)
{
    return greaterThan(marks, vec2(mark - 0.25));
}

#endif
