# SPDX-License-Identifier: MIT
"""What generate.py writes for Python: structs, constants and prototypes for ctypes (sph/c.py), and a method
or function with a signature and a docstring for every operator (sph/operators.py)."""

import textwrap

from generate import LISTS, NUMBERS, exported

SCALARS = {
    "sph_real": "c_double",
    "sph_index": "c_int32",
    "int": "c_int",
    "unsigned": "c_uint",
    "size_t": "c_size_t",
    "int64_t": "c_int64",
    "unsigned char": "c_ubyte",
}
OPENING = '''# SPDX-License-Identifier: MIT
"""{0}
Written by examples/hosts/generate.py from the headers: run it again instead of changing this file."""
'''
# what a sweep reads and changes, not a new array
CHANGED = {"velocity", "position"}
# written by hand in sph/__init__.py, or to be had from sph.library() alone: they share a grid of the caller's
BY_HAND = {
    "sph_search",
    "sph_search_size",
    "sph_permute",
    "sph_permute_inverse",
    "sph_rebuild_due",
    "sph_csr_size",
    "sph_csr_assemble",
    "sph_grid_build",
    "sph_grid_lists",
    "sph_grid_count",
    "sph_grid_permutation",
    "sph_grid_renumber",
    "sph_grid_workspace",
    "sph_grid_permutation_own",
    "sph_grid_pair_radius",  # the arithmetic of a grid is for those who make lists on a device
    "sph_grid_cell",
    "sph_grid_cell_periodic",
    "sph_grid_image",
    "sph_grid_wrap",
    "sph_grid_renumber_own",
    "sph_part_of",
    "sph_select_near",
    "sph_list_prune",
    "sph_list_sort",
    "sph_cloud_examine",
    "sph_wall_gamma",  # its elements are no particles, and have a number of their own
}


def is_output(name):
    return name.endswith("_out") or name == "sph_elliptic_report"


def filled(text, indent, width=110):
    return textwrap.fill(
        text,
        width,
        initial_indent=indent,
        subsequent_indent=indent,
        break_on_hyphens=False,
        break_long_words=False,
    )


def structs(model):
    """the text of sph/c.py"""
    lines = [
        OPENING.format("Structs, constants and prototypes of sph_shim.h, for ctypes."),
        (
            "from ctypes import Structure, c_char_p, c_double, c_int, c_int32, c_int64, c_size_t, c_ubyte,"
            " c_uint, c_void_p"
        ),
        "",
        f"VERSION = {model.version}",
    ]
    counts, constants = {}, []
    for enum in model.enums:
        lines += ["", f"# {enum.name}"]
        for value in enum.values:
            counts[value.name] = value.value
            constants.append(value.name[len("SPH_") :])
            remark = f"  # {value.comment}" if value.comment else ""
            line = f"{value.name[len('SPH_'):]} = {value.value}"
            lines.append(line + remark if len(line + remark) <= 110 else line)
    for struct in model.structs:
        lines += ["", "", f"class {struct.name}(Structure):", "    _fields_ = ["]
        for field in struct.fields:
            kind = "c_void_p" if field.pointer else SCALARS.get(field.type, field.type)
            array = f" * {counts.get(field.array, field.array)}" if field.array else ""
            lines.append(f'        ("{field.name}", {kind}{array}),')
        lines.append("    ]")
    lines += [
        "",
        "",
        "STRUCTS = [",
        *[f"    {s.name}," for s in model.structs],
        "]",
        "",
        (
            "# name: (result, arguments). A struct is passed by its address; (type, const) is an array or the"
            " address of"
        ),
        "# a result, c_void_p any memory.",
        "FUNCTIONS = {",
    ]
    for function in model.functions:
        taken = []
        for a in map(exported, function.arguments):
            kind = SCALARS.get(a.type, a.type)
            if a.type == "char":
                kind = "c_char_p"
            elif a.type == "void":
                kind = "c_void_p"
            elif a.pointer and a.type in SCALARS:
                kind = f"({kind}, {a.const})"
            taken.append(f'("{a.name}", {kind})')
        answer = "c_char_p" if function.returns.type == "char" else SCALARS[function.returns.type]
        answer = "c_void_p" if function.returns.pointer and answer != "c_char_p" else answer
        first = f'    "{function.name[len("sph_"):]}": ({answer}, ['
        line = first + ", ".join(taken) + "]),"
        if len(line) > 110:
            line = "\n".join([first] + [f"        {item}," for item in taken] + ["    ]),"])
        lines.append(line)
    lines += ["}", "", "__all__ = [", *[f'    "{name}",' for name in constants], "]"]
    return "\n".join(lines) + "\n"


