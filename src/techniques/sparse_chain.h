/* The passes between what is seen and what gathers indirect light of it, for every technique that
 * does: the points at which light is gathered, and the way back to the picture's pixels. */
#ifndef LSF_TECHNIQUES_SPARSE_CHAIN_H
#define LSF_TECHNIQUES_SPARSE_CHAIN_H

#include "passes/blur.h"
#include "passes/sparse.h"
#include "techniques/technique.h"

typedef struct lsf_sparse_chain {
    lsf_sparse sparse;
    lsf_blur blur;
} lsf_sparse_chain;

/* Whether each pixel's light is its own and stays as it is found. */
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
/* What the iteration's points see, of what the picture's pixels see; valid until the next call. */
const lsf_surface_maps *lsf_sparse_chain_split(lsf_sparse_chain *chain,
                                               const lsf_iteration *iteration,
                                               const lsf_surface_maps *seen);
/* Light of every pixel, of light that was gathered at these points. */
lsf_split_light lsf_sparse_chain_finish(lsf_sparse_chain *chain, const lsf_iteration *iteration,
                                        const lsf_surface_maps *seen,
                                        const lsf_split_light *gathered);
void lsf_sparse_chain_destroy(lsf_sparse_chain *chain);
/* As lsf_technique's report, of what goes before the gathering of light and of what follows it. */
uint32_t lsf_sparse_chain_report_split(lsf_sparse_chain *chain, lsf_pass_report *reports);
uint32_t lsf_sparse_chain_report_finish(lsf_sparse_chain *chain, lsf_pass_report *reports);

#endif
