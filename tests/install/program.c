#include <lightsheaf/lightsheaf.h>

#include <stdio.h>

int main(int argc, char **argv)
{
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
