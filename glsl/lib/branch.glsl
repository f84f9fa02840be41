/* A branch that costs nothing where no invocation takes it. Software GL executes what stands behind `if` in any case,
 * for no lane if need be; only loops end with their last lane. It pays for what is dear and seldom needed. `break` and
 * `continue` behind it would leave this loop. */
#ifndef LSF_LIB_BRANCH
#define LSF_LIB_BRANCH

#define BRANCH(condition) for (bool branch_taken = (condition); branch_taken; branch_taken = false)

#endif
