#include "code_json.h"

#include <stdlib.h>
#include <string.h>

static const char *const owner_name[] = {
    [FM_CODE_OF_METHOD] = "method",
    [FM_CODE_OF_FLOOR] = "floor",
};
_Static_assert(sizeof owner_name / sizeof owner_name[0] == FM_CODE_OWNER_COUNT, "one each");

static json_t *digits_json(uint64_t hash)
{
    char digits[17];
    code_digits(digits, hash);
    return json_string(digits);
}

static json_t *files_json(const fm_code *code, fm_code_owner owner)
{
    json_t *files = json_object();
    for (size_t i = 0; i < code->count; i++)
        if (code->files[i].owner == owner)
            json_object_set_new(files, code->files[i].name, digits_json(code->files[i].hash));
    return files;
}

json_t *code_to_json(const fm_code *code)
{
    json_t *object = json_object(), *files = json_object();
    for (int part = 0; part < FM_CODE_PART_COUNT; part++)
        json_object_set_new(object, code_part_name((fm_code_part)part),
                            digits_json(code_part(code, (fm_code_part)part)));
    for (int owner = 0; owner < FM_CODE_OWNER_COUNT; owner++)
        json_object_set_new(files, owner_name[owner], files_json(code, (fm_code_owner)owner));
    json_object_set_new(object, "files", files);
    return object;
}

static bool read_digits(uint64_t *hash, const json_t *json)
{
    static const char hex[] = "0123456789abcdef";
    const char *digits = json_string_value(json);
    if (digits == NULL || (digits[0] != '\0' && strlen(digits) != 16) ||
        strspn(digits, hex) != strlen(digits))
        return false;
    *hash = strtoull(digits, NULL, 16);
    return true;
}

static bool read_files(fm_code *code, fm_code_owner owner, json_t *files)
{
    const char *name;
    json_t *digits;
    if (!json_is_object(files))
        return false;
    json_object_foreach(files, name, digits)
    {
        uint64_t hash;
        if (!read_digits(&hash, digits))
            return false;
        code_add(code, owner, name, hash);
    }
    return true;
}

bool code_from_json(fm_code *code, const json_t *json)
{
    const json_t *files = json_object_get(json, "files");
    *code = (fm_code){ 0 };
    if (!read_digits(&code->program, json_object_get(json, code_part_name(FM_CODE_PROGRAM))) ||
        !read_digits(&code->driver, json_object_get(json, code_part_name(FM_CODE_DRIVER))))
        return false;
    for (int owner = 0; owner < FM_CODE_OWNER_COUNT; owner++)
        if (!read_files(code, (fm_code_owner)owner, json_object_get(files, owner_name[owner])))
            return false;
    return !code->failed;
}
