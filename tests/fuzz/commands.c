/* SPDX-License-Identifier: MIT */
/*
 * commands.c - fuzz target: the command lines of all programs in the folders that FUZZ_PROGRAMS names (separated by colons). Each is run with words made of the input: its own options, which it names in its
 * help, numbers of all sorts, words that are none. It must end with 0 or 2, or 1 if it got as far as to compare its results, and with 2 only after a message; one that is still running after a moment has
 * understood its words and is stopped. Before that, the words go through options.h here, where the fuzzer sees what they do.
 */
#define _XOPEN_SOURCE 700 /* fork, setitimer, setrlimit, mkdtemp, nftw */
#include "fuzz.h"

#include "../../examples/common/options.h"

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/wait.h>
#include <unistd.h>

enum { PROGRAMS = 128, OPTIONS = 64, WORDS = 12, WORD = 24, TEXT = 16384 };

typedef struct program {
    char path[4096];
    char options[OPTIONS][WORD];
    int count;
    int strict; /* of the drivers' kind: reads all words before it does anything */
} program;
static program programs[PROGRAMS];
static int program_count;
static char folder[64]; /* where they run */

/* ---- running ---- */

typedef struct outcome {
    int status;
    char text[TEXT]; /* what it printed to standard error, or for help to standard output */
} outcome;

static outcome run(const char *path, char **words, int milliseconds, int from)
{
    outcome o;
    size_t length = 0;
    char rest[4096];
    ssize_t got;
    pid_t child;
    int ends[2];
    memset(&o, 0, sizeof o);
    if (pipe(ends) != 0) exit(1);
    child = fork();
    if (child < 0) exit(1);
    if (child == 0) {
        const struct rlimit space = {(rlim_t)2 << 30, (rlim_t)2 << 30}, file = {1 << 24, 1 << 24}, core = {0, 0};
        struct itimerval timer;
        const int nothing = open("/dev/null", O_RDWR);
        memset(&timer, 0, sizeof timer);
        timer.it_value.tv_sec = milliseconds / 1000;
        timer.it_value.tv_usec = milliseconds % 1000 * 1000;
        if (chdir(folder) != 0) _exit(99);
        dup2(nothing, 0);
        dup2(from == 1 ? ends[1] : nothing, 1);
        dup2(from == 2 ? ends[1] : nothing, 2);
        close(ends[0]);
        close(ends[1]);
        setrlimit(RLIMIT_AS, &space);
        setrlimit(RLIMIT_FSIZE, &file);
        setrlimit(RLIMIT_CORE, &core);
        signal(SIGALRM, SIG_DFL);
        setitimer(ITIMER_REAL, &timer, NULL);
        execv(path, words);
        _exit(99);
    }
    close(ends[1]);
    /* all of it, although the fuzzer's own timer interrupts */
    while ((got = read(ends[0], length < TEXT - 1 ? o.text + length : rest, length < TEXT - 1 ? TEXT - 1 - length : sizeof rest)) > 0 || (got < 0 && errno == EINTR))
        if (got > 0 && length < TEXT - 1) length += (size_t)got;
    close(ends[0]);
    while (waitpid(child, &o.status, 0) != child)
        if (errno != EINTR) exit(1);
    return o;
}

/* ---- which programs there are, and their options ---- */

static int by_name(const void *a, const void *b) { return strcmp(((const program *)a)->path, ((const program *)b)->path); }
static int unlink_one(const char *path, const struct stat *s, int kind, struct FTW *f)
{
    (void)s, (void)kind, (void)f;
    return remove(path);
}
static void remove_folder(void) { nftw(folder, unlink_one, 8, FTW_DEPTH | FTW_PHYS); }

static void learn(program *p)
{
    char help[] = "-h", *words[3];
    const char *c;
    outcome o;
    words[0] = p->path;
    words[1] = help;
    words[2] = NULL;
    o = run(p->path, words, 5000, 1);
    p->strict = strncmp(o.text, "usage: ", 7) == 0;
    for (c = o.text; *c && p->count < OPTIONS; c++) {
        const size_t length = strcspn(c, " \t\n|],.()");
        if (*c != '-' || (c > o.text && !strchr(" [|\n", c[-1])) || length < 2 || length >= WORD) continue;
        memcpy(p->options[p->count], c, length);
        p->options[p->count++][length] = '\0';
    }
}
static void find_programs(void)
{
    const char *list = getenv("FUZZ_PROGRAMS");
    const char *const temporary = getenv("TMPDIR");
    int k;
    snprintf(folder, sizeof folder, "%.40s/fuzz_run_XXXXXX", temporary ? temporary : "/tmp");
    if (!mkdtemp(folder)) exit(1);
    atexit(remove_folder);
    while (list && *list) {
        char name[2048], whole[PATH_MAX];
        const size_t length = strcspn(list, ":");
        struct dirent *entry;
        DIR *d;
        snprintf(name, sizeof name, "%.*s", (int)length, list);
        list += length + (list[length] == ':');
        d = realpath(name, whole) ? opendir(whole) : NULL;
        while (d && (entry = readdir(d)) != NULL && program_count < PROGRAMS) {
            program *const p = &programs[program_count];
            struct stat s;
            if (snprintf(p->path, sizeof p->path, "%s/%s", whole, entry->d_name) >= (int)sizeof p->path) continue;
            if (stat(p->path, &s) == 0 && S_ISREG(s.st_mode) && access(p->path, X_OK) == 0 && !strchr(entry->d_name, '.')) program_count++;
        }
        if (d) closedir(d);
    }
    qsort(programs, (size_t)program_count, sizeof *programs, by_name);
    for (k = 0; k < program_count; k++) learn(&programs[k]);
    fprintf(stderr, "commands: %d programs\n", program_count);
}

