/* Loads a .glb put together in memory. To be included behind cmocka.h. */
#ifndef LSF_TESTS_GLB_H
#define LSF_TESTS_GLB_H

#include <stdlib.h>
#include <string.h>

#include <lightsheaf/scene.h>

/* Of that JSON, which ends with "}   ", and `bytes` of a binary chunk, a multiple of 4. */
static lsf_scene *load_glb(const char *json, const void *binary, size_t bytes, lsf_error *error)
{
    uint32_t json_bytes = (uint32_t)strlen(json) & ~3u, at = 20 + json_bytes + 8;
    const uint32_t head[] = {0x46546c67, 2, at + (uint32_t)bytes, json_bytes, 0x4e4f534a};
    const uint32_t chunk[] = {(uint32_t)bytes, 0x004e4942};
    char *file = malloc(at + bytes);
    assert_non_null(file);
    memcpy(file, head, sizeof head);
    memcpy(file + 20, json, json_bytes);
    memcpy(file + 20 + json_bytes, chunk, sizeof chunk);
    memcpy(file + at, binary, bytes);
    lsf_scene *scene = lsf_scene_load_memory(file, at + bytes, NULL, NULL, error);
    free(file);
    return scene;
}

#endif
