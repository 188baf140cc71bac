/* `fragmark-report error A B`: how far two image files are apart. */
#ifndef FM_REPORT_ERROR_H
#define FM_REPORT_ERROR_H

/* argv[0] is the name to show in messages. Prints what it finds; returns the exit code. */
int error_main(int argc, char **argv);

#endif
