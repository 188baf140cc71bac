/* `fragmark gate BASE NEW` of two folders of results. */
#ifndef FM_REPORT_GATE_H
#define FM_REPORT_GATE_H

/* argv[0] is the name to show in messages. Prints what it finds; returns the exit code. */
int gate_main(int argc, char **argv);

#endif
