// How many surfaces lie behind each other: the lengths of a ray-bundle's lists.
//
//     lightsheaf sandbox depth_complexity.frag scene.gltf -o depth.png
//
// The bundle looks the way the camera does. Each pixel shows how many surfaces lie on the bundle's ray through the
// point that it sees, before it and behind it; the bar below counts from 1 to 16.

// @define bundle.resolution=512

// From black by violet, red and orange to pale yellow.
vec3 hue(int count)
{
    float t = clamp(float(count) / 16.0, 0.0, 1.0);
    return clamp(vec3(2.2 * t - 0.1, 1.6 * t * t, 0.45 * sin(4.0 * t) + 1.6 * pow(t, 4.0)), 0.0, 1.0);
}

void mainImage(out vec4 fragColor, in vec2 fragCoord)
{
    fragColor = vec4(0.0, 0.0, 0.0, 1.0);
    if (fragCoord.y < 12.0) {
        fragColor.rgb = hue(1 + int(16.0 * fragCoord.x / iResolution.x));
        return;
    }
    if (!lsf_seen(fragCoord))
        return;
    ivec2 texel = ivec2(floor(lsf_bundle_texel(lsf_position(fragCoord))));
    float shade = 0.75 + 0.25 * lsf_normal(fragCoord).y;
    fragColor.rgb = shade * hue(lsf_bundle_count(texel));
}
