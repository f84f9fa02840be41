#include "io/gltf_deform.hpp"

#include "scene/geometry.h"
#include "scene/material.h"

#include <algorithm>
#include <array>
#include <cfloat>
#include <cinttypes>
#include <cstdlib>
#include <map>
#include <memory>
#include <set>

/* The primitives of the meshes that the scene uses, each stored once however many nodes place it.
 */

namespace lsf
{

class geometry_importer
{
  public:
    geometry_importer(gltf_import &import, const stream_choice &streams);
    void add_mesh(size_t mesh);
    void finish();

  private:
    /* The accessors that primitives share when they share vertices or indices. */
    using vertex_key = std::vector<int>;
    using index_key = std::array<int, 3>;

    void add_primitive(const tinygltf::Primitive &source, size_t mesh, const std::string &location);
    vertex_key key_of(const tinygltf::Primitive &source, size_t mesh) const;
    void add_shared(const tinygltf::Primitive &source, size_t mesh, const std::string &location,
                    lsf_primitive &primitive);
    void add_computed(const tinygltf::Primitive &source, size_t mesh, const std::string &location,
                      bool flat, bool tangents, lsf_primitive &primitive);
    void add_shape(const tinygltf::Primitive &source, size_t mesh, bool flat,
                   const vertex_arrays &arrays, const std::string &location,
                   const lsf_primitive &primitive);
    uint32_t place(uint32_t node, uint32_t primitive);
    uint32_t deformer_of(uint32_t node, uint32_t primitive, uint32_t shape, uint32_t skin);
    void find_uses();
    void repair(vertex_arrays &arrays, const std::vector<uint32_t> &triangles,
                const tinygltf::Primitive &source, memory_loan &loan);
    void make_flat(vertex_arrays &arrays, std::vector<uint32_t> &triangles,
                   const std::string &location, memory_loan &loan);
    void compute_tangents(vertex_arrays &arrays, std::vector<uint32_t> &triangles,
                          const lsf_material &material, const std::string &location,
                          memory_loan &loan);
    void append_vertices(const vertex_arrays &arrays, lsf_primitive &primitive);
    void repeat_vertices(uint64_t source, uint64_t count);
    void append_indices(const std::vector<uint32_t> &triangles, lsf_primitive &primitive);
    void count_left_out(const tinygltf::Primitive &source);
    void count_ignored(const tinygltf::Primitive &source, const lsf_material &material);

    gltf_import &import_;
    lsf_scene *scene_;
    stream_choice streams_;
    lsf_geometry geometry_;
    std::vector<lsf_primitive> primitives_;
    std::map<vertex_key, lsf_primitive> known_vertices_;
    std::map<index_key, lsf_primitive> known_indices_;

