/* A plan in parts, each for a machine of its own: `run --shard 2/16`.
 *
 * Cases that are compared with one another stay together: those of one scene, with all its keys but
 * n where n = r k, one device and one feed. So ratios, pairs and charts of a workload are always of
 * one machine. Groups are dealt to the shards by the guess of plan/cost.h, the longest first, each
 * to the shard that has the least; nothing hangs on chance, so each machine parts the plan alike.
 *
 * Reference cases are measured in every shard, beside its own: of each device and feed the one of
 * the reference method that takes least. By them whoever merges the shards sees whether the
 * machines agree in what the same code must give, and how far they are apart in time. */
#ifndef FM_PLAN_SHARD_H
#define FM_PLAN_SHARD_H

#include "plan.h"

#define FM_SHARD_REFERENCE "exact" /* unless another method is named */
enum { FM_SHARDS_MAX = 1000 };

typedef struct fm_shard_desc {
    uint32_t index, count; /* 1 <= index <= count <= FM_SHARDS_MAX */
    const char *reference; /* method; "none"; NULL: FM_SHARD_REFERENCE if the plan has it */
} fm_shard_desc;

/* "2/16". FM_INVALID says what is legal. */
fm_status shard_parse(fm_shard_desc *desc, const char *text, fm_error *err);

/* Leaves of a whole plan the cases of one shard, in their order, and says so in plan->shard. A
 * shard may be left without a case. FM_INVALID: the plan has no such reference method, with the
 * nearest; FM_NO_MEMORY. The plan is then whole. */
fm_status plan_shard(fm_plan *plan, const fm_shard_desc *desc, fm_error *err);

#endif
