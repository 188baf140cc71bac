/* What the process that describes a plugin answers: a head and `count` bytes. Whoever reads one
 * believes none of it before it is checked. */
#ifndef FM_DESCRIBE_ANSWER_H
#define FM_DESCRIBE_ANSWER_H

#include <stdint.h>

#include "description.h"

typedef enum answer_kind {
    ANSWER_NONE,       /* nothing was written */
    ANSWER_LOADING,    /* dlopen is at work, or was when the process ended */
    ANSWER_CHECKING,   /* the descriptor is read and checked, or was */
    ANSWER_ENDED,      /* a text: how the process ended before it had an answer */
    ANSWER_NOT_LOADED, /* a text: why it cannot be loaded here */
    ANSWER_REFUSED,    /* a text: which rule the descriptor breaks */
    ANSWER_DESCRIBED,  /* a description */
} answer_kind;

typedef struct answer_head {
    uint32_t kind; /* answer_kind */
    uint32_t count;
} answer_head;

typedef struct answer {
    answer_head head;
    char bytes[FM_DESCRIPTION_MAX_BYTES];
} answer;

/* The answer about plugin i stands at i times this in the file. */
#define ANSWER_SLOT_BYTES (sizeof(answer))

/* Makes an answer of a text, cut where it is too long. */
static inline void answer_set_text(answer *to, answer_kind kind, const char *text)
{
    uint32_t count = 0;
    while (text[count] != '\0' && count < FM_DESCRIPTION_MAX_BYTES) {
        to->bytes[count] = text[count];
        count++;
    }
    to->head = (answer_head){ .kind = kind, .count = count };
}

#endif
