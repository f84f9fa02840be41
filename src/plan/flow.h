/* What passes read and fill, by the names of resources. */
#ifndef LSF_PLAN_FLOW_H
#define LSF_PLAN_FLOW_H

#include "plan/plan.h"

/* Whether the pass reads, or fills, that resource of the plan. */
bool lsf_plan_pass_reads(const lsf_plan *plan, const lsf_plan_pass *pass, const char *resource);
bool lsf_plan_pass_fills(const lsf_plan_pass *pass, const char *resource);

/* Resources of a stem ("gbuffer" of "gbuffer.depth") are grouped: `first` is the number of the
 * first of them. */
size_t lsf_plan_stem_length(const char *resource);
bool lsf_plan_same_stem(const char *a, const char *b);
bool lsf_plan_starts_stem(const lsf_plan *plan, uint64_t resource);

/* Resources of a kind differ by a number at their end: "ray_bundle.keys" of "ray_bundle.keys_3". */
size_t lsf_plan_kind_length(const char *resource);
bool lsf_plan_same_kind(const char *a, const char *b);
bool lsf_plan_starts_kind(const lsf_plan *plan, uint64_t resource);

typedef enum lsf_plan_flow {
    LSF_PLAN_NO_FLOW,
    LSF_PLAN_READS, /* and does not fill */
    LSF_PLAN_FILLS,
} lsf_plan_flow;

lsf_plan_flow lsf_plan_flow_of(const lsf_plan *plan, const lsf_plan_pass *pass, uint64_t first);

#endif
