#include "slurm_script.h"

#include "cli/cli.h"

static void add_head(fm_text *text, const slurm_desc *desc, const char *name, const char *log)
{
    text_add(text, "#!/bin/bash\n#SBATCH --job-name=%s\n#SBATCH --output=\"%s/logs/%s\"\n", name,
             desc->directory, log);
    text_add(text, "#SBATCH --open-mode=append\n");
}

static void add_options(fm_text *text, const fm_text_list *options)
{
    for (size_t i = 0; i < options->count; i++)
        text_add(text, "#SBATCH %s\n", options->items[i]);
}

static void add_place(fm_text *text, const slurm_desc *desc)
{
    text_add(text, "\ncd ");
    cli_add_word(text, desc->here);
    text_add(text, " || exit\n");
}

void slurm_add_command(fm_text *text, const slurm_desc *desc)
{
    cli_add_word(text, desc->program);
    for (size_t i = 0; i < desc->words->count; i++) {
        text_add(text, " ");
        cli_add_word(text, desc->words->items[i]);
    }
    text_add(text, " --shard \"$SLURM_ARRAY_TASK_ID/%u\"", desc->shards);
}

static void add_folder(fm_text *text, const slurm_desc *desc)
{
    text_add(text, " -o ");
    cli_add_word(text, desc->directory);
    text_add(text, "/shard-\"$SLURM_ARRAY_TASK_ID\"");
}

/* A task that is stopped before it ends goes into the queue again, and so goes on. */
static void add_requeueing(fm_text *text, const slurm_desc *desc)
{
    text_add(text, "trap 'kill -TERM \"$child\"' TERM\n");
    slurm_add_command(text, desc);
    add_folder(text, desc);
    text_add(text,
             " &\n"
             "child=$!\n"
             "wait \"$child\"\n"
             "code=$?\n"
             "while kill -0 \"$child\" 2>/dev/null; do # the trap ended the wait\n"
             "    wait \"$child\"\n"
             "    code=$?\n"
             "done\n"
             "if [ \"$code\" = 143 ] && [ \"${SLURM_RESTART_COUNT:-0}\" -lt %u ]; then\n"
             "    scontrol requeue \"${SLURM_ARRAY_JOB_ID}_$SLURM_ARRAY_TASK_ID\"\n"
             "fi\n"
             "exit \"$code\"\n",
             desc->requeues);
}

void slurm_add_shards(fm_text *text, const slurm_desc *desc)
{
    add_head(text, desc, "fragmark", "%a.log");
    text_add(text, "#SBATCH --array=1-%u\n#SBATCH --requeue\n#SBATCH --signal=B:TERM@%u\n",
             desc->shards, desc->lead_s);
    add_options(text, desc->options);
    add_options(text, desc->shard_options);
    text_add(text,
             "\n# A task measures its shard of %u. Stopped or put into the queue again, it goes on "
             "where it was.\n"
             "# Only some of them again: sbatch --array=3,7 with this file.\n",
             desc->shards);
    add_place(text, desc);
    if (desc->requeues > 0) {
        add_requeueing(text, desc);
        return;
    }
    text_add(text, "exec "); /* so that TERM, which the shell gets, reaches the program */
    slurm_add_command(text, desc);
    add_folder(text, desc);
    text_add(text, "\n");
}

void slurm_add_merge(fm_text *text, const slurm_desc *desc)
{
    add_head(text, desc, "fragmark-merge", "merge.log");
    text_add(text, "#SBATCH --requeue\n");
    add_options(text, desc->options);
    text_add(text, "\n# Merges the shards that there are; exit code 5 names those that lack.\n");
    add_place(text, desc);
    text_add(text, "shopt -s nullglob\nexec ");
    cli_add_word(text, desc->program);
    text_add(text, " merge ");
    cli_add_word(text, desc->directory);
    text_add(text, "/shard-* -o ");
    cli_add_word(text, desc->directory);
    text_add(text, "/merged%s\n", desc->no_report ? " --no-report" : "");
}
