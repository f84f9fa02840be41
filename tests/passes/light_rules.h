/* Rules that the light of every technique keeps, and scenes whose light has a closed form. */
#ifndef LSF_TESTS_PASSES_LIGHT_RULES_H
#define LSF_TESTS_PASSES_LIGHT_RULES_H

#include "render_gl.h"

/* A closed box to be seen from inside, whose walls emit 1 and reflect `albedo`. */
lsf_scene *furnace_scene(float albedo);
/* The radiance in it after so many bounces: emission as seen, direct light of the walls, bounces.
 */
double furnace_radiance(float albedo, uint32_t bounces);

/* A white sphere under a uniform environment of radiance 0.5, in which it cannot be seen. */
lsf_scene *white_sphere_scene(int subdivisions);

/* A sphere of radius 1 to be seen from inside, with a light of intensity 3 at its centre. */
lsf_scene *lit_sphere_scene(float albedo);
/* The radiance of its wall. A light I in the middle of a sphere of radius R gives every point the
 * irradiance I / R^2 and, after N bounces, the radiance rho / pi I / R^2 (1 + rho + ... + rho^N).
 */
double lit_sphere_radiance(float albedo, uint32_t bounces);

/* Two walls of a room with a glossy anisotropic box, a lamp and a light, both times `intensity`. */
lsf_scene *lit_room_scene(float intensity);

/* Prints the mean of the picture's G and asserts that no channel is off by more than `allowed` of
 * what is expected. */
void assert_mean(const char *what, const lsf_image *image, double expected, double allowed);

/* Light of lit_room_scene times 2^k gives the picture times 2^k, to the bit. */
void assert_light_scales(lsf_render_params params);

/* Makes each GL allocation of a renderer for pictures of 16 x 16 fail in turn: the error is clear,
 * and nothing stays allocated. Then a renderer takes as much as its plan says. At least `least`
 * allocations have to fail. */
void assert_every_allocation_may_fail(const lsf_scene *scene, lsf_render_params params,
                                      uint32_t least);

#endif