def parameters(function, model):
    """what a method takes: (name, hint, default or None, its comment in the header), with the members of
    input structs one by one"""
    known = {s.name: s for s in model.structs}
    taken = []

    def add(name, kind, default, comment):
        if kind == "sph_scalars":
            taken.append((name, "Scalars", default and "None", comment))
        elif kind == "sph_vectors" or kind == "sph_diagonal" or kind == "sph_points":
            taken.append((name, "Vectors", default and "None", comment))
        elif kind == "sph_matrices":
            taken.append((name, "Matrices", default and "None", comment))
        elif kind == "sph_vec" or kind == "sph_sym":
            taken.append((name, "Sequence[float]", default and "()", comment))
        elif kind == "sph_real":
            taken.append((name, "float", default and "0.0", comment))
        elif kind in NUMBERS:
            taken.append((name, "int", default and "0", comment))
        else:
            for field in known[kind].fields:
                own = f"{name}_{field.name}"  # a method has no two parameters of one name
                clash = field.name in [t[0] for t in taken]
                add(own if clash else field.name, field.type, True, field.comment)

    for a in function.arguments:
        if a.type in LISTS and a.type != "sph_points" or a.name in ("kernel", "dim") or is_output(a.type):
            if a.name in CHANGED:
                taken.append((a.name, "Vectors", None, "is changed in place"))
            continue
        if a.pointer:
            if a.const or a.name in CHANGED:
                taken.append((a.name, "Indices" if a.type == "sph_index" else "Scalars", None, ""))
            continue
        add(a.name, a.type, False, "")
    if function.name == "sph_density_adaptive":
        taken.insert(1, ("h", "Scalars", None, "first guess of h"))
    names = [t[0] for t in taken]
    if len(set(names)) != len(names):
        raise ValueError(f"{function.name}: two parameters have one name: {names}")
    # no default may stand before a parameter without one
    return [t for t in taken if not t[2]] + [t for t in taken if t[2]]


def docstring(function, indent, taken):
    title = f"{function.name}: {function.summary}" if function.summary else f"{function.name}."
    lines = [filled(f'"""{title}', indent), "", filled(function.doc, indent)]
    if function.sibling and function.sibling != function.name:
        lines += ["", filled(f"(What is the same: see {function.sibling[len('sph_'):]}.)", indent)]
    remarks = [f"{name}: {comment}" for name, _, _, comment in taken if comment]
    if remarks:
        lines += [""] + [filled(remark, indent) for remark in remarks]
    return "\n".join(lines + [indent + '"""']).replace("\\", "\\\\")


def answer_of(function):
    outputs = [a for a in function.arguments if not a.const and (a.pointer or is_output(a.type))]
    outputs = [a for a in outputs if a.name not in CHANGED]
    if not outputs and not any(a.name in CHANGED for a in function.arguments):
        return "int"
    if len(outputs) == 1 and outputs[0].type in ("sph_scalar_out", "sph_vector_out", "sph_matrix_out"):
        return "Array"
    return "Any"


def operators(model):
    """the text of sph/operators.py"""
    lines = [
        OPENING.format("A method for every operator of the headers, and a function for every number."),
        "from typing import Any, Sequence, Union",
        "",
        "Array = Any  # numpy's, or of the module array",
        "Scalars = Union[float, Array, None]  # one number for all, or one for each particle",
        "Vectors = Union[Array, Sequence[Array], None]  # of shape (n, dim), or one array for each component",
        "Matrices = Union[Array, None]  # of shape (n, dim, dim), or one list of arrays for each row",
        "Indices = Array",
        "",
        "",
        "class Operators:",
        '    """The sweeps, as methods of Cloud. Outputs are new arrays."""',
        "",
        "    def _call(self, name: str, values: dict) -> Any:",
        "        raise NotImplementedError",
    ]
    for function in model.functions:
        if function.kind != "sweep" or function.name in BY_HAND:
            continue
        taken = parameters(function, model)
        items = ["self"] + [
            f"{name}: {hint}{f' = {default}' if default else ''}" for name, hint, default, _ in taken
        ]
        answer = answer_of(function)
        first = f"    def {function.name[len('sph_'):]}("
        line = f"{first}{', '.join(items)}) -> {answer}:"
        if len(line) > 110:
            line = "\n".join([first] + [f"        {item}," for item in items] + [f"    ) -> {answer}:"])
        lines += [
            "",
            line,
            docstring(function, " " * 8, taken),
            f'        return self._call("{function.name[len("sph_"):]}", locals())',
        ]
    lines += [
        "",
        "",
        "def _number(name: str, *values: Any) -> Any:",
        "    from . import _number as call",
        "",
        "    return call(name, values)",
    ]
    names = []
    for function in model.functions:
        if function.kind != "number" or function.name in BY_HAND:
            continue
        items = []
        names.append(function.name[len("sph_") :])
        for a in function.arguments:
            hint = "Union[str, int]" if a.type == "sph_kernel" else "float" if a.type == "sph_real" else "int"
            items.append(f"{a.name}: {hint}")
        answer = "float" if function.returns.type == "sph_real" else "int"
        name = function.name[len("sph_") :]
        lines += [
            "",
            "",
            f"def {name}({', '.join(items)}) -> {answer}:",
            docstring(function, " " * 4, []),
            (
                "    return"
                f" _number({', '.join([chr(34) + name + chr(34)] + [a.name for a in function.arguments])})"
            ),
        ]
    lines += ["", "", "__all__ = [", *[f'    "{name}",' for name in names], "]"]
    return "\n".join(lines) + "\n"
