#include "pool.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

typedef struct helper {
    pool *of;
    uint32_t index;
    pthread_t thread;
} helper;

struct pool {
    pthread_mutex_t lock;
    pthread_cond_t begin, done;
    pool_work *work;
    void *context;
    uint64_t round; /* helpers work once a round */
    uint32_t busy;  /* helpers of this round not yet done */
    bool is_closing;
    uint32_t helper_count; /* that run */
    helper helpers[];
};

static void *help(void *argument)
{
    const helper *self = argument;
    pool *of = self->of;
    uint64_t seen = 0;
    pthread_mutex_lock(&of->lock);
    for (;;) {
        while (of->round == seen && !of->is_closing)
            pthread_cond_wait(&of->begin, &of->lock);
        if (of->is_closing)
            break;
        seen = of->round;
        pool_work *work = of->work;
        void *context = of->context;
        pthread_mutex_unlock(&of->lock);
        work(context, self->index);
        pthread_mutex_lock(&of->lock);
        if (--of->busy == 0)
            pthread_cond_signal(&of->done);
    }
    pthread_mutex_unlock(&of->lock);
    return NULL;
}

fm_status pool_create(pool **made, uint32_t threads, fm_error *err)
{
    *made = NULL;
    pool *of = calloc(1, sizeof *of + threads * sizeof of->helpers[0]);
    if (of == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u threads", threads);
    pthread_mutex_init(&of->lock, NULL);
    pthread_cond_init(&of->begin, NULL);
    pthread_cond_init(&of->done, NULL);
    for (uint32_t i = 1; i < threads; i++) {
        helper *self = &of->helpers[of->helper_count];
        *self = (helper){ .of = of, .index = i };
        if (pthread_create(&self->thread, NULL, help, self) != 0) {
            pool_destroy(of);
            return fm_fail(err, FM_NO_MEMORY, "thread %u cannot be started", i);
        }
        of->helper_count++;
    }
    *made = of;
    return FM_OK;
}

void pool_destroy(pool *of)
{
    if (of == NULL)
        return;
    pthread_mutex_lock(&of->lock);
    of->is_closing = true;
    pthread_cond_broadcast(&of->begin);
    pthread_mutex_unlock(&of->lock);
    for (uint32_t i = 0; i < of->helper_count; i++)
        pthread_join(of->helpers[i].thread, NULL);
    pthread_cond_destroy(&of->done);
    pthread_cond_destroy(&of->begin);
    pthread_mutex_destroy(&of->lock);
    free(of);
}

void pool_run(pool *of, pool_work *work, void *context)
{
    pthread_mutex_lock(&of->lock);
    of->work = work;
    of->context = context;
    of->busy = of->helper_count;
    of->round++;
    pthread_cond_broadcast(&of->begin);
    pthread_mutex_unlock(&of->lock);
    work(context, 0);
    pthread_mutex_lock(&of->lock);
    while (of->busy > 0)
        pthread_cond_wait(&of->done, &of->lock);
    pthread_mutex_unlock(&of->lock);
}
