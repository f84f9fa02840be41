#include <lightsheaf/lightsheaf.h>

#include <iostream>
#include <memory>

int main(int argc, char **argv)
{
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
