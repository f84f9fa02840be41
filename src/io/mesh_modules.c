#include "io/mesh_modules.h"

const lsf_draco_module *lsf_draco_module_get(lsf_error *error)
{
    static const void *loaded;
    return lsf_module_table("lightsheaf-draco", "lsf_draco",
                            "install the package libdraco7, build with libdraco-dev, or export the "
                            "file without mesh compression",
                            &loaded, error);
}

const lsf_meshopt_module *lsf_meshopt_module_get(lsf_error *error)
{
    static const void *loaded;
    return lsf_module_table("lightsheaf-meshopt", "lsf_meshopt",
                            "install the package libmeshoptimizer2d, build with "
                            "libmeshoptimizer-dev, or export the file without mesh compression",
                            &loaded, error);
}
