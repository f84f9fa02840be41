/* Preloaded: makes the allocation of number FAIL_AT, from 0, fail; without it, tells how many there
 * were. */
#include <errno.h>
#include <stdatomic.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

/* glibc's own names for its functions. */
void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);

#define SEEN __attribute__((visibility("default")))

static atomic_long allocations;

static int fails(void)
{
    static const char *wanted;
    if (!wanted)
        wanted = getenv("FAIL_AT") ? getenv("FAIL_AT") : "";
    if (atomic_fetch_add(&allocations, 1) != (*wanted ? atol(wanted) : -1))
        return 0;
    errno = ENOMEM;
    return 1;
}

SEEN void *malloc(size_t size)
{
    return fails() ? NULL : __libc_malloc(size);
}

SEEN void *calloc(size_t count, size_t size)
{
    return fails() ? NULL : __libc_calloc(count, size);
}

SEEN void *realloc(void *block, size_t size)
{
    return fails() ? NULL : __libc_realloc(block, size);
}

__attribute__((destructor)) static void tell(void)
{
    if (!getenv("FAIL_AT"))
        fprintf(stderr, "allocations: %ld\n", allocations);
}
