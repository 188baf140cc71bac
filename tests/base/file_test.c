/* What stands at a path: files are read, all else is refused by its name and without waiting. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/file.h"
#include "base/text.h"
#include "base/yaml_tree.h"
#include "image/image.h"

enum { WAIT_S = 10 }; /* an open that waits for a pipe's other end is killed */

static fm_status read_text(const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    const fm_status status = text_read_file(&bytes, &count, path, 1000, err);
    free(bytes);
    return status;
}

static fm_status write_text(const char *path, fm_error *err)
{
    return text_write_file(path, "x", 1, err);
}

static fm_status read_yaml(const char *path, fm_error *err)
{
    fm_yaml *root = NULL;
    const fm_status status = yaml_tree_read(&root, path, err);
    yaml_tree_free(root);
    return status;
}

static fm_status read_image(const char *path, fm_error *err)
{
    fm_image *image = NULL;
    const fm_status status = image_read(&image, path, err);
    image_destroy(image);
    return status;
}

static fm_status append(const char *path, fm_error *err)
{
    int fd = -1;
    const fm_status status = file_open_append(&fd, path, err);
    if (status == FM_OK)
        close(fd);
    return status;
}

typedef fm_status user(const char *path, fm_error *err);
static const struct {
    user *use;
    fm_status refusal;
} users[] = {
    { read_text, FM_INVALID }, { read_yaml, FM_INVALID }, { read_image, FM_INVALID },
    { write_text, FM_IO },     { append, FM_IO },
};
enum { USER_COUNT = sizeof users / sizeof users[0] };

static void all_refuse(const char *path, const char *kind)
{
    for (size_t i = 0; i < USER_COUNT; i++) {
        fm_error err = { 0 };
        char expected[256];
        snprintf(expected, sizeof expected, "%s: is %s, not a file", path, kind);
        alarm(WAIT_S);
        const fm_status status = users[i].use(path, &err);
        alarm(0);
        if (status != users[i].refusal || strcmp(err.message, expected) != 0)
            fail_msg("user %zu: %d, \"%s\"; wanted \"%s\"", i, status, err.message, expected);
    }
}

typedef struct place {
    char folder[64], path[96];
} place;

static void place_create(place *at)
{
    strcpy(at->folder, "/tmp/fragmark-file-XXXXXX");
    assert_non_null(mkdtemp(at->folder));
    snprintf(at->path, sizeof at->path, "%s/x", at->folder);
}

static void place_destroy(const place *at)
{
    unlink(at->path);
    assert_int_equal(rmdir(at->folder), 0);
}

static void devices_and_folders_are_refused(void **state)
{
    (void)state;
    all_refuse("/dev/zero", "a device");
    all_refuse("/dev/null", "a device");
    all_refuse("/tmp", "a folder");
}

static void a_pipe_is_refused_without_waiting(void **state)
{
    (void)state;
    place at;
    place_create(&at);
    assert_int_equal(mkfifo(at.path, 0666), 0);
    all_refuse(at.path, "a pipe");
    place_destroy(&at);
}

static void a_socket_is_refused(void **state)
{
    (void)state;
    place at;
    place_create(&at);
    struct sockaddr_un address = { .sun_family = AF_UNIX };
    memcpy(address.sun_path, at.path, strlen(at.path) + 1);
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    assert_int_equal(bind(fd, (const struct sockaddr *)(const void *)&address, sizeof address), 0);
    all_refuse(at.path, "a socket");
    close(fd);
    place_destroy(&at);
}

static void links_are_followed(void **state)
{
    (void)state;
    place at;
    place_create(&at);
    assert_int_equal(symlink("/dev/zero", at.path), 0);
    all_refuse(at.path, "a device");
    unlink(at.path);
    assert_int_equal(symlink("/proc/version", at.path), 0);
    assert_int_equal(read_text(at.path, NULL), FM_OK); /* says that it holds 0 bytes */
    place_destroy(&at);
}

static void a_pipe_in_the_place_of_the_partial_file_is_refused(void **state)
{
    (void)state;
    place at;
    char partial[128];
    fm_error err = { 0 };
    place_create(&at);
    snprintf(partial, sizeof partial, "%s.partial", at.path);
    assert_int_equal(mkfifo(partial, 0666), 0);
    alarm(WAIT_S);
    assert_int_equal(write_text(at.path, &err), FM_IO);
    alarm(0);
    assert_non_null(strstr(err.message, "x.partial: is a pipe"));
    unlink(partial);
    place_destroy(&at);
}

static void a_missing_file_is_the_systems_reason(void **state)
{
    (void)state;
    fm_error err = { 0 };
    assert_int_equal(read_text("/nowhere/x", &err), FM_IO);
    assert_string_equal(err.message, "/nowhere/x: No such file or directory");
}

static void append_never_empties_and_create_does(void **state)
{
    (void)state;
    place at;
    char *bytes = NULL;
    size_t count = 0;
    int fd = -1;
    place_create(&at);
    assert_int_equal(write_text(at.path, NULL), FM_OK);
    assert_int_equal(append(at.path, NULL), FM_OK);
    assert_int_equal(text_read_file(&bytes, &count, at.path, 10, NULL), FM_OK);
    assert_string_equal(bytes, "x");
    free(bytes);
    assert_int_equal(file_create(&fd, at.path, NULL), FM_OK);
    close(fd);
    assert_int_equal(text_read_file(&bytes, &count, at.path, 10, NULL), FM_OK);
    assert_int_equal(count, 0);
    free(bytes);
    place_destroy(&at);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(devices_and_folders_are_refused),
        cmocka_unit_test(a_pipe_is_refused_without_waiting),
        cmocka_unit_test(a_socket_is_refused),
        cmocka_unit_test(links_are_followed),
        cmocka_unit_test(a_pipe_in_the_place_of_the_partial_file_is_refused),
        cmocka_unit_test(a_missing_file_is_the_systems_reason),
        cmocka_unit_test(append_never_empties_and_create_does),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
