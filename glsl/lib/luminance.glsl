#ifndef LSF_LIB_LUMINANCE
#define LSF_LIB_LUMINANCE

/* Of linear sRGB (ITU-R BT.709). */
float luminance(vec3 c)
{
    return dot(c, vec3(0.2126, 0.7152, 0.0722));
}

#endif
