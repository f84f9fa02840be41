#include "io/foreign_file.h"

#include "base/base.h"

#include <string.h>
#include <strings.h>

#define CONVERT "export the scene as glTF 2.0, or convert it (Blender reads most formats)"
#define PICTURE "a scene is wanted here; `--environment` takes an .hdr or .exr"

#define GIT_LFS_POINTER "version https://git-lfs"

/* Beginnings that no other kind of file has. */
static const struct {
    const char *magic;
    lsf_foreign_file file;
} beginnings[] = {
    {GIT_LFS_POINTER, {"a pointer of Git LFS, not the file itself", "run `git lfs pull`"}},
    {"Kaydara FBX Binary", {"an Autodesk FBX file", CONVERT}},
    {"; FBX ", {"an Autodesk FBX file", CONVERT}},
    {"PXR-USDC", {"a USD file", CONVERT}},
    {"#usda", {"a USD file", CONVERT}},
    {"BLENDER", {"a Blender file", "export the scene as glTF 2.0"}},
    {"ply\n", {"a PLY file", CONVERT}},
    {"ply\r\n", {"a PLY file", CONVERT}},
    {"Ogawa", {"an Alembic file", CONVERT}},
    {"#VRML", {"a VRML file", CONVERT}},
    {"ISO-10303-21", {"a STEP file", CONVERT}},
    {"\x89PNG", {"a PNG picture", PICTURE}},
    {"\xff\xd8\xff", {"a JPEG picture", PICTURE}},
    {"\x76\x2f\x31\x01", {"an OpenEXR picture", PICTURE}},
    {"#?RADIANCE", {"an HDR picture", PICTURE}},
    {"#?RGBE", {"an HDR picture", PICTURE}},
    {"<!DOCTYPE html", {"a web page, not the file itself", "download the file again"}},
    {"<html", {"a web page, not the file itself", "download the file again"}},
    {"\x1f\x8b", {"compressed by gzip", "unpack it first"}},
};

static const lsf_foreign_file nothing = {"an empty file", "copy or export it again"};
static const lsf_foreign_file unknown = {"neither: it begins with neither `{` nor `glTF`", CONVERT};

/* A file that begins with neither '{' nor "glTF" is taken for what its name says. */
static const struct {
    const char *ending;
    lsf_foreign_file file;
} endings[] = {
    {".obj", {"a Wavefront OBJ file", CONVERT}},
    {".mtl", {"the materials of a Wavefront OBJ file", CONVERT}},
    {".fbx", {"an Autodesk FBX file", CONVERT}},
    {".dae", {"a COLLADA file", CONVERT}},
    {".usd", {"a USD file", CONVERT}},
    {".usda", {"a USD file", CONVERT}},
    {".usdc", {"a USD file", CONVERT}},
    {".usdz", {"a USD file", CONVERT}},
    {".blend", {"a Blender file", "export the scene as glTF 2.0"}},
    {".stl", {"an STL file", CONVERT}},
    {".ply", {"a PLY file", CONVERT}},
    {".3ds", {"a 3D Studio file", CONVERT}},
    {".3mf", {"a 3MF file", CONVERT}},
    {".abc", {"an Alembic file", CONVERT}},
    {".wrl", {"a VRML file", CONVERT}},
    {".x3d", {"an X3D file", CONVERT}},
    {".step", {"a STEP file", CONVERT}},
    {".stp", {"a STEP file", CONVERT}},
    {".pbrt", {"a PBRT scene", CONVERT}},
    {".xml", {"an XML file", CONVERT}},
    {".zip", {"a ZIP archive", "unpack it first"}},
    {".bin", {"a buffer that a .gltf refers to", "give the .gltf instead"}},
};

static bool begins_with(const char *text, size_t length, const char *beginning)
{
    size_t wanted = strlen(beginning);
    return length >= wanted && strncasecmp(text, beginning, wanted) == 0;
}

bool lsf_is_git_lfs_pointer(const void *bytes, size_t length)
{
    return begins_with(bytes, length, GIT_LFS_POINTER);
}

const lsf_foreign_file *lsf_foreign_file_find(const char *path, const void *bytes, size_t length)
{
    const char *text = bytes;
    if (begins_with(text, length, "\xef\xbb\xbf")) { /* byte order mark */
        text += 3;
        length -= 3;
    }
    while (length > 0 && strchr(" \t\r\n", *text) && *text) {
        text++;
        length--;
    }
    if (length == 0)
        return &nothing;
    if (*text == '{' || begins_with(text, length, "glTF"))
        return NULL;
    for (size_t i = 0; i < LSF_COUNT(beginnings); i++)
        if (begins_with(text, length, beginnings[i].magic))
            return &beginnings[i].file;
    const char *ending = strrchr(path, '.');
    for (size_t i = 0; ending && i < LSF_COUNT(endings); i++)
        if (strcasecmp(ending, endings[i].ending) == 0)
            return &endings[i].file;
    return &unknown;
}
