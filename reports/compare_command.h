/* `fragmark compare BASE NEW`: two runs, case by case. */
#ifndef FM_REPORT_COMPARE_H
#define FM_REPORT_COMPARE_H

/* argv[0] is the name to show in messages. Prints what it finds; returns the exit code. */
int compare_main(int argc, char **argv);

#endif
