// A cone tracer of one's own: light that voxels and the environment send out, gathered by cones through a pyramid,
// beside the direct light of the scene's first light.
//
//     lightsheaf sandbox cone_tracer.frag scene.gltf -o cones.png
//
// After C. Crassin, F. Neyret, M. Sainz, S. Green and E. Eisemann, "Interactive Indirect Illumination Using Voxel
// Cone Tracing", 2011.

// @output radiance
// @define voxel.resolution=96

uniform float spread = 1.1; // @slider 0.3 2    a cone's diameter by its length
uniform float bounce = 1.0; // @slider 0 2      gain of what cones gather

vec3 trace_cone(vec3 start, vec3 direction, float cell)
{
    vec3 light = vec3(0.0);
    float clear = 1.0;
    for (float t = 1.5 * cell; t < 3.0 && clear > 0.02;) {
        float width = max(cell, spread * t);
        vec4 seen = lsf_voxel_radiance(lsf_voxel_from(start + t * direction), direction, log2(width / cell));
        light += clear * seen.rgb;
        clear *= 1.0 - seen.a;
        t += 0.7 * width;
    }
    return light + clear * lsf_environment(direction);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(lsf_environment(lsf_camera_direction(fragCoord)), 1.0);
    if (!lsf_seen(fragCoord))
        return;
    surface s = lsf_surface(fragCoord);
    vec3 position = lsf_position(fragCoord), n = s.normal;
    float cell = lsf_voxel_to(vec3(1.0)).x - lsf_voxel_to(vec3(0.0)).x;

    // Five cones at 60 degrees from each other about one along the normal, weighed by the cosine.
    vec3 t = normalize(abs(n.x) > 0.7 ? cross(n, vec3(0.0, 1.0, 0.0)) : cross(n, vec3(1.0, 0.0, 0.0)));
    vec3 b = cross(n, t), start = lsf_voxel_leave(position, s.geometric_normal);
    vec3 gathered = 0.25 * trace_cone(start, n, cell);
    for (int i = 0; i < 5; i++) {
        float angle = 6.2831853 * (float(i) + 0.5) / 5.0;
        vec3 direction = 0.5 * n + 0.866 * (cos(angle) * t + sin(angle) * b);
        gathered += 0.15 * trace_cone(start, direction, cell);
    }

    vec3 to_light, direct = lsf_light(0, position, to_light);
    direct *= max(dot(n, to_light), 0.0) * lsf_visibility(position, s.geometric_normal);
    vec3 diffuse = s.base_color * (1.0 - s.metallic);
    fragColor.rgb = lsf_emission(fragCoord) + diffuse * (direct / 3.14159265 + bounce * gathered);
}
