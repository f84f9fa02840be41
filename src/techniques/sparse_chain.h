/* The passes between the G-buffer and the gathering of indirect light, for every technique that
 * gathers it: the points at which light is gathered, and the upsampling to the picture's pixels. */
#ifndef LSF_TECHNIQUES_SPARSE_CHAIN_H
#define LSF_TECHNIQUES_SPARSE_CHAIN_H

#include "passes/blur.h"
#include "passes/sparse.h"
#include "techniques/technique.h"

typedef struct lsf_sparse_chain {
    lsf_sparse sparse;
    lsf_blur blur;
} lsf_sparse_chain;

/* Whether each pixel's light is its own and is not filtered. */
bool lsf_sparse_chain_is_plain(const lsf_plan *plan, const lsf_pass_params *params,
                               uint32_t interleave);
/* `interleave`: side of the pattern in which points take different samples, 1: none. Need the
 * G-buffer's plan; the passes that gather light are planned between both. */
void lsf_sparse_chain_plan_split(lsf_plan *plan, const lsf_pass_params *params,
                                 uint32_t interleave);
void lsf_sparse_chain_plan_finish(lsf_plan *plan, const lsf_pass_params *params,
                                  uint32_t interleave);
bool lsf_sparse_chain_create(lsf_sparse_chain *chain, lsf_context *context, const lsf_plan *plan,
                             const lsf_pass_params *params, lsf_error *error);
/* The surfaces at the iteration's points, taken from the picture's pixels; valid until the next
 * call. */
const lsf_surface_maps *lsf_sparse_chain_split(lsf_sparse_chain *chain,
                                               const lsf_iteration *iteration,
                                               const lsf_surface_maps *seen);
/* Light of every pixel, from light that was gathered at these points. */
lsf_split_light lsf_sparse_chain_finish(lsf_sparse_chain *chain, const lsf_iteration *iteration,
                                        const lsf_surface_maps *seen,
                                        const lsf_split_light *gathered);
void lsf_sparse_chain_destroy(lsf_sparse_chain *chain);
/* Report as lsf_technique's report does: the passes before the gathering of light, and those
 * after it. */
uint32_t lsf_sparse_chain_report_split(lsf_sparse_chain *chain, lsf_pass_report *reports);
uint32_t lsf_sparse_chain_report_finish(lsf_sparse_chain *chain, lsf_pass_report *reports);

#endif
