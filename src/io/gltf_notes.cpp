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

static void note_count(gltf_import &import, uint64_t count, const char *what)
{
    if (count > 0)
        lsf_scene_add_note(import.scene, "%" PRIu64 " %s", count, what);
}

static void note_left_out(gltf_import &import, uint64_t primitives, uint64_t elements,
                          const char *kind)
{
    if (primitives > 0)
        lsf_scene_add_note(import.scene,
                           "%" PRIu64 " primitive%s of %s, %" PRIu64
                           " in all, left out: only triangles are rendered",
                           primitives, primitives == 1 ? "" : "s", kind, elements);
}

void gltf_notes_add(gltf_import &import)
{
    const gltf_repairs &repairs = import.repairs;
    note_extensions(import);

    uint64_t skinned = 0;
    for (size_t i = 0; i < import.model.nodes.size(); i++)
        skinned += import.model.nodes[i].skin >= 0 && import.node_of[i] != LSF_NONE;
    note_count(import, skinned,
               "skinned nodes: skins are ignored, the meshes are shown undeformed");
    note_count(import, repairs.negative_colors,
               "components of vertex colours were negative and set to 0");
    note_count(
        import, repairs.textures_without_image,
        "textures have no PNG, JPEG or WebP image: the materials that use them are shown without");
    note_count(import, repairs.morph_targets,
               "primitives with morph targets: the targets are ignored");
    note_left_out(import, repairs.point_primitives, repairs.points, "points");
    note_left_out(import, repairs.line_primitives, repairs.lines, "lines");
    note_count(import, repairs.no_position, "primitives without POSITION are ignored");
    note_count(import, repairs.further_vertex_colors,
               "primitives with more than one set of vertex colours: only COLOR_0 is used");
    note_count(import, repairs.further_uv_sets,
               "primitives with more than two sets of texture coordinates: only TEXCOORD_0 and "
               "TEXCOORD_1 are used");
    note_count(import, repairs.missing_uv_sets,
               "textured primitives lack the texture coordinates that their material reads: 0, 0 "
               "is used");
    note_count(import, repairs.trailing_indices,
               "vertices at the end of a triangle list do not make a whole triangle and are "
               "ignored");
    note_count(import, repairs.normals_missing_primitives,
               "primitives have no normals: they are shaded flat");
    note_count(import, repairs.normals_scaled, "normals were not of unit length and were scaled");
    note_count(import, repairs.normals_zero,
               "normals had no length and were replaced by those of the triangles around them");
    note_count(import, repairs.tangents_scaled,
               "tangents were not of unit length, or had no sign, and were repaired");
    note_count(import, repairs.tangents_without_uv,
               "primitives need tangents but have no texture coordinates: arbitrary tangents are "
               "used");
    note_count(import, repairs.rotations_scaled,
               "node rotations were not unit quaternions and were scaled");
}

} // namespace lsf
