/* Factor by which glossy lobes have to be wider where a filter cannot pool a whole pattern of pixels. */
#ifndef LSF_LIB_POOLING
#define LSF_LIB_POOLING

/* Suppression spreads a lobe over `kernel` [sr], as if all pixels of a pattern of `side` x `side` pooled their
 * light: alpha^2 = kernel F / 4 pi (lib/brdf.glsl, kernel_alpha). They can where normals differ by less than
 * alpha. Over a fraction t of the pattern's pixels normals differ by turn sqrt(t), and that fraction has t of the
 * pattern's samples, so that
 *
 *   turn^2 t <= max(own alpha^2, alpha^2 / t)      t = max(own alpha^2 / turn^2, alpha / turn), at most 1.
 *
 * Returns 1 / t, the factor on the kernel. `normal_change`: change of the normal over the pattern [radians]. */
float pooling_spread(float kernel, float reflects, float own_alpha2, float normal_change, float side)
{
    float alpha = sqrt(kernel * reflects * (1.0 / 12.566371));
    return clamp(min(normal_change / max(alpha, 1e-10), normal_change * normal_change / max(own_alpha2, 1e-20)), 1.0, side * side);
}

#endif
