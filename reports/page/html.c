#include "html.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { PICTURE_BYTES = 256 << 20 };

void html_add(fm_text *page, const char *text)
{
    while (*text != '\0') {
        size_t plain = strcspn(text, "<>&\"'");
        text_add_raw(page, text, plain);
        text += plain;
        if (*text != '\0')
            text_add(page, "&#%d;", *text++);
    }
}

/* "data:MIME;base64,..." */
static void add_data(fm_text *page, const char *mime, const unsigned char *bytes, size_t count)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    text_add(page, "data:%s;base64,", mime);
    for (size_t i = 0; i < count; i += 3) {
        unsigned word = (unsigned)bytes[i] << 16;
        word |= i + 1 < count ? (unsigned)bytes[i + 1] << 8 : 0;
        word |= i + 2 < count ? bytes[i + 2] : 0;
        char group[4] = { digits[word >> 18], digits[word >> 12 & 63], digits[word >> 6 & 63],
                          digits[word & 63] };
        if (i + 1 >= count)
            group[2] = '=';
        if (i + 2 >= count)
            group[3] = '=';
        text_add_raw(page, group, sizeof group);
    }
}

fm_status html_add_png(fm_text *page, const char *path, const char *alternative, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    fm_status status = text_read_file(&bytes, &count, path, PICTURE_BYTES, err);
    if (status != FM_OK)
        return status;
    text_add(page, "<img alt=\"");
    html_add(page, alternative);
    text_add(page, "\" src=\"");
    add_data(page, "image/png", (const unsigned char *)bytes, count);
    text_add(page, "\">");
    free(bytes);
    return FM_OK;
}

void html_add_number(fm_text *page, int digits, double value)
{
    if (isnan(value))
        text_add(page, "<td class=n></td>");
    else
        text_add(page, "<td class=n data-v=\"%.17g\">%.*g</td>", value, digits, value);
}
