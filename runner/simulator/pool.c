#include "pool.h"

#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>

typedef struct helper {
    pool *pool;
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
    const helper *member = argument;
    pool *self = member->pool;
    uint64_t seen = 0;
    pthread_mutex_lock(&self->lock);
    for (;;) {
        while (self->round == seen && !self->is_closing)
            pthread_cond_wait(&self->begin, &self->lock);
        if (self->is_closing)
            break;
        seen = self->round;
        pool_work *work = self->work;
        void *context = self->context;
        pthread_mutex_unlock(&self->lock);
        work(context, member->index);
        pthread_mutex_lock(&self->lock);
        if (--self->busy == 0)
            pthread_cond_signal(&self->done);
    }
    pthread_mutex_unlock(&self->lock);
    return NULL;
}

fm_status pool_create(pool **made, uint32_t threads, fm_error *err)
{
    *made = NULL;
    pool *self = calloc(1, sizeof *self + threads * sizeof self->helpers[0]);
    if (self == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u threads", threads);
    pthread_mutex_init(&self->lock, NULL);
    pthread_cond_init(&self->begin, NULL);
    pthread_cond_init(&self->done, NULL);
    for (uint32_t i = 1; i < threads; i++) {
        helper *member = &self->helpers[self->helper_count];
        *member = (helper){ .pool = self, .index = i };
        if (pthread_create(&member->thread, NULL, help, member) != 0) {
            pool_destroy(self);
            return fm_fail(err, FM_NO_MEMORY, "thread %u cannot be started", i);
        }
        self->helper_count++;
    }
    *made = self;
    return FM_OK;
}

void pool_destroy(pool *self)
{
    if (self == NULL)
        return;
    pthread_mutex_lock(&self->lock);
    self->is_closing = true;
    pthread_cond_broadcast(&self->begin);
    pthread_mutex_unlock(&self->lock);
    for (uint32_t i = 0; i < self->helper_count; i++)
        pthread_join(self->helpers[i].thread, NULL);
    pthread_cond_destroy(&self->done);
    pthread_cond_destroy(&self->begin);
    pthread_mutex_destroy(&self->lock);
    free(self);
}

void pool_run(pool *self, pool_work *work, void *context)
{
    pthread_mutex_lock(&self->lock);
    self->work = work;
    self->context = context;
    self->busy = self->helper_count;
    self->round++;
    pthread_cond_broadcast(&self->begin);
    pthread_mutex_unlock(&self->lock);
    work(context, 0);
    pthread_mutex_lock(&self->lock);
    while (self->busy > 0)
        pthread_cond_wait(&self->done, &self->lock);
    pthread_mutex_unlock(&self->lock);
}
