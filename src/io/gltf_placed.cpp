#include "io/gltf_import.hpp"

#include <cmath>

/* Cameras and KHR_lights_punctual: those that nodes of the scene carry. */

namespace lsf
{

static const double HALF_PI = 1.57079632679489661923;

static lsf_camera make_camera(const tinygltf::Camera &source, const std::string &location)
{
    lsf_camera camera = {};
    camera.orthographic = source.type == "orthographic";
    camera.fov_y = (float)HALF_PI / 2.0f;
    camera.x_magnification = camera.y_magnification = 1.0f;
    double near_plane, far_plane;
    if (camera.orthographic) {
        /* A negative magnification would mirror the picture; the specification forbids it. */
        camera.x_magnification = std::fabs((float)source.orthographic.xmag);
        camera.y_magnification = std::fabs((float)source.orthographic.ymag);
        if (camera.x_magnification == 0.0f || camera.y_magnification == 0.0f)
            fail("VALUE_NOT_IN_RANGE", location + "/orthographic",
                 "xmag and ymag must not be zero");
        near_plane = source.orthographic.znear;
        far_plane = source.orthographic.zfar;
    } else {
        camera.fov_y = (float)source.perspective.yfov;
        near_plane = source.perspective.znear;
        far_plane = source.perspective.zfar; /* 0: infinite */
    }
    camera.near_plane = (float)near_plane;
    if (far_plane > 0.0 && far_plane <= near_plane)
        fail("CAMERA_ZFAR_LEQUAL_ZNEAR", location, "zfar %g is not beyond znear %g", far_plane,
             near_plane);
    return camera;
}

static void import_cameras(gltf_import &import)
{
    std::vector<lsf_camera> cameras;
    std::vector<std::string> names;
    for (size_t i = 0; i < import.model.nodes.size(); i++) {
        const tinygltf::Node &node = import.model.nodes[i];
        if (node.camera < 0 || import.node_of[i] == LSF_NONE)
            continue;
        const tinygltf::Camera &source = import.model.cameras[(size_t)node.camera];
        lsf_camera camera = make_camera(source, location_of("cameras", (size_t)node.camera));
        camera.node = import.node_of[i];
        import.scene->nodes[camera.node].camera = (uint32_t)cameras.size();
        import.camera_source.push_back((size_t)node.camera);
        cameras.push_back(camera);
        const std::string &name = source.name.empty() ? node.name : source.name;
        import.budget.take(2, name.size(), location_of("nodes", i)); /* in both lists */
        names.push_back(name);
    }
    import.scene->cameras = copy_array(cameras);
    for (const std::string &name : names)
        import.scene->cameras[import.scene->camera_count++].name = copy_text(name);
}

static lsf_light make_light(const tinygltf::Light &source, const std::string &location)
{
    lsf_light light = {};
    light.type = source.type == "point"  ? LSF_LIGHT_POINT
                 : source.type == "spot" ? LSF_LIGHT_SPOT
                                         : LSF_LIGHT_DIRECTIONAL;
    for (size_t c = 0; c < 3; c++) {
        double color = source.color.empty() ? 1.0 : source.color[c];
        light.color[c] = (float)color;
        light.intensity[c] = (float)(color * source.intensity);
        if (!std::isfinite(light.intensity[c]))
            fail("VALUE_NOT_IN_RANGE", location, "color times intensity is too large for a float");
    }
    light.strength = (float)source.intensity;
    light.range = source.range > 0.0 ? (float)source.range : INFINITY;
    if (light.type == LSF_LIGHT_SPOT) {
        double inner = source.spot.innerConeAngle, outer = source.spot.outerConeAngle;
        /* pi/2 rounded to a float lies a little beyond pi/2. */
        if (!(inner < outer) || outer > HALF_PI + 1e-6)
            fail("KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES", location + "/spot",
                 "innerConeAngle %g and outerConeAngle %g must be 0 <= inner < outer <= pi/2",
                 inner, outer);
        light.inner_cone = (float)inner;
        light.outer_cone = (float)std::min(outer, HALF_PI);
    }
    return light;
}

static void import_lights(gltf_import &import)
{
    std::vector<lsf_light> lights;
    std::vector<std::string> names;
    std::vector<uint32_t> &light_of = import.light_of;
    light_of.assign(import.model.lights.size(), LSF_NONE);
    for (size_t i = 0; i < import.model.nodes.size(); i++) {
        const tinygltf::Node &node = import.model.nodes[i];
        auto extension = node.extensions.find("KHR_lights_punctual");
        if (extension == node.extensions.end() || import.node_of[i] == LSF_NONE ||
            import.never_seen[import.node_of[i]])
            continue;
        size_t index = (size_t)extension->second.Get("light").GetNumberAsInt();
        if (light_of[index] == LSF_NONE) {
            const tinygltf::Light &source = import.model.lights[index];
            light_of[index] = (uint32_t)lights.size();
            lights.push_back(
                make_light(source, location_of("extensions/KHR_lights_punctual/lights", index)));
            names.push_back(source.name.empty() ? node.name : source.name);
        }
        import.scene->nodes[import.node_of[i]].light = light_of[index];
    }
    import.scene->lights = copy_array(lights);
    for (const std::string &name : names)
        import.scene->lights[import.scene->light_count++].name = copy_text(name);
}

void gltf_placed_import(gltf_import &import)
{
    import_cameras(import);
    import_lights(import);
}

} // namespace lsf
