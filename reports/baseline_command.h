/* fragmark-report baseline: runs that have a name. */
#ifndef FM_BASELINE_COMMAND_H
#define FM_BASELINE_COMMAND_H

/* argv[0] is what argp calls itself; the exit code. */
int baseline_main(int argc, char **argv);

#endif
