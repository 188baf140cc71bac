#include "tonight.h"

#include "base/clock.h"
#include "child/child.h"

bool tonight_add_all(fm_text_list *argv, const char *option, const fm_text_list *values)
{
    bool is_added = true;
    for (size_t i = 0; i < values->count; i++)
        is_added = is_added && text_list_add(argv, option) && text_list_add(argv, values->items[i]);
    return is_added;
}

bool tonight_add_two(fm_text_list *argv, const char *option, const char *value)
{
    return text_list_add(argv, option) && text_list_add(argv, value);
}

fm_status tonight_execute(fm_night_end *end, const fm_tonight *tonight, const fm_text_list *argv,
                          const fm_night_program *program, fm_error *err)
{
    char log[FM_PATH_MAX_BYTES];
    pid_t pid;
    const double began_s = clock_s();
    fm_status status = path_join(log, tonight->night.folder, program->log, err);
    const fm_child_desc desc = { .path = program->path != NULL ? program->path : "/proc/self/exe",
                                 .argv = argv->items,
                                 .log = log,
                                 .folder = program->folder,
                                 .kept_fd = tonight->lock };
    *end = (fm_night_end){ 0 };
    if (status == FM_OK)
        status = child_start(&pid, &desc, err);
    if (status != FM_OK)
        return status;
    end->is_cut_off = !child_wait(&end->code, pid, program->seconds, NULL);
    end->seconds = clock_s() - began_s;
    return FM_OK;
}
