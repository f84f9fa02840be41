#include <lightsheaf/lightsheaf.h>

#if !LSF_VERSION_AT_LEAST(0, 1, 0) || LSF_VERSION_AT_LEAST(1000, 0, 0)
#error "the macro compares versions"
#endif

#include <stdio.h>

int main(int argc, char **argv)
{
    if (!LSF_VERSION_FITS() || lsf_version_fits(1000, 0) || lsf_version_fits(0, 1000))
        return 99;
    lsf_error error = {LSF_OK, ""};
    lsf_scene *scene = argc == 2 ? lsf_scene_load(argv[1], NULL, &error) : NULL;
    if (scene)
        printf("%s %llu triangles\n", lsf_version(),
               (unsigned long long)lsf_scene_get_requirements(scene)->triangles);
    else
        fprintf(stderr, "%s\n", error.message);
    lsf_scene_destroy(scene);
    return error.code;
}
