#include <lightsheaf/lightsheaf.h>

#define TEXT_(x) #x
#define TEXT(x) TEXT_(x)

const char *lsf_version(void)
{
    return TEXT(LSF_VERSION_MAJOR) "." TEXT(LSF_VERSION_MINOR) "." TEXT(LSF_VERSION_PATCH);
}

bool lsf_version_fits(uint32_t major, uint32_t minor)
{
    return major == LSF_VERSION_MAJOR &&
           (major == 0 ? minor == LSF_VERSION_MINOR : minor <= LSF_VERSION_MINOR);
}
