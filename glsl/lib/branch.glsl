/* BRANCH(condition) { } is an `if` whose body is skipped where no invocation takes it. Software GL executes the body of
 * an `if` in any case, if need be for no lane; only loops end with their last lane. For expensive code that is seldom
 * needed: compilers optimise across an `if` better. `break` and `continue` in the body would leave this loop. */
#ifndef LSF_LIB_BRANCH
#define LSF_LIB_BRANCH

#define BRANCH(condition) for (bool branch_taken = (condition); branch_taken; branch_taken = false)

#endif
