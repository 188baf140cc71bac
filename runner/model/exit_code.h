/* What the exit codes of fragmark and fragmark-report mean: one table for both. */
#ifndef FM_EXIT_CODE_H
#define FM_EXIT_CODE_H

typedef enum fm_exit_code {
    FM_EXIT_DONE = 0,
    FM_EXIT_CLAIM_FAILS = 1, /* a claim that its figure declares required */
    FM_EXIT_WORSE = 1,       /* ab, gate: a case is worse, confirmed or by its outputs */
    FM_EXIT_USAGE = 2,       /* usage or spec error: nothing was run, nothing replaced */
    FM_EXIT_NOTHING = 3,     /* nothing could be measured */
    FM_EXIT_SOME_FAILED = 4, /* crash, timeout, out of memory, refused plugin, wrong image */
    FM_EXIT_INCOMPLETE = 5,  /* the world stopped the run, a full disk say: it can be continued; a
                                report was drawn of results that lack something; or shards are
                                missing, and the others were merged */
    FM_EXIT_OTHER_CODE = 7,  /* rows were begun with other code than is here now; or runs do not
                                compare: milliseconds of two machines, no case in both, shards of
                                two programs, a build of another version */
    FM_EXIT_DAMAGED = 8, /* a damaged or foreign file, or one that is gone: nothing was replaced */
} fm_exit_code;

#endif