/* ---- words ---- */

static void make_word(fuzz_input *in, const program *p, char *word)
{
    static const char *const common[] = {"-h", "--help", "-t", "-o", "-", "--", "-nonsense", "0", "1", "-1", "2", "7", "100", "2147483647", "-2147483648", "99999999999999999999", "1e308", "1e999", "-1e-320", "nan", "inf",
                                         "0x10", "1.5", " 3", "3 ", "", ".", "no/such/folder", "%s%n", "wendland-c2", "cubic", "all", "-n", "-seed", "-out", "-figures"};
    const int how = fuzz_below(in, 4);
    int k;
    if (how < 2 && p->count > 0) strcpy(word, p->options[fuzz_below(in, p->count)]);
    else if (how < 3) strcpy(word, common[fuzz_below(in, (int)(sizeof common / sizeof *common))]);
    else {
        const int length = fuzz_below(in, WORD);
        for (k = 0; k < length; k++) {
            const char c = (char)fuzz_byte(in);
            word[k] = c == '/' || c == '\0' ? '.' : c; /* stays in its folder */
        }
        word[length] = '\0';
    }
}

static void check_options(char words[WORDS][WORD], int count)
{
    int n = 3, flag = 0, k;
    double x = 0.5;
    const char *text = ".";
    const option_spec specs[] = {{"n", "whole", OPTION_INT, &n, 2, 4096}, {"x", "real", OPTION_REAL, &x, 0.0, DBL_MAX}, {"out", "text", OPTION_TEXT, &text, 0, 0}, {"full", "flag", OPTION_FLAG, &flag, 0, 0}};
    FILE *const nothing = fopen("/dev/null", "w");
    if (!nothing) exit(1);
    for (k = 0; k + 1 < count; k++) {
        const option_spec *s = option_find(specs, 4, words[k]);
        if (!s) s = &specs[k % 4];
        option_set(s, words[k + 1]);
        FUZZ_REQUIRE(n >= 2 && n <= 4096 && x >= 0.0 && isfinite(x) && text != NULL && (flag == 0 || flag == 1));
    }
    options_usage(nothing, words[0], "about", specs, 4);
    fclose(nothing);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    fuzz_input in = {data, size, 0};
    char words[WORDS][WORD], nonsense[] = "-nonsense", *argv[WORDS + 3];
    const program *p;
    int k, count, last, helped = 0;
    outcome o;
    if (!folder[0]) find_programs();
    if (program_count == 0) return 0;
    p = &programs[fuzz_below(&in, program_count)];
    count = fuzz_below(&in, WORDS + 1);
    last = p->strict && fuzz_below(&in, 4); /* mostly: so that it does not start to compute */
    argv[0] = (char *)(uintptr_t)p->path;
    for (k = 0; k < count; k++) {
        make_word(&in, p, words[k]);
        argv[k + 1] = words[k];
        helped |= strcmp(words[k], "-h") == 0 || strcmp(words[k], "--help") == 0;
    }
    if (count > 0) check_options(words, count);
    if (last) argv[++k] = nonsense;
    argv[k + 1] = NULL;
    o = run(p->path, argv, last ? 5000 : 200, 2);
    if (WIFSIGNALED(o.status) && !last && (WTERMSIG(o.status) == SIGALRM || WTERMSIG(o.status) == SIGXFSZ)) return 0;
    if (!(WIFEXITED(o.status) && WEXITSTATUS(o.status) <= 2 && (!last || WEXITSTATUS(o.status) == (helped ? 0 : 2)) && (WEXITSTATUS(o.status) != 2 || o.text[0]))) {
        fprintf(stderr, "%s ended with %s %d\n", p->path, WIFEXITED(o.status) ? "status" : "signal", WIFEXITED(o.status) ? WEXITSTATUS(o.status) : WTERMSIG(o.status));
        for (k = 1; argv[k]; k++) fprintf(stderr, "    '%s'\n", argv[k]);
        fprintf(stderr, "%s\n", o.text);
        abort();
    }
    return 0;
}
