# SPDX-License-Identifier: MIT
"""What generate.py writes for Fortran: the module sph_c, with the structs, constants and functions of the
shim under their C names, in Fortran 2008."""

import textwrap

from generate import exported, shim_name

WIDTH = 110
KINDS = {
    "sph_real": "real(sph_real)",
    "int": "integer(c_int)",
    "unsigned": "integer(c_int)",
    "sph_index": "integer(sph_index)",
    "size_t": "integer(c_size_t)",
    "int64_t": "integer(c_int64_t)",
    "unsigned char": "integer(sph_state)",
    "char": "character(kind=c_char)",
}
OPENING = """\
! SPDX-License-Identifier: MIT
!
! sph_c.f90 - what sph_shim.h exports, for Fortran (2008): structs, constants and functions under the names
! that they have in the headers, which say what they do. The module sph (sph.f90) adds what makes them
! comfortable. Written by examples/hosts/generate.py from the headers: run it again instead of changing this
! file.
!
! Components of structs are zero and null until they are set, as options and outputs want it. Addresses are of
! type(c_ptr), strides count numbers, and particles, starts and list entries count from 0. Two kinds of names
! differ: functions that take or answer a text of C begin with c_, because the module sph has them with
! characters; and Fortran knows no capitals, so that a function with the name of a constant ends with _of.
! For a shim that is compiled with -DSPH_SINGLE=1 or another SPH_INDEX change the kinds below.

module sph_c
    use, intrinsic :: iso_c_binding
    implicit none
    public

    integer, parameter :: sph_real = c_double, sph_index = c_int32_t
    integer, parameter :: sph_state = c_signed_char ! of a sph_status in an array, one byte each
"""

# what is written by hand in sph_shim.h
SHIM = """\
    interface
        ! what the library was compiled as
        pure function sph_version_of() bind(c, name='sph_shim_version') result(answer)
            import
            integer(c_int) :: answer
        end function
        pure function sph_real_size() bind(c, name='sph_shim_real_size') result(answer)
            import
            integer(c_int) :: answer
        end function
        pure function sph_index_size() bind(c, name='sph_shim_index_size') result(answer)
            import
            integer(c_int) :: answer
        end function
        pure function c_struct_size(name) bind(c, name='sph_shim_struct_size') result(answer)
            import
            character(kind=c_char), intent(in) :: name(*)
            integer(c_size_t) :: answer
        end function
        ! the argument that was refused last with this error, and the first particle at fault (-1: none)
        function c_refused(error, particle) bind(c, name='sph_shim_refused') result(answer)
            import
            integer(c_int), value :: error
            integer(sph_index), intent(inout) :: particle
            type(c_ptr) :: answer
        end function
        ! W and F = (1/r) dW/dr of n distances
        function c_kernel_wf(kernel, dim, n, r, h, w, f) bind(c, name='sph_shim_kernel_wf') result(answer)
            import
            integer(c_int), value :: kernel, dim
            integer(sph_index), value :: n
            real(sph_real), intent(in) :: r(*)
            real(sph_real), value :: h
            real(sph_real), intent(inout) :: w(*), f(*)
            integer(c_int) :: answer
        end function
        ! scanned once, and marked
        function sph_cloud_checked(dim, cloud) bind(c, name='sph_shim_cloud_checked') result(answer)
            import
            integer(c_int), value :: dim
            type(sph_cloud), intent(inout) :: cloud
            integer(c_int) :: answer
        end function
        ! other targets: first ... last - 1, counted from 0
        subroutine sph_cloud_range(cloud, first, last) bind(c, name='sph_shim_cloud_range')
            import
            type(sph_cloud), intent(inout) :: cloud
            integer(sph_index), value :: first, last
        end subroutine
"""
AGREES = """\

contains

    ! True if the library was compiled from the same headers, and with the same kinds of numbers.
    function sph_agrees() result(agrees)
        logical :: agrees
"""


def folded(text, indent):
    """a statement on as many lines as it needs"""
    lines = textwrap.wrap(text, WIDTH - 2, initial_indent=indent, subsequent_indent=indent + "    ",
                          break_long_words=False, break_on_hyphens=False)
    return [line + " &" for line in lines[:-1]] + lines[-1:]


def remark(text, indent):
    return textwrap.wrap(text, WIDTH, initial_indent=indent + "! ", subsequent_indent=indent + "! ")


def length_of(array, model):
    constants = {v.name: v.value for enum in model.enums for v in enum.values}
    return constants.get(array) or int(array)


def component(field, model):
    """its type, and its name with the zero it begins with"""
    array = f"({length_of(field.array, model)})" if field.array else ""
    if field.pointer:
        return "type(c_ptr)", f"{field.name}{array} = c_null_ptr"
    if field.type not in KINDS:
        return f"type({field.type})", field.name + array
    zero = "0.0_sph_real" if field.type == "sph_real" else "0"
    return KINDS[field.type], f"{field.name}{array} = {zero}"


