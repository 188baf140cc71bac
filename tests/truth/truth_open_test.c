/* Truth files that cannot be opened, and what that is. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "truth/truth.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
enum { HAS_SANITIZER = 1 }; /* its shadow memory is beyond any limit on address space */
#else
enum { HAS_SANITIZER = 0 };
#endif

/* A file of so many bytes, all zero and none on disk. */
static void make_sparse(char path[32], off_t bytes)
{
    snprintf(path, 32, "/tmp/fm-truth-XXXXXX");
    const int fd = mkstemp(path);
    assert_true(fd >= 0);
    assert_int_equal(ftruncate(fd, bytes), 0);
    close(fd);
}

static void truth_open_refuses_what_is_no_truth(void **state)
{
    (void)state;
    static const off_t sizes[] = { 0, 10, 4096 };
    fm_truth *truth;
    fm_error err = { 0 };
    assert_int_equal(truth_open(&truth, "/nowhere/a.truth", &err), FM_IO);
    assert_int_equal(truth_open(&truth, "/dev/zero", &err), FM_IO); /* to be made anew */
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char path[32];
        make_sparse(path, sizes[i]);
        assert_int_equal(truth_open(&truth, path, &err), FM_IO);
        assert_non_null(strstr(err.message, "damaged"));
        assert_null(truth);
        unlink(path);
    }
}

/* In a process of its own, whose address space is limited to little more than it has. */
static int open_without_room(const char *path)
{
    fm_truth *truth;
    const struct rlimit limit = { 1u << 29, 1u << 29 };
    if (setrlimit(RLIMIT_AS, &limit) != 0)
        return 1;
    return truth_open(&truth, path, NULL) == FM_NO_MEMORY ? 0 : 2;
}

static void truth_open_tells_want_of_memory_from_damage(void **state)
{
    (void)state;
    char path[32];
    int status = 0;
    if (HAS_SANITIZER)
        skip();
    make_sparse(path, (off_t)1 << 32);
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
        _exit(open_without_room(path));
    assert_int_equal(waitpid(child, &status, 0), child);
    unlink(path);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(truth_open_refuses_what_is_no_truth),
        cmocka_unit_test(truth_open_tells_want_of_memory_from_damage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
