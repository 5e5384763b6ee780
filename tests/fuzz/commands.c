/* SPDX-License-Identifier: MIT */
/*
 * commands.c - fuzz target: the command lines of all programs in the folders that FUZZ_PROGRAMS names (separated by colons). Each is run with words made of the input: its own options, which it names in its
 * help, numbers of all sorts, paths to nowhere, words that are none. What a driver must answer to the first wrong word is known, because its help tells the kind and the limits of each option: status 2, and a
 * message that names the option and the value. A single-file example must answer a first word that is none of its options with status 2. What is not wrong must end with 0 or 2, or 1 if it got as far as to
 * compare its results, and with 2 only after a message; one that is still running after a moment has understood its words and is stopped. Before that, the words go through options.h here, where the fuzzer
 * sees what they do.
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

enum { PROGRAMS = 128, OPTIONS = 64, WORDS = 12, WORD = 32, TEXT = 16384, LONG = 5000 };

typedef struct program {
    char path[4096];
    char names[OPTIONS][WORD];  /* with the dash */
    option_spec specs[OPTIONS]; /* of a driver: what its help says of them */
    int count;
    int strict; /* of the drivers' kind: reads all words before it does anything */
    int tested; /* of the examples' kind: has -t */
} program;
static program programs[PROGRAMS];
static int program_count;
static char folder[4096]; /* where they run */

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

