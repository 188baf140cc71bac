/* How wrong a case is, and which trait of its method says so.
 *
 * The room reports/stability holds what was measured against what methods declare: of one case
 * (blame), of methods by scenes (matrix), and as a table (stability_csv). It draws nothing. */
#ifndef FM_BLAME_H
#define FM_BLAME_H

#include "read/cases.h"

/* In rising order of what a reader has to look at. */
typedef enum fm_stability {
    FM_STABILITY_NONE,      /* not run, or the floor, which has no picture */
    FM_STABILITY_EXACT,     /* all fragments right, the image within a step of a float, 2^-23; of a
                               sequence all tiles right */
    FM_STABILITY_TOLERATED, /* all fragments right, the image off by no more than rounding may be */
    FM_STABILITY_NOT_SUPPORTED,
    FM_STABILITY_UNKNOWN, /* an older run did not record what a verdict needs */
    FM_STABILITY_WRONG,
    FM_STABILITY_FAILED, /* crash, timeout, out of memory, ...: nothing is known of its errors */
    FM_STABILITY_COUNT
} fm_stability;

/* What can be wrong: bits. */
enum {
    FM_WRONG_MISSING = 1u << 0,    /* wanted fragments were not handed over */
    FM_WRONG_EXTRA = 1u << 1,      /* others were */
    FM_WRONG_MISORDERED = 1u << 2, /* neighbours came in the wrong order */
    FM_WRONG_LOST = 1u << 3,       /* the method itself says that it lost some */
    FM_WRONG_IMAGE = 1u << 4,      /* the image is not that of the fragments handed over */
    FM_WRONG_UNSTABLE = 1u << 5,   /* frames differ where no ties allow it, or some frame is worse
                                      than the one that errors are of */
    FM_WRONG_TILES = 1u << 6,      /* a sequence's tiles are not the baseline's */
};
enum { FM_WRONG_COUNT = 7, BLAME_WORDS_BYTES = 160 };
/* "missing", of bit 0; NULL: there is no such bit. */
const char *wrong_name(unsigned bit);

typedef struct fm_blame {
    fm_stability verdict;
    uint32_t wrong;  /* FM_WRONG_* */
    uint32_t traits; /* FM_TRAIT_* that allow them, here and in this size; those that are needed */
    uint32_t unexplained; /* of wrong, what no trait allows, or not in this size */
    double missing_share; /* of the wanted fragments; 0 where nothing is wanted */
} fm_blame;

/* "exact", "within tolerance", ... */
const char *stability_name(fm_stability stability);

/* Rules that the traits of fragmark/method.h say. Fragments of a pixel may be in flight together
 * but on compute-pixel, and on raster of a device that is known to be software. Layers are flat but
 * for depths=sloped; meshes are not.
 *   loses_ties        exactly declared_ties are missing; who emits from both ends may hand over as
 *                     many of the other tied fragments instead. Which one survives, and so the
 *                     image, may change where ties differ in colour and are in flight together
 *   passes_lose_ties  up to declared_ties are missing
 *   loses_depth_one   exactly declared_at_one are missing
 *   racy              all but tiles, where fragments are in flight together
 *   sorted_input      any may be missing, but not of flat layers that arrive in turn and front to
 *                     back; image and frames may vary where fragments are in flight together
 *   multisampled      missing and extra ones, but not of flat layers
 *   approximate       another image; its fragments are not compared, for it merges or weighs them
 * Where another trait allows missing ones, too, fewer may be lost than are declared. Of sequences,
 * wrong tiles are explained if the technique is not declared exact. How many a race, the order of
 * arrival, samples or an approximation cost, no trait says. A case that failed is unexplained. */
fm_blame blame_case(const fm_case_row *row);
/* Nobody said that this happens. */
bool blame_is_open(const fm_blame *blame);

/* "loses ties, fragments race": why a case is as it is. Of one that is not supported its reason
 * (older runs did not record it), of a failed one its status; "" of what is right, and of what is
 * unexplained. */
void blame_words(char words[BLAME_WORDS_BYTES], const fm_blame *blame, const fm_case_row *row);

#endif
