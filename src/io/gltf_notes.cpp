#include "io/gltf_import.hpp"

#include <cinttypes>

/* One sentence for each kind of thing that was ignored or repaired. */

namespace lsf
{

static const size_t EXTENSIONS_NAMED_MAX = 32;

static void note_extensions(gltf_import &import)
{
    size_t named = 0;
    for (uint32_t i = 0; i < import.scene->extension_count; i++) {
        const lsf_extension &extension = import.scene->extensions[i];
        if (extension.honoured)
            continue;
        if (named++ == EXTENSIONS_NAMED_MAX) {
            lsf_scene_add_note(import.scene, "further extensions are ignored");
            return;
        }
        lsf_scene_add_note(import.scene, "extension %s is ignored%s", extension.name,
                           extension.required ? ", though the file requires it" : "");
    }
}

static void note_left_out(gltf_import &import, uint64_t primitives, uint64_t elements,
                          const char *kind)
{
    if (primitives > 0)
        lsf_scene_add_note(import.scene,
                           "%" PRIu64 " primitive%s of %s, %" PRIu64
                           " in all, left out: only triangles are rendered",
                           primitives, lsf_plural(primitives), kind, elements);
}

void gltf_notes_add(gltf_import &import)
{
    const gltf_repairs &repairs = import.repairs;
    const struct {
        uint64_t count;
        const char *what, *remark;
    } notes[] = {
        {repairs.scene_children, "node",
         " of the scene with a parent: without an ancestor in the scene it is "
         "placed by its own transform alone"},
        {repairs.joints_missing, "primitive",
         " without joints, of a node with a skin: placed by the node"},
        {repairs.targets_missing, "primitive",
         " with fewer morph targets than others of its mesh: the missing ones "
         "move nothing"},
        {repairs.weights_scaled, "vertex weight sum", " of joints other than 1: scaled"},
        {repairs.weights_animated, "animation channel",
         " of the weights of a node without morph targets: ignored"},
        {repairs.negative_colors, "component", " of vertex colours below 0: set to 0"},
        {repairs.textures_without_image, "texture",
         " without a PNG, JPEG or WebP image: materials are shown without"},
        {repairs.images_absent, "image file", " that cannot be found: materials are shown without"},
        {repairs.json.shares_clamped, "factor", " beyond 0 to 1: the nearest of the two is used"},
        {repairs.json.integers_rewritten, "number",
         " written with a point where an integer is meant: read as integer"},
        {repairs.json.alphas_cut, "emissive factor", " of four numbers: the last is ignored"},
        {repairs.trailing_bytes, "byte", " beyond the length that the GLB declares: ignored"},
        {repairs.unpadded_chunks, "GLB chunk",
         " of a length that is no multiple of 4: read as it is"},
        {repairs.unaligned_accessors, "accessor",
         " with data at an offset that is no multiple of their components' size: read as it is"},
        {repairs.highest_indices, "corner",
         " of triangles with the primitive-restart value as index: read as the vertex that it "
         "names"},
        {repairs.no_position, "primitive", " without POSITION: ignored"},
        {repairs.further_vertex_colors, "primitive",
         " with more than one set of vertex colours: only COLOR_0 is used"},
        {repairs.further_uv_sets, "primitive",
         " with more than two sets of texture coordinates: only TEXCOORD_0 and TEXCOORD_1 "
         "are used"},
        {repairs.missing_uv_sets, "textured primitive",
         " without the texture coordinates that the material reads: 0, 0 is used"},
        {repairs.trailing_indices, "corner", " left over at the end of a triangle list: ignored"},
        {repairs.rotations_scaled, "node rotation", " by other than a unit quaternion: scaled"},
    };
    note_extensions(import);
    for (const auto &note : notes)
        lsf_scene_add_count_note(import.scene, note.count, note.what, note.remark);
    note_left_out(import, repairs.point_primitives, repairs.points, "points");
    note_left_out(import, repairs.line_primitives, repairs.lines, "lines");
    lsf_scene_note_frames(import.scene, &repairs.frames);
}

} // namespace lsf
