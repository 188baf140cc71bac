#include "fragmark/technique.h"
#include "model/descriptor.h"

#include <inttypes.h>
#include <string.h>

#include "check_method.h"

static fm_status check_alone(const fm_checked_method *check, fm_error *err)
{
    const fm_method_desc *m = check->method;
    if (m->feeds != FM_FEED_FRAMES)
        return fm_fail(err, FM_INVALID, "technique: feeds has to be 'frames' alone");
    if (check->resources.count + check->totals.count + check->passes.count > 0 ||
        m->loops[0].first != NULL || m->after != NULL)
        return fm_fail(
            err, FM_INVALID,
            "technique: resources, totals, passes, loops and after are for methods of passes");
    if (m->keeps != FM_KEEPS_NEAREST)
        return fm_fail(err, FM_INVALID, "technique: keeps has to be FM_KEEPS_NEAREST");
    return FM_OK;
}

static fm_status check_choice(const fm_method_desc *method, const fm_part_choice *choice,
                              fm_error *err)
{
    const fm_option *option = option_find(method, choice->option);
    if (option == NULL)
        return fm_fail(err, FM_INVALID, "option '%s': the method has no such option",
                       choice->option);
    if (choice->value == NULL || !option_has_value(option, choice->value))
        return fm_fail(err, FM_INVALID, "option '%s': no value '%s'", choice->option,
                       choice->value != NULL ? choice->value : "");
    if ((choice->parts & ~FM_PARTS_ALL) != 0)
        return fm_fail(err, FM_INVALID, "parts: unknown bits 0x%" PRIX32,
                       choice->parts & ~FM_PARTS_ALL);
    return FM_OK;
}

/* What each hook and part cannot do without. */
static fm_status check_needs(const fm_technique *t, fm_error *err)
{
    const bool sees = (t->parts & FM_PART_VISIBILITY) != 0;
    const bool signs = (t->parts & FM_PART_SIGNATURES) != 0;
    if (t->predict != NULL && !sees)
        return fm_fail(err, FM_INVALID, "predict: needs FM_PART_VISIBILITY");
    if (t->sign != NULL && !signs)
        return fm_fail(err, FM_INVALID, "sign: needs FM_PART_SIGNATURES");
    if (t->skip != NULL && !signs)
        return fm_fail(err, FM_INVALID, "skip: needs FM_PART_SIGNATURES");
    if ((t->parts & FM_PART_TAINT) != 0 && (!sees || !signs))
        return fm_fail(err, FM_INVALID,
                       "parts: taint needs FM_PART_VISIBILITY and FM_PART_SIGNATURES");
    if ((t->parts & (FM_PART_PREPASS | FM_PART_FINAL_DEPTH)) != 0 && t->place != NULL)
        return fm_fail(err, FM_INVALID, "place: depths drawn first need submission order");
    return FM_OK;
}

fm_status check_technique(const fm_checked_method *check, fm_error *err)
{
    const fm_technique *t = check->method->technique;
    fm_status status = check_alone(check, err);
    if (status == FM_OK && (t->parts & ~FM_PARTS_ALL) != 0)
        status = fm_fail(err, FM_INVALID, "technique: parts: unknown bits 0x%" PRIX32,
                         t->parts & ~FM_PARTS_ALL);
    for (size_t i = 0; i < FM_MAX_PART_CHOICES && status == FM_OK; i++)
        if (t->choices[i].option != NULL &&
            check_choice(check->method, &t->choices[i], err) != FM_OK)
            return fm_error_prefix(err, "technique: choices[%zu]", i);
    if (status == FM_OK && check_needs(t, err) != FM_OK)
        return fm_error_prefix(err, "technique");
    return status;
}
