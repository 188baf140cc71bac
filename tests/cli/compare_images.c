/* compare_images A.rgba32f B.rgba32f TOLERANCE: for scripts. Prints the largest difference of a
 * channel; exit code 0 within the tolerance, 1 beyond it, 2 if the two cannot be compared. */
#include <stdio.h>
#include <stdlib.h>

#include "image/image_error.h"

int main(int argc, char **argv)
{
    fm_image *a = NULL, *b = NULL;
    fm_difference apart;
    fm_error err = { .message = "arguments: A.rgba32f B.rgba32f TOLERANCE" };
    int code = 2;
    if (argc != 4 || image_read(&a, argv[1], &err) != FM_OK ||
        image_read(&b, argv[2], &err) != FM_OK || image_difference(&apart, a, b, &err) != FM_OK) {
        fprintf(stderr, "compare_images: %s\n", err.message);
        goto out;
    }
    printf("%.9g\n", apart.max_abs);
    code = apart.max_abs <= strtod(argv[3], NULL) ? 0 : 1;
out:
    image_destroy(a);
    image_destroy(b);
    return code;
}
