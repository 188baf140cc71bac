/* fragmark-report history: what runs of many nights measured. */
#ifndef FM_HISTORY_COMMAND_H
#define FM_HISTORY_COMMAND_H

/* argv[0] is what argp calls itself; the exit code. */
int history_main(int argc, char **argv);

#endif
