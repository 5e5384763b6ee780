#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the functions of the headers, one at a time, and tells how many of the broken headers the tests see.

    python3 tests/mutation/mutate.py [-n 400] [-seed 1] [-only sph_mhd]        from the root of the repository
    python3 tests/mutation/mutate.py -header sph.h -build portable openmp native -n 60

A mutant is one change in the body of one function: a sign, an operator, a constant, a component, i for j, a
comparison; in the search also a number that is one more, a bound, a shift, a bit operation, a condition that
always or never holds, an assignment that is left out. They are spread over all functions. A mutant is killed
if a test program does not compile, fails, crashes or takes much more CPU time than with the header as it is.
Survivors are printed; those in tests/mutation/equivalent.txt, which nothing can tell, do not count.

Builds: portable C; the search with OpenMP's threads (openmp); with what this processor has (native: AVX2 or
AVX-512). The latter two break sph.h alone, because the other headers have no code of their own for them. Most
time goes into compiling, which is why tcc compiles the tests of formulas.
"""
import argparse
import collections
import concurrent.futures
import os
import queue
import random
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import time

HEADERS = ("sph_kernels.h", "sph_ops.h", "sph.h")
# cheap ones first; those that name the function, or are of its subject, come before all
TESTS = ("known_answers kernels collisions gravity density derivatives fluid invariance gradients contract "
         "degenerate elliptic cleaning periodic").split()
# For sph.h alone; the first is soon done, which is where loops without end end. One copy of each function
# compiles sooner, but the search itself is faster with its copies.
SEARCH = "index_range neighbors capacity degenerate contract periodic".split()
ONE_COPY = ["-include", "tests/one_copy.h"]
SUBJECTS = {"mhd": "cleaning", "cleaning": "cleaning", "elliptic": "elliptic", "mobility": "elliptic",
            "row": "elliptic", "csr": "elliptic", "fluid": "fluid", "viscos": "fluid", "pressure": "fluid",
            "wall": "fluid", "colli": "collisions", "gravity": "gravity", "density": "density",
            "block": "derivatives", "cspm": "derivatives", "moment": "derivatives", "wls": "derivatives",
            "kernel": "kernels", "laplacian": "gradients"}
BUILDS = {"portable": [], "openmp": ["-fopenmp", "-DSPH_OPENMP=1"], "native": ["-march=native"]}
# Three threads divide few counts evenly. They sleep where they wait: what they spin would count as CPU time.
THREADS = {"OMP_NUM_THREADS": "3", "OMP_WAIT_POLICY": "passive"}
PATIENCE, LEAST = 2, 5 # so many times the CPU time of the header as it is, and so many seconds more
LONGEST = 900 # seconds of CPU for anything else
SLEEPY = 10 # so many times that by the clock
OUTCOMES = KILLED, SURVIVES, EQUIVALENT, ABSENT = "killed", "survive", "equivalent", "not compiled here"
MEMORY = 8 << 20 # KiB: lists of a wrong length may be huge

# new instead of what stands from start to end; the function from first to last
Mutant = collections.namedtuple("Mutant", "build header function first last start end new")


def code_of(text):
    """the text with comments, strings and preprocessor lines as blanks"""
    for pattern, flags in ((r"/\*.*?\*/", re.S), (r'"(?:\\.|[^"\\\n])*"', 0), (r"^#(?:.*\\\n)*.*$", re.M)):
        text = re.sub(pattern, lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=flags)
    return text


def functions(code):
    """(name, where it begins, where its body begins, where it ends) of all functions"""
    for m in re.finditer(r"^(?:\S.*)?\b(?:SPH_FN|SPHI_LARGE) [^;{}]*?(\w+)\([^;{}()]*\)\s*\{", code, re.M):
        depth, end = 1, m.end()
        while depth:
            depth += {"{": 1, "}": -1}.get(code[end], 0)
            end += 1
        yield m.group(1), m.start(), m.end(), end


def constant(number):
    value = float(number)
    return "SPH_R(%r)" % (value * 1.01 if value else 0.01)


def swap(pairs):
    """rules that put each of two operators for the other"""
    for a, b in pairs:
        for old, new in ((a, b), (b, a)):
            yield re.escape(old), lambda m, new=new: new


FORMULA = [
    (r" \+ ", lambda m: " - "), (r"(?<=[\w)\]]) - ", lambda m: " + "),
    (r" \* ", lambda m: " / "), (r"(?<=[\w)]) / ", lambda m: " * "),
    *swap([("+=", "-="), (" < ", " >= "), (" > ", " <= "), (" == ", " != "), (" && ", " || ")]),
    (r"SPH_R\((\d+(?:\.\d*)?(?:e-?\d+)?)\)", lambda m: constant(m.group(1))),
    (r"(?<=\w)\.x\b", lambda m: ".y"), (r"(?<=\w)\.y\b", lambda m: ".z"), (r"(?<=\w)\.z\b", lambda m: ".x"),
    *swap([("dim > 1", "dim > 2")]), (r"SPHI_ABS\(", lambda m: "("), (r"= -(?=\w)", lambda m: "= ")]
INTEGER = [
    *swap([(" < ", " <= "), (" > ", " >= "), (" << ", " >> "), (" & ", " | "), ("&=", "|=")]),
    (r" [-+] 1\b(?!\.)", lambda m: ""),
    # the length of an array apart
    (r"(?<![\w.])(?<!SPH_R\()\d+(?![\w.])(?!\](?:;| = \{))", lambda m: str(int(m.group()) + 1)),
    (r"\+\+\)", lambda m: " += 2)"), (r"\+\+(?!\))|--", lambda m: ""), # of a loop, and others
    (r" \? ", lambda m: " || 1 ? "), (r" \? ", lambda m: " && 0 ? "),
    (r"!(?=[\w(])", lambda m: ""), (r"\bcontinue;", lambda m: "break;"),
    (r"\bif \(", lambda m: "if (1 || "), (r"\bif \(", lambda m: "if (0 && "),
    (r"(?<=\n) +[\w.>\[\]*-]+ [-+*/|&]?= [^;{}]*;(?= *\n)", lambda m: "/* " + m.group().strip() + " */")]


def mutations(body, rules):
    """(start, end, replacement) of each change to a body"""
    found = {}
    for pattern, change in rules:
        for m in re.finditer(pattern, body):
            found[m.start(), m.end(), change(m)] = None
    for a, b in (("_i", "_j"), ("_j", "_i")):
        for m in re.finditer(r"\b(\w+)%s\b" % a, body):
            if m.group(1) + b in body:
                found[m.start(), m.end(), m.group(1) + b] = None
    return list(found)


def choose(a, texts, build, rng):
    """a.n mutants, from all functions in turn"""
    pool = []
    for header in a.header or (HEADERS if build == "portable" else ["sph.h"]):
        code = code_of(texts[header])
        rules = FORMULA + (INTEGER if header == "sph.h" else [])
        for name, first, body, last in functions(code):
            found = [Mutant(build, header, name, first, last, body + start, body + end, new)
                     for start, end, new in mutations(code[body:last], rules)]
            if found and re.search(a.only, name):
                rng.shuffle(found)
                pool.append(found)
    rng.shuffle(pool)
    chosen = []
    while pool and len(chosen) < a.n:
        for found in pool:
            chosen.append(found.pop())
        pool = [found for found in pool if found]
    return chosen[:a.n]


def order(header, name):
    def relevance(test):
        text = open("tests/test_%s.c" % test).read()
        subject = any(test == t and s in name for s, t in SUBJECTS.items())
        return (name not in text and not subject, TESTS.index(test))
    tests = SEARCH if header == "sph.h" else sorted(TESTS, key=relevance)
    return [t for t in tests if os.path.exists("tests/test_%s.c" % t)]


class Judge:
    """runs the tests in folders that have a copy of what they need, as many at a time as there are folders"""

    def __init__(self, cc, texts, top, jobs):
        self.cc = cc
        self.texts = texts
        self.limits = {} # seconds, by what compiles the test
        self.originals = {} # what the preprocessor makes of the header as it is, by build
        self.folders = queue.SimpleQueue()
        for job in range(jobs):
            folder = "%s/%d" % (top, job)
            for part in ("tests", "examples/common", "examples/papers"):
                shutil.copytree(part, folder + "/" + part)
            for header, text in texts.items():
                write(folder, header, text)
            self.folders.put(folder)

    def preprocessed(self, folder, build):
        command = ["cc", *BUILDS[build], "-E", "-I.", "tests/test_capacity.c"]
        return subprocess.run(command, cwd=folder, capture_output=True, check=True).stdout

    def run(self, command, folder, limit):
        """(whether it succeeds, seconds of CPU)"""
        script = 'ulimit -t "$0"; ulimit -v "$1"; shift; exec "$@"'
        nowhere = subprocess.DEVNULL
        p = subprocess.Popen(["sh", "-c", script, str(limit), str(MEMORY), *command], cwd=folder,
                             env={**os.environ, **THREADS}, stdout=nowhere, stderr=nowhere)
        sleeper = threading.Timer(SLEEPY * limit, p.kill) # threads may wait for each other for ever
        sleeper.start()
        p.returncode, used = os.wait4(p.pid, 0)[1:]
        sleeper.cancel()
        return p.returncode == 0, used.ru_utime + used.ru_stime

    def killer(self, folder, build, header, name):
        """the test that notices, or None"""
        for test in order(header, name):
            compiler = ["cc", "-O1", *BUILDS[build]]
            if header != "sph.h" and build == "portable":
                compiler = self.cc.split()
            elif test != "neighbors":
                compiler += ONE_COPY
            source = "tests/test_%s.c" % test
            command = (*compiler, "-std=c99", "-w", "-DCHECK_STOP", "-I.", "-o", "test", source, "-lm")
            if not self.run(command, folder, LONGEST)[0]:
                return test
            passes, seconds = self.run(["./test"], folder, self.limits.get(command, LONGEST))
            if not passes:
                return test
            self.limits.setdefault(command, int(PATIENCE * seconds) + LEAST)
        return None

    def learn(self, build, headers):
        """what the headers as they are give"""
        folder = self.folders.get()
        self.originals[build] = self.preprocessed(folder, build)
        for header in headers:
            test = self.killer(folder, build, header, "")
            if test:
                sys.exit("tests/test_%s.c fails on the headers as they are" % test)
        self.folders.put(folder)

    def judge(self, mutant):
        """killed by a test, alive, or not there"""
        text = self.texts[mutant.header]
        folder = self.folders.get()
        write(folder, mutant.header, text[:mutant.start] + mutant.new + text[mutant.end:])
        if self.preprocessed(folder, mutant.build) == self.originals[mutant.build]:
            outcome = ABSENT # in code for another build
        else:
            test = self.killer(folder, mutant.build, mutant.header, mutant.function)
            outcome = KILLED if test else SURVIVES
        write(folder, mutant.header, text)
        self.folders.put(folder)
        return outcome


def write(folder, name, text):
    with open(folder + "/" + name, "w") as f:
        f.write(text)


def squeezed(text):
    return re.sub(r"\s", "", text)


def equivalents():
    """(function, changed line, builds) of the mutants that are known to change nothing"""
    for line in open("tests/mutation/equivalent.txt"):
        if line.strip() and not line.startswith("#"):
            function, change, _, *builds = line.rstrip("\n").split(" | ")
            yield function, squeezed(change), builds[0].split() if builds else BUILDS


def is_known(mutant, text, known):
    """whether a line that is known is new in the function, wherever lines end"""
    before = squeezed(text[mutant.first:mutant.last])
    after = squeezed(text[mutant.first:mutant.start] + mutant.new + text[mutant.end:mutant.last])
    return any(function == mutant.function and mutant.build in builds and line in after and line not in before
               for function, line, builds in known)


def changed_line(mutant, text):
    broken = text[:mutant.start] + mutant.new + text[mutant.end:]
    return broken[broken.rfind("\n", 0, mutant.start) + 1:broken.find("\n", mutant.start)].strip()


def report(build, header, counts):
    """one line; the share that is killed of those that something could tell"""
    judged = counts[KILLED] + counts[SURVIVES]
    share = 100.0 * counts[KILLED] / max(judged, 1)
    outcomes = ", ".join("%d %s" % (counts[o], o) for o in OUTCOMES)
    print("%s, %s: %d mutants: %s: %.1f %% killed" % (header, build, sum(counts.values()), outcomes, share))
    return judged == 0 or share >= 95


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("-n", type=int, default=400, help="mutants in each build")
    p.add_argument("-seed", type=int, default=1)
    p.add_argument("-only", default="", help="functions in whose name this regular expression is found")
    p.add_argument("-header", nargs="+", choices=HEADERS, help="these headers only")
    p.add_argument("-build", nargs="+", choices=BUILDS, default=["portable"])
    p.add_argument("-j", type=int, default=2, help="mutants at a time")
    tcc = "tcc" if shutil.which("tcc") else "cc -O0"
    p.add_argument("-cc", default=tcc, help="compiles the tests of formulas")
    a = p.parse_args()
    known = list(equivalents())
    texts = {header: open(header).read() for header in HEADERS}
    chosen = [m for build in a.build for m in choose(a, texts, build, random.Random(a.seed))]
    counts = collections.defaultdict(collections.Counter)
    began = time.time()
    workers = concurrent.futures.ThreadPoolExecutor(a.j)
    with tempfile.TemporaryDirectory(prefix="mutants-") as top, workers:
        judge = Judge(a.cc, texts, top, a.j)
        for build in a.build:
            judge.learn(build, sorted({m.header for m in chosen if m.build == build}))
        for number, (mutant, outcome) in enumerate(zip(chosen, workers.map(judge.judge, chosen))):
            text = texts[mutant.header]
            if outcome == SURVIVES and is_known(mutant, text, known):
                outcome = EQUIVALENT
            counts[mutant.build, mutant.header][outcome] += 1
            if outcome == SURVIVES:
                line = changed_line(mutant, text)
                print("survives, %s: %s | %s" % (mutant.build, mutant.function, line), flush=True)
            if sys.stderr.isatty() or number % 20 == 19:
                print("%d of %d, %.0f s" % (number + 1, len(chosen), time.time() - began),
                      end="\r" if sys.stderr.isatty() else "\n", file=sys.stderr, flush=True)
    enough = [report(*key, counts[key]) for key in counts]
    return not all(enough)


if __name__ == "__main__":
    sys.exit(main())
