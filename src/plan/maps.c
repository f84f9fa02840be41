#include "plan/maps.h"

void lsf_surface_maps_bind(const lsf_surface_maps *maps)
{
    lsf_bind_texture(0, maps->depth);
    lsf_bind_texture(1, maps->surface);
    lsf_bind_texture(2, maps->gloss);
}
