#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes what the hosts in other languages need to know about the headers, from the headers:

    sph_shim_sweeps.h, sph_shim_sweeps.c    an exported symbol for every operator of the list tier
    sph/c.py, sph/operators.py              structs, constants and functions for Python (generate_python.py)
    sph_c.f90                               the same for Fortran (generate_fortran.py)
    sph_c.js                                structs and constants for JavaScript (generate_javascript.py)

    python3 examples/hosts/generate.py [FOLDER]     into FOLDER, or where they are checked in
    python3 examples/hosts/generate.py -l           lists what is exported, and what is not

Nothing but the standard library is needed. Run it when a prototype, a struct or an enum of the headers has
changed; tests/hosts/generated.sh fails until then.

What is exported:
    sweep     every function of the list tier: it takes a cloud, points, a query, a grid or a permutation
    number    every function of numbers alone that answers a number: kernels, sizes of memory, time steps
    text      every function that answers a text, or reads one
What is not: constructors of structs (a host fills them itself; sph_shim.h exports the ones that do more), and
the pair functions, which a host without C could only call at a great price."""

import os
import re
import sys
from collections import namedtuple

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.join(HERE, "..", "..")
HEADERS = "sph_kernels.h", "sph_ops.h", "sph.h"

# A type is its C name without const and *, as in the header: sph_real, int, size_t, sph_cloud, unsigned char.
# pointer: how many *; const: of what is pointed to.
Field = namedtuple("Field", "name type pointer const array comment")  # array: its length as written, or ""
Struct = namedtuple("Struct", "name fields comment")
Value = namedtuple("Value", "name value comment")
Enum = namedtuple("Enum", "name values comment")
Argument = namedtuple("Argument", "name type pointer const")
# returns: its type, as an Argument without a name; kind: sweep, number or text; doc: the comment above it;
# summary: its line of the header's index; sibling: where doc says "the same", of what
Function = namedtuple("Function", "name returns arguments kind doc summary sibling header")
# structs: those that exported functions need, in the order of their definition
Model = namedtuple("Model", "version structs enums functions left_out")

NUMBERS = {"sph_real", "sph_index", "int", "unsigned", "size_t", "int64_t", "sph_kernel"}
# what makes a function one of the list tier
LISTS = {"sph_cloud", "sph_points", "sph_query", "sph_grid"}
# structs that say how many particles there are: without them there is nothing to do, and no error to see
COUNTED = {"sph_cloud", "sph_points", "sph_query", "sph_grid", "sph_neighbors"}
# sweeps that are compiled with constant kernels, too: what most programs spend their time in
FOLDED = {
    "sph_density_summation",
    "sph_gradient_cspm",
    "sph_laplacian_brookshaw",
    "sph_elliptic_rows_msph",
    "sph_fluid_rates_monaghan",
}
COMMENT = re.compile(r"/\*.*?\*/", re.S)


def plain(comment):
    """the text of a comment on one line"""
    text = re.sub(r"^/\*+|\*+/$", "", comment.strip())
    return " ".join(re.sub(r"^\s*\* ?", "", line).strip() for line in text.splitlines()).strip()


def bare(text):
    """code without comments and without the marks that mean nothing to a host"""
    text = COMMENT.sub(" ", text)
    return " ".join(re.sub(r"\bSPH_GLOBAL\b|\bSPH_RESTRICT\b|\bSPHI_TCC_PAD\b", " ", text).split())


def declarators(declaration):
    """const sph_real *x, *y -> (type, const, [(name, pointer, array)])"""
    match = re.match(r"(const )?(unsigned char|\w+)\s*(.*)$", declaration)
    const, kind, rest = bool(match.group(1)), match.group(2), match.group(3)
    parts = []
    for part in rest.split(","):
        m = re.match(r"\s*(\**)\s*(\w+)\s*(?:\[(.*)\])?\s*$", part)
        if not m:
            raise SyntaxError(f"cannot read '{declaration}'")
        parts.append((m.group(2), len(m.group(1)), m.group(3) or ""))
    return kind, const, parts


def fields_of(body):
    """fields with their comments: the ones above a field, or behind it on its line"""
    fields, above, at = [], "", 0
    pattern = re.compile(r"(/\*.*?\*/)|([^;/]+);[ \t]*(/\*.*?\*/)?", re.S)
    while True:
        body_left = body[at:].lstrip()
        at = len(body) - len(body_left)
        match = pattern.match(body, at)
        if not match:
            if bare(body_left):
                raise SyntaxError(f"cannot read the fields '{body_left[:80]}'")
            return fields
        at = match.end()
        if match.group(1):
            above = plain(match.group(1))
            continue
        kind, const, parts = declarators(bare(match.group(2)))
        comment = plain(match.group(3)) if match.group(3) else above
        above = ""
        fields += [Field(name, kind, pointer, const, array, comment) for name, pointer, array in parts]


def kernels_of(text):
    """the entries of the table SPH_KERNELS"""
    table = re.search(r"#define SPH_KERNELS\(.*?\n(.*?[^\\])\n", text, re.S).group(1)
    return re.findall(r"each\(context, (\w+), \"([^\"]+)\"", table)


def enum_of(name, body, comment, text):
    values, number = [], 0
    if name == "sph_kernel":
        for identifier, title in kernels_of(text):
            values.append(Value(identifier, number, title))
            number += 1
        body = body[body.index(")") + 1 :]
    known = {v.name: v.value for v in values}
    for entry, remark in re.findall(r"([^,/]+?),?[ \t]*(/\*.*?\*/|\n|$)", body, re.S):
        entry = bare(entry)
        for part in filter(None, (p.strip() for p in entry.split(","))):
            identifier, _, given = (p.strip() for p in part.partition("="))
            number = known[given] if given in known else int(given, 0) if given else number
            known[identifier] = number
            values.append(Value(identifier, number, plain(remark) if remark.startswith("/*") else ""))
            number += 1
    return Enum(name, values, comment)


def summaries_of(text):
    """what the index of a header says of each function"""
    opening = text[: text.index("*/")]
    index = opening[opening.index("* INDEX") :]
    found, last = {}, None
    for line in index.splitlines()[1:]:
        line = re.sub(r"^ \* ?", "", line)
        calls = list(re.finditer(r"(sph_\w+)\(([^()]*)\)", line))
        if calls:
            last = calls[-1].group(1)
            for call in calls:
                found[call.group(1)] = ""
            found[last] = line[calls[-1].end() :].strip()
        elif last and line.startswith(" " * 20) and "sph_" not in line:
            found[last] = (found[last] + " " + line.strip()).strip()
        else:
            last = None
    return found


def read(headers=HEADERS, root=ROOT):
    """the model of the headers"""
    structs, enums, functions, left_out, version = [], [], [], [], 0
    for header in headers:
        with open(os.path.join(root, header), encoding="utf-8") as file:
            text = file.read()
        version = (
            int(re.search(r"#define SPH_VERSION (\d+)", text).group(1)) if "kernels" in header else version
        )
        summaries = summaries_of(text)
        for match in re.finditer(r"typedef (struct|enum) (sph_\w+) \{(.*?)\n\} \2;", text, re.S):
            kind, name, body = match.groups()
            above = re.search(
                r"(/\*(?:[^*]|\*(?!/))*\*/)\n(?:/\* clang-format off \*/\n)?$", text[: match.start()]
            )
            comment = plain(above.group(1)) if above else ""
            if kind == "enum":
                enums.append(enum_of(name, body, comment, text))
            elif "SPHI_SUMS" not in body:
                structs.append(Struct(name, fields_of(body), comment))
        doc = first = ""
        for match in re.finditer(
            r"(/\*(?:[^*]|\*(?!/))*\*/\n)?^SPH_FN ([^(){};]*?[ *])(sph_\w+)\(([^;{}]*?)\)\s*\{", text, re.M
        ):
            comment, returns, name, arguments = match.groups()
            if comment:
                doc = plain(comment)
                first = first if re.match(r"The same\b", doc) else name
            kind, const, [(_, pointer, _)] = declarators(bare(returns) + " answer")
            answer = Argument("", kind, pointer, const)
            taken = []
            for argument in () if bare(arguments) == "void" else bare(arguments).split(","):
                kind, const, [(label, pointer, array)] = declarators(argument.strip())
                label = "kernel" if (kind, label) == ("sph_kernel", "k") else label
                taken.append(Argument(label, kind, pointer, const))
            function = Function(
                name, answer, taken, "", doc, summaries.get(name, ""), first if first != name else "", header
            )
            kind = kind_of(function)
            (functions if kind else left_out).append(function._replace(kind=kind))
    needed = {a.type for f in functions for a in f.arguments + [f.returns]}
    for struct in reversed(structs):
        if struct.name in needed or struct.name in {"sph_neighbors"}:
            needed |= {f.type for f in struct.fields}
    return Model(version, [s for s in structs if s.name in needed], enums, functions, left_out)


def kind_of(function):
    """sweep, number, text, or "" where a function is not exported"""
    taken, answer = function.arguments, function.returns
    if answer.type == "char" or any(a.type == "char" for a in taken):
        return "text"
    if answer.type not in NUMBERS or (answer.pointer and not any(a.type in LISTS for a in taken)):
        return ""
    if any(a.type in LISTS or (a.type == "sph_index" and a.pointer) for a in taken):
        return "sweep"
    return "number" if taken and all(a.type in NUMBERS and not a.pointer for a in taken) else ""


# ---------------------------------------------------------------- what the emitters share


def exported(argument):
    """the argument as the shim takes it: structs by address, kernels as int"""
    if argument.type == "sph_kernel":
        return argument._replace(type="int")
    if argument.type.startswith("sph_") and argument.type not in NUMBERS and not argument.pointer:
        return argument._replace(pointer=1, const=True)
    return argument


def shim_name(function):
    return "sph_shim_" + function.name[len("sph_") :]


def spelled(argument):
    """in C: const sph_cloud *cloud"""
    return (
        f"{'const ' if argument.const else ''}{argument.type} {'*' * argument.pointer}{argument.name}".strip()
    )


def wrapped(first, items, last, width=110):
    """first + items, in lines of the width, continued under the end of `first`"""
    indent = " " * len(first)
    lines, line = [], first
    for number, item in enumerate(items):
        item += last if number == len(items) - 1 else ", "
        if len(line + item.rstrip()) > width and line.strip():
            lines.append(line.rstrip())
            line = indent
        line += item
    return "\n".join(lines + [line.rstrip()])


# ---------------------------------------------------------------- C


def prototype(function, end, start="", name=None):
    arguments = [spelled(exported(a)) for a in function.arguments] or ["void"]
    answer = spelled(function.returns)
    first = f"{start}{answer}{'' if answer.endswith('*') else ' '}{name or shim_name(function)}("
    return wrapped(first, arguments, ")" + end)


def c_header(model):
    lines = [
        "/* SPDX-License-Identifier: MIT",
        " *",
        (
            " * sph_shim_sweeps.h - part of sph_shim.h, which says how to call these: one exported symbol for"
            " each"
        ),
        (
            " * operator of the headers. Written by examples/hosts/generate.py from the headers: run it again"
            " instead"
        ),
        " * of changing this file. */",
    ]
    for kind, title in (("text", "texts"), ("number", "numbers"), ("sweep", "operators, search and orders")):
        lines += ["", f"/* {title} */"]
        lines += [prototype(f, ";", "SPH_SHIM_EXPORT ") for f in model.functions if f.kind == kind]
    return "\n".join(lines) + "\n"


def c_call(function, kernel, dim):
    """the inline function, with structs by value again"""
    values = []
    for a in function.arguments:
        if a.type == "sph_kernel":
            values.append(kernel)
        elif a.name == "dim":
            values.append(dim)
        elif exported(a).pointer == a.pointer:
            values.append(a.name)
        else:
            values.append(f"*{a.name}" if a.type in COUNTED else f"GIVEN({a.type}, {a.name})")
    return function.name, values


def c_body(function):
    """the definition of an exported function"""
    has_kernel = any(a.type == "sph_kernel" for a in function.arguments)
    has_dim = any(a.name == "dim" for a in function.arguments)
    guards = [
        f'    if (!{a.name}) return missing("{a.name}");'
        for a in function.arguments
        if a.type in COUNTED and not a.pointer
    ]
    if function.kind == "number" and has_dim and function.returns.type == "sph_real":
        guards.append("    if (dim < 1 || dim > 3) return SPH_R(0);")
    if function.kind != "sweep" or not (has_kernel or has_dim):
        name, values = c_call(function, "(sph_kernel)kernel", "dim")
        return "\n".join(
            [prototype(function, ""), "{"] + guards + [wrapped(f"    return {name}(", values, ");"), "}"]
        )
    name, values = c_call(function, "K", "D")
    call = wrapped(f"    {name}(", values, ")", 108).splitlines()
    lines = [f"#define SWEEP({', '.join(['K'] * has_kernel + ['D'] * has_dim)}) \\"]
    lines += [line + " \\" for line in call[:-1]] + [call[-1]]
    answer = f"    sph_index answer = SPH_ERROR_{'KERNEL' if has_kernel else 'DIM'};"
    if function.name in FOLDED:
        folded = "folded_" + function.name[len("sph_") :]
        lines.append(prototype(function, "", "FLATTEN static ", folded))
        lines += ["{", answer, "    CONSTANT_KERNEL_AND_DIM", "    return answer;", "}"]
        guards.append(
            wrapped(
                f"    if (IS_CONSTANT(kernel)) return {folded}(", [a.name for a in function.arguments], ");"
            )
        )
    each = "EVERY_KERNEL_AND_DIM" if has_kernel and has_dim else "EVERY_KERNEL" if has_kernel else "EVERY_DIM"
    lines += (
        [prototype(function, ""), "{", answer]
        + guards
        + ["    " + each, "    return answer;", "}", "#undef SWEEP"]
    )
    return "\n".join(lines)


def c_source(model):
    lines = [
        "/* SPDX-License-Identifier: MIT",
        " *",
        (
            " * sph_shim_sweeps.c - part of sph_shim.c, which includes it. Written by"
            " examples/hosts/generate.py from"
        ),
        " * the headers: run it again instead of changing this file. */",
    ]
    for function in model.functions:
        lines += ["", c_body(function)] if function.kind == "sweep" else [c_body(function)]
    lines += ["", "size_t sph_shim_struct_size(const char *name)", "{", "    if (!name) return 0;"]
    lines += [f'    if (!strcmp(name, "{s.name}")) return sizeof({s.name});' for s in model.structs]
    return "\n".join(lines + ["    return 0;", "}"]) + "\n"


def main(arguments):
    model = read()
    if arguments[:1] == ["-l"]:
        for f in model.functions + model.left_out:
            print(f"{f.kind or '-':7}{f.name}  {f.summary}")
        return 0
    import generate_fortran
    import generate_javascript
    import generate_python

    files = {
        "sph_shim_sweeps.h": c_header(model),
        "sph_shim_sweeps.c": c_source(model),
        "sph_c.f90": generate_fortran.emit(model),
        "sph_c.js": generate_javascript.emit(model),
        "sph/c.py": generate_python.structs(model),
        "sph/operators.py": generate_python.operators(model),
    }
    folder = arguments[0] if arguments else HERE
    for name, text in files.items():
        path = os.path.join(folder, name)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
