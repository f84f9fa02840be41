/* Marks of light_filter.lone. */
#ifndef LSF_LIB_LIGHT_LONE
#define LSF_LIB_LIGHT_LONE

#define APART 0.5 /* few neighbours show the pixel's surface */
#define LONE 1.0  /* and a single sample brings its light */

/* Whether a part's mark is at least `least`. */
bool lone_marked(float mark, float least)
{
    return mark > least - 0.25;
}

#endif
