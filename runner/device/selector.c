#include "selector.h"

#include <string.h>

#include "base/text.h"

bool selector_matches(const char *selector, size_t index, const char *name)
{
    uint64_t wanted = 0;
    if (selector == NULL || selector[0] == '\0')
        return true;
    if (text_to_u64(&wanted, selector))
        return wanted == index;
    return strcasestr(name, selector) != NULL;
}