/* the number after the last of these words in the line, or another */
static double limit(const char *line, const char *words, double otherwise)
{
    const char *const at = strstr(line, words);
    return at ? strtod(at + strlen(words), NULL) : otherwise;
}
/* "  -n N   particles (a whole number, at least 2, at most 4096; default 100)" */
static void learn_option(program *p, const char *line)
{
    static const char *const kinds[] = {"(a whole number", "(a finite number", "(any text", "(no value"}; /* as in option_type */
    option_spec *const spec = &p->specs[p->count];
    int k;
    for (k = 0; k < 4; k++) {
        const char *at = strstr(line, kinds[k]), *next;
        while (at && (next = strstr(at + 1, kinds[k])) != NULL) at = next; /* before may stand the same words, in the text on the option */
        if (!at) continue;
        spec->name = p->names[p->count++] + 1;
        spec->help = "";
        spec->type = (option_type)k;
        spec->lowest = limit(at, "at least ", -DBL_MAX);
        spec->highest = limit(at, "at most ", DBL_MAX);
        return;
    }
}
static void learn(program *p)
{
    char help[] = "-h", *words[3], *c, *line, *rest;
    outcome o;
    words[0] = p->path;
    words[1] = help;
    words[2] = NULL;
    o = run(p->path, words, 5000, 1);
    p->strict = strncmp(o.text, "usage: ", 7) == 0;
    for (line = o.text; p->strict && *line && p->count < OPTIONS; line = rest) {
        const size_t end = strcspn(line, "\n"), length = strncmp(line, "  -", 3) == 0 ? strcspn(line + 2, " ") : 0;
        rest = line + end + (line[end] == '\n');
        line[end] = '\0';
        if (length < 2 || length >= WORD) continue;
        memcpy(p->names[p->count], line + 2, length);
        p->names[p->count][length] = '\0';
        if (strcmp(p->names[p->count], "-h") != 0) learn_option(p, line);
    }
    for (c = o.text; !p->strict && *c && p->count < OPTIONS; c++) {
        const size_t length = strcspn(c, " \t\n|],.()");
        if (*c != '-' || (c > o.text && !strchr(" [|\n", c[-1])) || length < 2 || length >= WORD) continue;
        memcpy(p->names[p->count], c, length);
        p->names[p->count][length] = '\0';
        p->tested |= strcmp(p->names[p->count++], "-t") == 0;
    }
}
static void find_programs(void)
{
    const char *list = getenv("FUZZ_PROGRAMS");
    const char *const temporary = getenv("TMPDIR");
    int k;
    snprintf(folder, sizeof folder, "%.4000s/fuzz_run_XXXXXX", temporary ? temporary : "/tmp");
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

typedef char word[LONG + 1];

static void make_value(fuzz_input *in, const option_spec *spec, char *to)
{
    static const char *const common[] = {"0", "1", "-1", "2", "7", "100", "2147483647", "-2147483648", "2147483648", "99999999999999999999", "1e308", "-1e308", "1e999", "-1e-320", "4.9e-324", "nan", "NaN", "-nan", "nan(1)",
                                         "inf", "-infinity", "0x10", "0x1p-1074", "1.5", "1e2", "1,5", "1e", "--1", "+5", "007", " 3", "3 ", "\t7", "1 2", "", "-", "--", "-h", "--help", "-t", "-o", "-n", "-out", "-nonsense",
                                         ".", "no/such/folder", "no/such/folder/x.csv", "/dev/full", "/dev/null/x", "./x", "a b", "x\ny", "*", "%s%n", "\xff\xfe", "wendland-c2", "cubic", "all"};
    const int how = fuzz_below(in, 8);
    int k;
    if (how == 0 && spec) snprintf(to, LONG, "%.17g", spec->lowest + fuzz_below(in, 3) - 1.0); /* at and next to the limits */
    else if (how == 1 && spec) snprintf(to, LONG, "%.17g", spec->highest + fuzz_below(in, 3) - 1.0);
    else if (how == 2 && spec) snprintf(to, LONG, spec->type == OPTION_INT ? "%.0f" : "%g", fmax(-1e9, spec->lowest) + fuzz_unit(in) * (fmin(1e9, spec->highest) - fmax(-1e9, spec->lowest)));
    else if (how == 3) snprintf(to, LONG, "%.*g", fuzz_below(in, 20), fuzz_any(in));
    else if (how == 4) {
        const int length = fuzz_below(in, 24);
        for (k = 0; k < length; k++) {
            const char c = (char)fuzz_byte(in);
            to[k] = c == '/' || c == '\0' ? '.' : c; /* stays in its folder */
        }
        to[length] = '\0';
    } else if (how == 5 && fuzz_below(in, 8) == 0) {
        memset(to, "9ax-"[fuzz_below(in, 4)], LONG);
        to[LONG] = '\0';
    } else strcpy(to, common[fuzz_below(in, (int)(sizeof common / sizeof *common))]);
}

/* What a driver must answer to the words: the status, and what its message must hold; -1 if nothing is wrong with them. */
static int expected(const program *p, char **words, int count, char *message, size_t room)
{
    int k;
    int n;
    double x;
    const char *text;
    message[0] = '\0';
    for (k = 0; k < count; k++)
        if (strcmp(words[k], "-h") == 0 || strcmp(words[k], "--help") == 0) return 0;
    for (k = 0; k < count; k++) {
        const option_spec *const known = option_find(p->specs, p->count, words[k]);
        option_spec spec;
        if (!known) return snprintf(message, room, "unknown option '%s'", words[k]), 2;
        if (known->type == OPTION_FLAG) continue;
        spec = *known;
        spec.value = spec.type == OPTION_INT ? (void *)&n : spec.type == OPTION_REAL ? (void *)&x : (void *)&text;
        if (++k == count) return snprintf(message, room, "option %s: its value is missing", words[k - 1]), 2;
        if (!option_set(&spec, words[k])) return snprintf(message, room, "option %s: '%s' is not allowed", words[k - 1], words[k]), 2;
    }
    return -1;
}

static void check_options(char **words, int count)
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

static int is_option(const program *p, const char *text)
{
    int k;
    for (k = 0; k < p->count; k++)
        if (strcmp(p->names[k], text) == 0) return 1;
    return strcmp(text, "-h") == 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static word words[WORDS];
    static char message[2 * LONG];
    fuzz_input in = {data, size, 0};
    char nonsense[] = "-nonsense", *argv[WORDS + 3];
    const program *p;
    int k = 0, count, want, right;
    outcome o;
    if (!folder[0]) find_programs();
    if (program_count == 0) return 0;
    p = &programs[fuzz_below(&in, program_count)];
    count = fuzz_below(&in, WORDS + 1);
    argv[0] = (char *)(uintptr_t)p->path;
    while (k < count) { /* mostly an option of the program, and a value for it */
        const int how = fuzz_below(&in, 8), option = p->count > 0 ? fuzz_below(&in, p->count) : -1;
        const option_spec *const spec = p->strict && option >= 0 ? &p->specs[option] : NULL;
        if (how < 7 && option >= 0) strcpy(words[k++], p->names[option]);
        if (k < count && how > 0 && (!spec || how == 7 || spec->type != OPTION_FLAG)) make_value(&in, spec, words[k++]);
    }
    for (k = 0; k < count; k++) argv[k + 1] = words[k];
    if (count > 0) check_options(argv + 1, count);
    if (p->strict && fuzz_below(&in, 8)) argv[++k] = nonsense; /* mostly: so that it does not start to compute */
    argv[k + 1] = NULL;
    want = -1;
    if (p->strict) want = expected(p, argv + 1, k, message, sizeof message);
    else if (p->tested && k > 0 && !is_option(p, argv[1])) {
        want = 2;
        strcpy(message, "unknown option");
    }
    o = run(p->path, argv, want >= 0 ? 5000 : 200, 2);
    if (want < 0 && WIFSIGNALED(o.status) && (WTERMSIG(o.status) == SIGALRM || WTERMSIG(o.status) == SIGXFSZ)) return 0;
    if (want >= 0) right = WIFEXITED(o.status) && WEXITSTATUS(o.status) == want && (want != 2 || strstr(o.text, message));
    else right = WIFEXITED(o.status) && WEXITSTATUS(o.status) <= 2 && (WEXITSTATUS(o.status) != 2 || o.text[0]);
    if (!right) {
        fprintf(stderr, "%s ended with %s %d, expected %d '%s'\n", p->path, WIFEXITED(o.status) ? "status" : "signal", WIFEXITED(o.status) ? WEXITSTATUS(o.status) : WTERMSIG(o.status), want, want == 2 ? message : "");
        for (k = 1; argv[k]; k++) fprintf(stderr, "    '%s'\n", argv[k]);
        fprintf(stderr, "%s\n", o.text);
        abort();
    }
    return 0;
}
