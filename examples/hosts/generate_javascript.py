# SPDX-License-Identifier: MIT
"""What generate.py writes for JavaScript: sph_c.js, with the fields of the structs, from which host.js lays
them out in the memory of a WebAssembly module, and with the constants."""

import json

OPENING = """\
// SPDX-License-Identifier: MIT
//
// sph_c.js - structs and constants of the headers, for hosts that put structs into the memory of a
// WebAssembly module (host.js). Written by examples/hosts/generate.py from the headers: run it again instead
// of changing this file.
//
// structs: the fields of each struct in their order, as [name, type, how many]; a type is that of C,
// 'pointer', or the name of another struct.
"""


def fields_of(struct, constants):
    return [[f.name, "pointer" if f.pointer else f.type,
             constants.get(f.array) or int(f.array) if f.array else 1] for f in struct.fields]


def emit(model):
    constants = {v.name: v.value for enum in model.enums for v in enum.values}
    lines = OPENING.splitlines() + ["", "exports.structs = {"]
    for struct in model.structs:
        lines.append(f"    {struct.name}: [")
        line = "       "
        for field in fields_of(struct, constants):
            item = " " + json.dumps(field) + ","
            if len(line + item) > 110:
                lines.append(line)
                line = "       "
            line += item
        lines += [line, "    ],"]
    lines += ["};", ""]
    lines += [f"exports.{name} = {value};" for name, value in constants.items()]
    return "\n".join(lines) + "\n"
