#include <lightsheaf/lightsheaf.h>

#define TEXT_(x) #x
#define TEXT(x) TEXT_(x)

const char *lsf_version(void)
{
    return TEXT(LSF_VERSION_MAJOR) "." TEXT(LSF_VERSION_MINOR) "." TEXT(LSF_VERSION_PATCH);
}
