#include <lightsheaf/lightsheaf.h>

#if !LSF_VERSION_AT_LEAST(0, 1, 0) || LSF_VERSION_AT_LEAST(1000, 0, 0)
#error "the macro compares versions"
#endif

#include <iostream>
#include <memory>

int main(int argc, char **argv)
{
    if (!LSF_VERSION_FITS() || lsf_version_fits(1000, 0) || lsf_version_fits(0, 1000))
        return 99;
    lsf_error error = {LSF_OK, ""};
    std::unique_ptr<lsf_scene, void (*)(lsf_scene *)> scene(
        lsf_scene_load(argc == 2 ? argv[1] : "", nullptr, &error), lsf_scene_destroy);
    if (scene)
        std::cout << lsf_version() << ' ' << lsf_scene_get_requirements(scene.get())->triangles
                  << " triangles\n";
    else
        std::cerr << error.message << '\n';
    return error.code;
}
