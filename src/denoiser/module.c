#include "denoiser/module.h"

const lsf_denoiser_module *lsf_denoiser_module_get(lsf_error *error)
{
    static const void *loaded;
    return lsf_module_table("lightsheaf-denoiser", "lsf_denoiser",
                            "install the package libdnnl2, build with libdnnl-dev, or let OpenGL "
                            "run the network (denoise.processor=gl)",
                            &loaded, error);
}