def struct_lines(struct, model):
    lines = [""] + remark(struct.comment, "    ") + [f"    type, bind(c) :: {struct.name}"]
    groups = []  # neighbours of one type and with one comment stand on one line
    for field in struct.fields:
        kind, name = component(field, model)
        if groups and groups[-1][0] == (kind, field.comment):
            groups[-1][1].append(name)
        else:
            groups.append(((kind, field.comment), [name]))
    for (kind, comment), names in groups:
        lines += remark(comment, " " * 8)
        lines += folded(f"{kind} :: {', '.join(names)}", " " * 8)
    return lines + ["    end type"]


def enum_lines(enum):
    lines = [""] + remark(f"{enum.name}: {enum.comment}" if enum.comment else enum.name, "    ")
    for value in enum.values:
        line = f"    integer(c_int), parameter :: {value.name} = {value.value}"
        fits = len(line) + len(value.comment) + 3 <= WIDTH
        if value.comment and not fits:
            lines += remark(value.comment, "    ")
        lines.append(f"{line} ! {value.comment}" if value.comment and fits else line)
    return lines


def dummy(argument):
    """the attributes of an argument, and its name with its shape"""
    kind = KINDS.get(argument.type, f"type({argument.type})")
    if argument.type == "void":
        return "type(c_ptr), value", argument.name
    if not argument.pointer:
        return f"{kind}, value", argument.name
    intent = "in" if argument.const else "inout"
    # numbers of 64 bits that may be written are sizes that come back; what else has an address is an array or
    # a struct
    shape = "(*)" if argument.type in KINDS and (argument.const or argument.type != "int64_t") else ""
    return f"{kind}, intent({intent})", argument.name + shape


def fortran_name(function, model):
    constants = {v.name.lower() for enum in model.enums for v in enum.values}
    if function.kind == "text":
        return "c_" + function.name[len("sph_"):]
    return function.name + ("_of" if function.name in constants else "")


def interface_lines(function, model):
    taken = [exported(a) for a in function.arguments]
    answer = "type(c_ptr)" if function.returns.pointer else KINDS[exported(function.returns).type]
    pure = "pure " if function.kind == "number" else ""
    lines = remark(function.summary, " " * 8)
    head = f"{pure}function {fortran_name(function, model)}({', '.join(a.name for a in taken)})"
    tail = f"bind(c, name='{shim_name(function)}') result(answer)"
    if len(head) + len(tail) + 9 <= WIDTH:
        lines.append(" " * 8 + head + " " + tail)
    else:
        lines += [" " * 8 + head + " &", " " * 12 + tail]
    lines.append(" " * 12 + "import")
    groups = []
    for argument in taken:
        attributes, name = dummy(argument)
        if groups and groups[-1][0] == attributes:
            groups[-1][1].append(name)
        else:
            groups.append((attributes, [name]))
    for attributes, names in groups:
        lines += folded(f"{attributes} :: {', '.join(names)}", " " * 12)
    return lines + [f"            {answer} :: answer", "        end function"]


def refuse_doubles(names, where):
    """names that differ in capitals only would be one"""
    seen = set()
    for name in names:
        if name.lower() in seen:
            raise SyntaxError(f"{where}: Fortran has {name} already")
        seen.add(name.lower())


def emit(model):
    names = ["sph_real", "sph_index", "sph_state"] + [s.name for s in model.structs]
    names += [v.name for e in model.enums for v in e.values]
    names += [fortran_name(f, model) for f in model.functions]
    refuse_doubles(names, "sph_c")
    for struct in model.structs:
        refuse_doubles([f.name for f in struct.fields], struct.name)
    for function in model.functions:
        refuse_doubles(["answer", function.name] + [a.name for a in function.arguments], function.name)
    lines = OPENING.splitlines() + ["", "    ! the headers that this was written from",
                                    f"    integer(c_int), parameter :: SPH_VERSION = {model.version}"]
    for enum in model.enums:
        lines += enum_lines(enum)
    for struct in model.structs:
        lines += struct_lines(struct, model)
    lines += [""] + SHIM.splitlines()
    for function in model.functions:
        lines += interface_lines(function, model)
    lines += ["    end interface"] + AGREES.splitlines()
    lines += [f"        type({s.name}) :: {s.name}_here" for s in model.structs]
    lines += ["        agrees = sph_version_of() == SPH_VERSION .and. &",
              "            sph_real_size() == c_sizeof(0.0_sph_real) .and. &",
              "            sph_index_size() == c_sizeof(0_sph_index)"]
    for struct in model.structs:
        lines += [f"        agrees = agrees .and. c_sizeof({struct.name}_here) == &",
                  f"            c_struct_size('{struct.name}'//c_null_char)"]
    return "\n".join(lines + ["    end function", "end module"]) + "\n"
