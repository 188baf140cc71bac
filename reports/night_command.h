/* fragmark-report night: a night's run recorded and judged. `fragmark nightly` executes it. */
#ifndef FM_NIGHT_COMMAND_H
#define FM_NIGHT_COMMAND_H

/* argv[0] is what argp calls itself; the exit code. */
int night_main(int argc, char **argv);

#endif
