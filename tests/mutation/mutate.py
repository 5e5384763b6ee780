#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Breaks the formulas of the headers, one at a time, and tells how many of the broken headers the tests notice.

    python3 tests/mutation/mutate.py [-n 400] [-seed 1] [-only sph_mhd] [-cc tcc]          from the root of the repository

A mutant is one change in the body of one function: a sign, an operator, a constant, a component, i for j, a comparison. They are spread over all functions. A mutant is killed if a test
program does not compile, fails, crashes or takes more than LIMIT seconds of CPU. Survivors are printed; those in tests/mutation/equivalent.txt (function, changed line, reason) change nothing that
can be seen and do not count. Most time goes into compiling, which is why tcc is the default: 400 mutants take it about half an hour.
"""
import argparse
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import time

HEADERS = ("sph_kernels.h", "sph_ops.h", "sph.h")
# cheap ones first; those that name the function, or are of its subject, come before all; that of the search is slow, and for sph.h only (with those that call all functions)
TESTS = "known_answers kernels collisions gravity density derivatives fluid invariance gradients contract degenerate elliptic cleaning periodic".split()
SEARCH = ["contract", "degenerate", "neighbors", "periodic"]
SUBJECTS = {"mhd": "cleaning", "cleaning": "cleaning", "elliptic": "elliptic", "mobility": "elliptic", "row": "elliptic", "csr": "elliptic", "fluid": "fluid", "viscos": "fluid", "pressure": "fluid",
            "wall": "fluid", "colli": "collisions", "gravity": "gravity", "density": "density", "block": "derivatives", "cspm": "derivatives", "moment": "derivatives",
            "wls": "derivatives", "kernel": "kernels", "laplacian": "gradients"}
LIMIT = 90


def functions(text):
    """(name, start, end) of the bodies of all SPH_FN functions"""
    for m in re.finditer(r"^SPH_FN [^;{}]*?(\w+)\([^;{}]*\)\s*\{", text, re.M):
        depth, end = 1, m.end()
        while depth:
            depth += {"{": 1, "}": -1}.get(text[end], 0)
            end += 1
        yield m.group(1), m.end(), end - 1


def constant(number):
    value = float(number)
    return "SPH_R(%r)" % (value * 1.01 if value else 0.01)


def mutations(body):
    """(start, end, replacement) of each change to a body"""
    rules = [
        (r" \+ ", lambda m: " - "), (r"(?<=[\w)\]]) - ", lambda m: " + "), (r" \* ", lambda m: " / "), (r"(?<=[\w)]) / ", lambda m: " * "), (r"\+=", lambda m: "-="), (r"-=", lambda m: "+="),
        (r"SPH_R\((\d+(?:\.\d*)?(?:e-?\d+)?)\)", lambda m: constant(m.group(1))),
        (r"(?<=\w)\.x\b", lambda m: ".y"), (r"(?<=\w)\.y\b", lambda m: ".z"), (r"(?<=\w)\.z\b", lambda m: ".x"),
        (r" < ", lambda m: " >= "), (r" > ", lambda m: " <= "), (r" <= ", lambda m: " > "), (r" >= ", lambda m: " < "), (r" == ", lambda m: " != "), (r" != ", lambda m: " == "), (r" && ", lambda m: " || "),
        (r" \|\| ", lambda m: " && "), (r"dim > 1", lambda m: "dim > 2"), (r"dim > 2", lambda m: "dim > 1"), (r"SPHI_ABS\(", lambda m: "("), (r"= -(?=\w)", lambda m: "= "),
        (r"\b(\w+)_i\b", lambda m: m.group(1) + "_j" if m.group(1) + "_j" in body else None), (r"\b(\w+)_j\b", lambda m: m.group(1) + "_i" if m.group(1) + "_i" in body else None)]
    code = re.sub(r"/\*.*?\*/", lambda m: " " * len(m.group()), body, flags=re.S)
    code = re.sub(r'"(?:\\.|[^"\\\n])*"', lambda m: " " * len(m.group()), code)
    code = re.sub(r"^#.*$", lambda m: " " * len(m.group()), code, flags=re.M)
    for pattern, change in rules:
        for m in re.finditer(pattern, code):
            new = change(m)
            if new and new != m.group():
                yield m.start(), m.end(), new


def choose(count, only, rng):
    """count mutants, from all functions in turn"""
    pool = []
    for header in HEADERS:
        text = open(header).read()
        for name, start, end in functions(text):
            found = [(header, name, start + a, start + b, new) for a, b, new in mutations(text[start:end])]
            if found and only in name:
                rng.shuffle(found)
                pool.append(found)
    rng.shuffle(pool)
    chosen = []
    while pool and len(chosen) < count:
        for found in pool:
            chosen.append(found.pop())
        pool = [found for found in pool if found]
    return chosen[:count]


def order(header, name):
    if header == "sph.h":
        return SEARCH

    def relevance(test):
        text = open("tests/test_%s.c" % test).read()
        return (name not in text and not any(test == t and s in name for s, t in SUBJECTS.items()), TESTS.index(test))
    return sorted((t for t in TESTS if os.path.exists("tests/test_%s.c" % t)), key=relevance)


def run(command, folder):
    def limit():
        resource.setrlimit(resource.RLIMIT_CPU, (LIMIT, LIMIT))
    return subprocess.run(command, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, preexec_fn=limit).returncode == 0


def killed(cc, folder, header, name):
    """the test that notices, or None"""
    for test in order(header, name):
        compiler = "cc -O1" if test == "neighbors" else cc
        if not run([*compiler.split(), "-std=c99", "-w", "-DCHECK_STOP", "-I.", "-o", "test", "tests/test_%s.c" % test, "-lm"], folder) or not run(["./test"], folder):
            return test
    return None


def preprocessed(cc, folder):
    return subprocess.run([*cc.split(), "-E", "-I.", "tests/test_neighbors.c"], cwd=folder, capture_output=True, check=True).stdout


def main():
    p = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    p.add_argument("-n", type=int, default=400, help="mutants")
    p.add_argument("-seed", type=int, default=1)
    p.add_argument("-only", default="", help="functions whose name contains this")
    p.add_argument("-cc", default="tcc" if shutil.which("tcc") else "cc -O0")
    a = p.parse_args()
    equivalent = {}
    for line in open("tests/mutation/equivalent.txt"):
        if line.strip() and not line.startswith("#"):
            function, change, reason = line.rstrip("\n").split(" | ")
            equivalent[function, change] = reason
    folder = tempfile.mkdtemp(prefix="mutants-")
    shutil.copytree("tests", folder + "/tests")
    shutil.copytree("examples/common", folder + "/examples/common")
    shutil.copytree("examples/papers", folder + "/examples/papers")
    for h in HEADERS:
        shutil.copy(h, folder)
    first = killed(a.cc, folder, "sph_ops.h", "") or killed(a.cc, folder, "sph.h", "")
    if first:
        sys.exit("tests/test_%s.c fails on the headers as they are" % first)
    original = preprocessed(a.cc, folder)
    chosen = choose(a.n, a.only, random.Random(a.seed))
    dead = same = absent = 0
    survivors = []
    began = time.time()
    for number, (header, name, start, end, new) in enumerate(chosen):
        text = open(header).read()
        mutant = text[:start] + new + text[end:]
        line = mutant[mutant.rfind("\n", 0, start) + 1:mutant.find("\n", start)].strip()
        open(folder + "/" + header, "w").write(mutant)
        if preprocessed(a.cc, folder) == original:
            absent += 1 # in code for another machine
        else:
            test = killed(a.cc, folder, header, name)
            if test:
                dead += 1
            elif (name, line) in equivalent:
                same += 1
            else:
                survivors.append((name, line))
                print("survives: %s | %s" % (name, line), flush=True)
        shutil.copy(header, folder)
        if sys.stderr.isatty() or number % 20 == 19:
            print("%d of %d, %d survive, %.0f s" % (number + 1, len(chosen), len(survivors), time.time() - began), end="\r" if sys.stderr.isatty() else "\n", file=sys.stderr, flush=True)
    shutil.rmtree(folder)
    judged = dead + len(survivors)
    print("%d mutants: %d killed, %d survive, %d equivalent, %d not compiled here: %.1f %% killed" % (len(chosen), dead, len(survivors), same, absent, 100.0 * dead / max(judged, 1)))
    return judged == 0 or dead < 0.95 * judged


if __name__ == "__main__":
    sys.exit(main())
