/* Properties that animations change beside nodes and weights, by the names that glTF's object
 * model gives them (KHR_animation_pointer). */
#ifndef LSF_SCENE_PROPERTY_H
#define LSF_SCENE_PROPERTY_H

#include "scene/scene.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct lsf_property {
    lsf_kind of;
    const char *name;  /* the part of the pointer behind the index; for a texture's transform,
                        * behind KHR_texture_transform */
    size_t offset;     /* in lsf_material, lsf_texture_slot, lsf_light, lsf_camera */
    uint32_t width;    /* floats */
    float least, most; /* range that it is clamped to */
    bool surface;      /* a property that diffuse materials do not have */
} lsf_property;

/* Finds a property by the part of the pointer behind the index, as in
 * "/materials/0/alphaCutoff"; `slot` gets the use of its texture, or LSF_NONE. NULL: it cannot
 * be animated. */
const lsf_property *lsf_property_find(lsf_kind of, const char *name, uint32_t *slot);

/* The visibility of a node; it has no offset. */
extern const lsf_property *const lsf_property_visible;

/* Sets it to values that are clamped to its range, and what follows from it, in an lsf_material,
 * lsf_light or lsf_camera. */
void lsf_property_set(const lsf_animated_value *animated, const double *values, void *thing);

#ifdef __cplusplus
}
#endif
#endif
