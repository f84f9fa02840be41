#include "io/image_module.h"

const lsf_image_module *lsf_image_module_get(lsf_error *error)
{
    static const void *loaded;
    return lsf_module_table("lightsheaf-openimageio", "lsf_openimageio",
                            "reading and writing images needs it: install the package "
                            "libopenimageio2.4, or build with libopenimageio-dev",
                            &loaded, error);
}

const lsf_webp_module *lsf_webp_module_get(lsf_error *error)
{
    static const void *loaded;
    return lsf_module_table("lightsheaf-webp", "lsf_webp",
                            "reading WebP images needs it: install the package libwebp7, build "
                            "with libwebp-dev, or export the file with PNG or JPEG textures",
                            &loaded, error);
}
