#include "cli.h"

int cli_fail(const fm_cli *cli, const fm_error *err)
{
    fprintf(cli->talk, "fragmark: %s\n", err->message);
    return err->status == FM_INVALID || err->status == FM_IO ? CLI_USAGE : CLI_NOTHING;
}

int cli_print_json(const fm_cli *cli, json_t *object)
{
    const bool is_written = object != NULL && json_dumpf(object, cli->out, JSON_INDENT(2)) == 0 &&
                            fputc('\n', cli->out) != EOF;
    json_decref(object);
    if (!is_written)
        fprintf(cli->talk, "fragmark: the JSON cannot be written\n");
    return is_written ? CLI_DONE : CLI_NOTHING;
}
