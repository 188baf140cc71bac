#include "depth_check.h"

fm_status depth_check_pass(const fm_pass *pass, const fm_settings *settings, fm_error *err)
{
    if (settings->depth == FM_DEPTH_NORMAL || pass->kind != FM_PASS_SCENE ||
        pass->state.depth_test == FM_COMPARE_OFF)
        return FM_OK;
    return fm_refuse(err, FM_REASON_DEPTH_TEST,
                     "depth = reversed: pass '%s' tests the rasterised depth, which falls with "
                     "distance, against the attachment '%s'",
                     pass->name, pass->state.depth_stencil);
}

fm_status depth_check(const fm_method_desc *method, const fm_settings *settings, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < pass_count(method) && status == FM_OK; i++)
        status = depth_check_pass(&method->passes[i], settings, err);
    return status;
}