    std::vector<bool> skinned_,
        unskinned_; /* by file's mesh: some node uses it with a skin; without */
    std::map<uint64_t, uint32_t> shape_of_; /* by first vertex */
    std::vector<lsf_deformer> deformers_;
    std::map<std::pair<uint32_t, uint64_t>, uint32_t> known_deformers_; /* by node, first vertex */
    std::set<uint64_t> taken_; /* first vertices that a node deforms where they are */
};

geometry_importer::geometry_importer(gltf_import &import, const stream_choice &streams)
    : import_(import), scene_(import.scene), streams_(streams)
{
    lsf_geometry_begin(&geometry_, scene_);
    geometry_.streams[LSF_STREAM_TANGENT].present = streams.tangent;
    geometry_.streams[LSF_STREAM_UV0].present = streams.uv0;
    geometry_.streams[LSF_STREAM_UV1].present = streams.uv1;
    geometry_.streams[LSF_STREAM_COLOR].present = streams.color;
    find_uses();
}

/* --- vertex streams that materials need --- */

static const lsf_material &material_of(const gltf_import &import,
                                       const tinygltf::Primitive &primitive)
{
    return import.scene
        ->materials[primitive.material < 0 ? import.scene->material_count - 1
                                           : import.material_of[(size_t)primitive.material]];
}

static stream_choice choose_streams(const gltf_import &import)
{
    stream_choice streams;
    for (size_t i = 0; i < import.model.meshes.size(); i++) {
        if (!import.mesh_used[i])
            continue;
        for (const tinygltf::Primitive &primitive : import.model.meshes[i].primitives) {
            if (!mode_is_triangles(primitive.mode))
                continue;
            const lsf_material &material = material_of(import, primitive);
            streams.tangent = streams.tangent || material.has_tangents;
            streams.uv0 = streams.uv0 || lsf_material_wants_uv(&material, 0);
            streams.uv1 = streams.uv1 || lsf_material_wants_uv(&material, 1);
            streams.color = streams.color || find_attribute(primitive, "COLOR_0") >= 0;
        }
    }
    return streams;
}

/* Points and lines; a loop has as many lines as vertices. */
void geometry_importer::count_left_out(const tinygltf::Primitive &source)
{
    int accessor = source.indices >= 0 ? source.indices : find_attribute(source, "POSITION");
    uint64_t vertices = accessor < 0 ? 0 : import_.model.accessors[(size_t)accessor].count;
    gltf_repairs &repairs = import_.repairs;
    if (source.mode == TINYGLTF_MODE_POINTS) {
        repairs.point_primitives++;
        repairs.points += vertices;
        return;
    }
    repairs.line_primitives++;
    repairs.lines += source.mode == TINYGLTF_MODE_LINE        ? vertices / 2
                     : source.mode == TINYGLTF_MODE_LINE_LOOP ? vertices
                     : vertices > 0                           ? vertices - 1
                                                              : 0;
}

void geometry_importer::count_ignored(const tinygltf::Primitive &source,
                                      const lsf_material &material)
{
    gltf_repairs &repairs = import_.repairs;
    repairs.further_vertex_colors += find_attribute(source, "COLOR_1") >= 0;
    repairs.further_uv_sets += find_attribute(source, "TEXCOORD_2") >= 0;
    repairs.missing_uv_sets +=
        (lsf_material_reads_uv(&material, 0) && find_attribute(source, "TEXCOORD_0") < 0) ||
        (lsf_material_reads_uv(&material, 1) && find_attribute(source, "TEXCOORD_1") < 0);
}

/* --- repairs --- */

/* Memory that lsf_replace_zero_normals and lsf_make_tangents take for each vertex. */
static const uint64_t SUM_BYTES = 3 * sizeof(double);

void geometry_importer::repair(vertex_arrays &arrays, const std::vector<uint32_t> &triangles,
                               const tinygltf::Primitive &source, memory_loan &loan)
{
    lsf_frame_repairs *repairs = &import_.repairs.frames;
    if (lsf_unit_normals(arrays.normal.data(), arrays.normal.size() / 3, repairs) > 0) {
        loan.take(arrays.count, SUM_BYTES);
        lsf_replace_zero_normals(arrays.position.data(), arrays.count, triangles.data(),
                                 triangles.size(), arrays.normal.data());
    }
    lsf_unit_tangents(arrays.normal.data(), arrays.tangent.data(), arrays.tangent.size() / 4,
                      repairs);
    if (!source.targets.empty()) /* they move normals from where the file has them */
        return;
    loan.take(arrays.count, 1);
    if (!lsf_turn_normals(arrays.position.data(), arrays.count, triangles.data(), triangles.size(),
                          arrays.normal.data(),
                          arrays.tangent.empty() ? nullptr : arrays.tangent.data(), repairs))
        throw std::bad_alloc();
}

void geometry_importer::make_flat(vertex_arrays &arrays, std::vector<uint32_t> &triangles,
                                  const std::string &location, memory_loan &loan)
{
    import_.repairs.frames.normals_missing++;
    loan.take(triangles.size(), vertex_bytes(streams_) + sizeof(uint32_t));
    if (triangles.size() > arrays.count)
        import_.budget.take(triangles.size() - arrays.count, vertex_bytes(streams_), location);
    arrays.gather(triangles);
    for (size_t i = 0; i < triangles.size(); i++)
        triangles[i] = (uint32_t)i;
    arrays.normal.resize(arrays.count * 3);
    lsf_flat_normals(arrays.position.data(), arrays.count / 3, arrays.normal.data());
}

void geometry_importer::compute_tangents(vertex_arrays &arrays, std::vector<uint32_t> &triangles,
                                         const lsf_material &material, const std::string &location,
                                         memory_loan &loan)
{
    const std::vector<float> &uvs =
        lsf_material_tangent_uv_set(&material) == 0 ? arrays.uv0 : arrays.uv1;
    /* Takes memory for lsf_split_mirrored, and for the largest stream while it grows. */
    loan.take(arrays.count, 1 + 2 * sizeof(uint32_t) + 4 * sizeof(float));
    if (uvs.empty()) {
        import_.repairs.frames.tangents_without_uv++;
    } else {
        uint32_t *copied;
        uint64_t copied_count;
        bool split = lsf_split_mirrored(uvs.data(), arrays.count, triangles.data(),
                                        triangles.size(), &copied, &copied_count);
        std::unique_ptr<uint32_t, decltype(&std::free)> owner(copied, std::free);
        if (!split)
            throw std::bad_alloc();
        import_.budget.take(copied_count, vertex_bytes(streams_), location);
        loan.take(copied_count, vertex_bytes(streams_) + sizeof(uint32_t));
        arrays.append_copies(copied, copied_count);
    }
    loan.take(arrays.count, SUM_BYTES);
    arrays.tangent.resize(arrays.count * 4);
    lsf_make_tangents(arrays.position.data(), arrays.normal.data(),
                      uvs.empty() ? nullptr : uvs.data(), arrays.count, triangles.data(),
                      triangles.size(), arrays.tangent.data());
}

/* --- storing --- */

void geometry_importer::append_vertices(const vertex_arrays &arrays, lsf_primitive &primitive)
{
    uint64_t first = scene_->vertices.count;
    primitive.first_vertex = first;
    primitive.vertex_count = (uint32_t)arrays.count;
    const std::vector<float> *values[LSF_STREAM_COUNT] = {
        &arrays.position, &arrays.normal, &arrays.tangent, &arrays.uv0, &arrays.uv1, &arrays.color};
    for (size_t s = 0; s < LSF_STREAM_COUNT; s++)
        if (!lsf_stream_append(&geometry_.streams[s], first, arrays.count,
                               values[s]->empty() ? nullptr : values[s]->data()))
            throw std::bad_alloc();
    scene_->vertices.count += arrays.count;
    if (scene_->vertices.count > UINT32_MAX)
        fail("MEMORY_LIMIT", "/meshes", "the scene has more than 4294967295 vertices");
}

void geometry_importer::repeat_vertices(uint64_t source, uint64_t count)
{
    uint64_t first = scene_->vertices.count;
    for (lsf_stream &stream : geometry_.streams) {
        if (!stream.present || count == 0)
            continue;
        float *out = lsf_stream_grow(&stream, first, count);
        if (!out)
            throw std::bad_alloc();
        std::copy_n(*stream.array + source * stream.width, count * stream.width, out);
    }
    scene_->vertices.count += count;
    if (scene_->vertices.count > UINT32_MAX)
        fail("MEMORY_LIMIT", "/meshes", "the scene has more than 4294967295 vertices");
}

void geometry_importer::append_indices(const std::vector<uint32_t> &triangles,
                                       lsf_primitive &primitive)
{
    if (!lsf_geometry_append_triangles(&geometry_, scene_, triangles.data(),
                                       (uint32_t)triangles.size(), &primitive))
        throw std::bad_alloc();
}

/* The accessors of a vertex's attributes; deformed vertices are shared within their mesh alone. */
geometry_importer::vertex_key geometry_importer::key_of(const tinygltf::Primitive &source,
                                                        size_t mesh) const
{
    vertex_key key = {find_attribute(source, "POSITION"),   find_attribute(source, "NORMAL"),
                      find_attribute(source, "TANGENT"),    find_attribute(source, "TEXCOORD_0"),
                      find_attribute(source, "TEXCOORD_1"), find_attribute(source, "COLOR_0")};
    if (!has_shape(source, skinned_[mesh]))
        return key;
    key.push_back((int)mesh);
    for (const auto &attribute : source.attributes)
        if (attribute.first.rfind("JOINTS_", 0) == 0 || attribute.first.rfind("WEIGHTS_", 0) == 0)
            key.push_back(attribute.second);
    for (const auto &target : source.targets) {
        key.push_back(-1);
        for (const char *name : {"POSITION", "NORMAL", "TANGENT"}) {
            auto found = target.find(name);
            key.push_back(found == target.end() ? -1 : found->second);
        }
    }
    return key;
}

/* Vertices and indices as in the file: primitives that name the same accessors share them. */
void geometry_importer::add_shared(const tinygltf::Primitive &source, size_t mesh,
                                   const std::string &location, lsf_primitive &primitive)
{
    vertex_key key = key_of(source, mesh);
    auto vertices = known_vertices_.find(key);
    bool known = vertices != known_vertices_.end();
    memory_loan loan(import_.budget, location);
    vertex_arrays arrays;
    if (known) {
        primitive.first_vertex = vertices->second.first_vertex;
        primitive.vertex_count = vertices->second.vertex_count;
    } else {
        arrays = read_vertices(import_, source, streams_, location, loan);
        primitive.vertex_count = (uint32_t)arrays.count;
        primitive.first_vertex = scene_->vertices.count;
    }
    index_key indices_key = {(int)primitive.first_vertex, source.indices, source.mode};
    auto indices = known ? known_indices_.find(indices_key) : known_indices_.end();
    if (indices != known_indices_.end()) {
        primitive.first_index = indices->second.first_index;
        primitive.index_count = indices->second.index_count;
        std::copy_n(indices->second.bounds_min, 3, primitive.bounds_min);
        std::copy_n(indices->second.bounds_max, 3, primitive.bounds_max);
        return;
    }
    std::vector<uint32_t> triangles =
        read_triangles(import_, source, primitive.vertex_count, location, loan);
    if (!known) {
        repair(arrays, triangles, source, loan);
        append_vertices(arrays, primitive);
        add_shape(source, mesh, false, arrays, location, primitive);
        known_vertices_[key] = primitive;
    }
    append_indices(triangles, primitive);
    known_indices_[indices_key] = primitive;
}

/* Bounds of vertices that were just appended. */
void geometry_importer::add_shape(const tinygltf::Primitive &source, size_t mesh, bool flat,
                                  const vertex_arrays &arrays, const std::string &location,
                                  const lsf_primitive &primitive)
{
    if (has_shape(source, skinned_[mesh]))
        shape_of_[primitive.first_vertex] =
            shape_import(import_, source, skinned_[mesh], flat, arrays, location);
}

void geometry_importer::add_computed(const tinygltf::Primitive &source, size_t mesh,
                                     const std::string &location, bool flat, bool tangents,
                                     lsf_primitive &primitive)
{
    memory_loan loan(import_.budget, location);
    vertex_arrays arrays = read_vertices(import_, source, streams_, location, loan);
    std::vector<uint32_t> triangles = read_triangles(import_, source, arrays.count, location, loan);
    if (flat)
        make_flat(arrays, triangles, location, loan);
    repair(arrays, triangles, source, loan);
    if (tangents)
        compute_tangents(arrays, triangles, material_of(import_, source), location, loan);
    append_vertices(arrays, primitive);
    add_shape(source, mesh, flat, arrays, location, primitive);
    append_indices(triangles, primitive);
}

void geometry_importer::add_primitive(const tinygltf::Primitive &source, size_t mesh,
                                      const std::string &location)
{
    if (!mode_is_triangles(source.mode)) {
        count_left_out(source);
        return;
    }
    if (find_attribute(source, "POSITION") < 0) {
        import_.repairs.no_position++;
        return;
    }
    const lsf_material &material = material_of(import_, source);
    count_ignored(source, material);
    import_.repairs.joints_missing += skinned_[mesh] && find_attribute(source, "JOINTS_0") < 0;
    lsf_primitive primitive = {};
    primitive.deformer = LSF_NONE;
    primitive.material = (uint32_t)(&material - scene_->materials);
    bool flat = find_attribute(source, "NORMAL") < 0;
    bool tangents = material.has_tangents && (flat || find_attribute(source, "TANGENT") < 0);
    if (flat || tangents)
        add_computed(source, mesh, location, flat, tangents, primitive);
    else
        add_shared(source, mesh, location, primitive);
    primitives_.push_back(primitive);
}

void geometry_importer::add_mesh(size_t index)
{
    const tinygltf::Mesh &source = import_.model.meshes[index];
    lsf_mesh &mesh = scene_->meshes[index];
    mesh.name = copy_text(source.name);
    scene_->mesh_count++;
    mesh.first_primitive = (uint32_t)primitives_.size();
    if (import_.mesh_used[index])
        for (size_t i = 0; i < source.primitives.size(); i++)
            add_primitive(source.primitives[i], index,
                          location_of("meshes", index) + "/primitives/" + std::to_string(i));
    mesh.primitive_count = (uint32_t)(primitives_.size() - mesh.first_primitive);
}

/* --- meshes that nodes deform --- */

void geometry_importer::find_uses()
{
    skinned_.assign(import_.model.meshes.size(), false);
    unskinned_.assign(import_.model.meshes.size(), false);
    for (uint32_t i = 0; i < scene_->node_count; i++) {
        if (scene_->nodes[i].mesh == LSF_NONE)
            continue;
        bool skin = import_.model.nodes[import_.source_of[i]].skin >= 0;
        (skin ? skinned_ : unskinned_)[scene_->nodes[i].mesh] = true;
    }
}

/* The node's own copy of the primitive's vertices: those that were read if no other node deforms
 * them, else copies. */
uint32_t geometry_importer::deformer_of(uint32_t node, uint32_t index, uint32_t shape,
                                        uint32_t skin)
{
    const lsf_primitive &primitive = primitives_[index];
    auto key = std::make_pair(node, primitive.first_vertex);
    auto known = known_deformers_.find(key);
    if (known != known_deformers_.end())
        return known->second;
    std::string location = location_of("nodes", import_.source_of[node]);
    if (skin != LSF_NONE)
        check_joints(import_, shape, skin, location);
    bool as_read = scene_->shapes[shape].target_count == 0 && unskinned_[scene_->nodes[node].mesh];
    uint64_t first = primitive.first_vertex;
    if (as_read || !taken_.insert(first).second) {
        import_.budget.take(primitive.vertex_count, vertex_bytes(streams_), location);
        first = scene_->vertices.count;
        repeat_vertices(primitive.first_vertex, primitive.vertex_count);
    }
    import_.budget.take(1, sizeof(lsf_deformer) + sizeof(lsf_primitive), location);
    deformers_.push_back({shape, node, skin, first});
    return known_deformers_[key] = (uint32_t)deformers_.size() - 1;
}

/* The primitive as the node shows it: another one where the node deforms it. */
uint32_t geometry_importer::place(uint32_t node, uint32_t index)
{
    auto found = shape_of_.find(primitives_[index].first_vertex);
    if (found == shape_of_.end())
        return index;
    const lsf_shape &shape = scene_->shapes[found->second];
    int skin = import_.model.nodes[import_.source_of[node]].skin;
    bool skinned = skin >= 0 && shape.influences > 0;
    if (!skinned && shape.target_count == 0)
        return index;
    uint32_t deformer =
        deformer_of(node, index, found->second, skinned ? skin_import(import_, skin) : LSF_NONE);
    lsf_primitive placed = primitives_[index];
    placed.deformer = deformer;
    uint64_t from = placed.first_vertex, to = deformers_[deformer].first_vertex;
    if (from == to) {
        primitives_[index] = placed;
        return index;
    }
    std::string location = location_of("nodes", import_.source_of[node]);
    import_.budget.take(placed.index_count, sizeof(uint32_t), location);
    uint32_t *indices = placed.index_count == 0
                            ? nullptr
                            : lsf_geometry_grow_indices(&geometry_, scene_, placed.index_count);
    if (!indices && placed.index_count > 0)
        throw std::bad_alloc();
    for (uint32_t i = 0; i < placed.index_count; i++)
        indices[i] = (uint32_t)(scene_->indices[placed.first_index + i] - from + to);
    placed.first_vertex = to;
    placed.first_index = scene_->index_count - placed.index_count;
    import_.budget.take(1, sizeof(lsf_primitive), location);
    primitives_.push_back(placed);
    return (uint32_t)primitives_.size() - 1;
}

void geometry_importer::finish()
{
    uint64_t count = 0;
    for (uint32_t i = 0; i < scene_->node_count; i++)
        if (scene_->nodes[i].mesh != LSF_NONE)
            count += scene_->meshes[scene_->nodes[i].mesh].primitive_count;
    import_.budget.take(count, sizeof(lsf_instance), "/nodes");
    if (count >= UINT32_MAX)
        fail("MEMORY_LIMIT", "/nodes", "%" PRIu64 " instances are too many", count);
    scene_->instances = static_cast<lsf_instance *>(allocate(count, sizeof(lsf_instance)));
    for (uint32_t i = 0; i < scene_->node_count; i++) {
        if (scene_->nodes[i].mesh == LSF_NONE)
            continue;
        const lsf_mesh &mesh = scene_->meshes[scene_->nodes[i].mesh];
        for (uint32_t p = 0; p < mesh.primitive_count; p++)
            scene_->instances[scene_->instance_count++] = {i, place(i, mesh.first_primitive + p)};
    }
    scene_->primitives = copy_array(primitives_);
    scene_->primitive_count = (uint32_t)primitives_.size();
    scene_->deformers = copy_array(deformers_);
    scene_->deformer_count = (uint32_t)deformers_.size();
}

void gltf_geometry_import(gltf_import &import)
{
    weights_import(import);
    geometry_importer importer(import, choose_streams(import));
    import.scene->meshes =
        static_cast<lsf_mesh *>(allocate(import.model.meshes.size(), sizeof(lsf_mesh)));
    for (size_t i = 0; i < import.model.meshes.size(); i++)
        importer.add_mesh(i);
    importer.finish();
}

} // namespace lsf
