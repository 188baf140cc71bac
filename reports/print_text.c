#include "print_text.h"

#include <stdio.h>

fm_status print_text(fm_text *text, fm_status status, fm_error *err)
{
    if (status == FM_OK && text->failed)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for what is printed");
    if (status == FM_OK && text->length > 0)
        fwrite(text->bytes, 1, text->length, stdout);
    if (status == FM_OK && (fflush(stdout) != 0 || ferror(stdout)))
        status = fm_fail(err, FM_IO, "what it printed could not be written");
    text_free(text);
    return status;
}
