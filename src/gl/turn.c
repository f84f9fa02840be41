/* Turns of contexts that render in software. Mesa's llvmpipe looks through the work of all contexts
 * of a screen without a lock: threads with a context each crashed it now and then (Mesa 22.3.6).
 * Turns cost little, because its rasteriser uses all cores for one context. */
#include <pthread.h>

#include "gl/context.h"

static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
static pthread_cond_t ended = PTHREAD_COND_INITIALIZER;
static uint64_t taken, over; /* numbers of turns */
static _Thread_local uint32_t depth;

void lsf_turn_begin(void)
{
    if (depth++ > 0)
        return;
    pthread_mutex_lock(&mutex);
    for (uint64_t mine = taken++; mine != over;)
        pthread_cond_wait(&ended, &mutex);
    pthread_mutex_unlock(&mutex);
}

void lsf_turn_end(void)
{
    if (--depth > 0)
        return;
    pthread_mutex_lock(&mutex);
    over++;
    pthread_cond_broadcast(&ended);
    pthread_mutex_unlock(&mutex);
}
