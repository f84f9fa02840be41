/* Virtual point lights on emissive surfaces: one of n points drawn with the density p by area stands for the area
 * 1 / (n p). */
#include "lib/emitter.glsl"
#include "lib/vpl_cloud.glsl"

void main()
{
    uint i = gl_GlobalInvocationID.x;
    if (i >= cloud_shape.x)
        return;
    lsf_emitter_point_data point = emitter_points[i];
    vec3 intensity = point.radiance.rgb / (point.normal.w * float(cloud_shape.x));
    cloud[i] = lsf_vpl_record(point.position.xyz, octahedral_encode(point.normal.xyz), intensity, 0u);
}
