# SPDX-License-Identifier: MIT
# Makes Doxygen's comments of a header's plain ones, on the way to Doxygen (docs/Doxyfile calls it):
#   the opening comment is the text of the file's page;
#   each chapter, from its banner to the next one, is a group of its own (a topic), with the banner's text;
#   a comment before a declaration, or behind a member, belongs to it, and its first sentence is the summary;
#   indented lines stay as they are set; names of functions, macros and types become links.
# The lines keep their numbers.
#     awk -f docs/filter.awk sph_ops.h          from the root of the repository
BEGIN {
    file = ARGV[1]
    sub(/.*\//, "", file)
    id = file
    gsub(/[^a-z]/, "_", id)
    split("sph_kernels.h sph_ops.h sph.h", headers)
    for (n in headers)
        while ((getline text < headers[n]) > 0) {
            if (text ~ /^SPH_FN/ && match(text, /sph_[a-z0-9_]*\(/)) link[substr(text, RSTART, RLENGTH - 1)]
            if (text ~ /^# *define SPH_[A-Z0-9_]*\(/ && match(text, /SPH_[A-Z0-9_]*/))
                link[substr(text, RSTART, RLENGTH)]
        }
}

# What Doxygen would read as a command is made plain, and names that have a page become links.
# set: the text stands between <pre> and </pre>, where nothing is read as Markdown.
function plain(text, set, out, word, c) {
    gsub(/[\\@#%]/, "\\\\&", text)
    gsub(/&/, "\\&amp;", text)
    gsub(/</, "\\&lt;", text)
    gsub(/>/, "\\&gt;", text)
    if (!set) gsub(/[*|]/, "\\\\&", text)
    else if (text ~ /^ *- /) sub(/-/, "\\-", text)
    out = ""
    while (match(text, /(sph|SPH)_[A-Za-z0-9_]*/)) {
        word = substr(text, RSTART, RLENGTH)
        c = RSTART > 1 ? substr(text, RSTART - 1, 1) : ""
        out = out substr(text, 1, RSTART - 1)
        out = out (word in link && c !~ /[A-Za-z0-9_`]/ ? "@ref " word " \"" word "\"" : word)
        text = substr(text, RSTART + RLENGTH)
    }
    return out text
}

# One line of a comment, without its frame. The first sentence is the summary; indented lines are set as they
# are.
function line_of(text, out, end) {
    if (text ~ /^  / || (pre && text == "")) {
        out = (summary ? "@details " : "") (pre ? "" : "<pre>")
        summary = 0
        pre = 1
        return out plain(text, 1)
    }
    out = behind_pre()
    if (summary && match(text " ", /[^ .]\. /) && substr(text, 1, RSTART + 1) !~ / al\.$/) {
        end = RSTART + 1
        summary = 0
        out = out plain(substr(text, 1, end), 0) (end < length(text) || comment ? " @details " : "")
        return out plain(substr(text, end + 2), 0)
    }
    if (summary && text == "") {
        summary = 0
        return "@details"
    }
    return out plain(text, 0)
}
function behind_pre() {
    if (!pre) return ""
    pre = 0
    return "</pre>"
}

# A member with its text, once for each name that the line declares: T a, b;
function members(code, text, part, n, i, type, out) {
    text = "/** " plain(text, 0) " */ "
    n = split(code, part, /, */)
    type = part[1]
    sub(/\**[A-Za-z0-9_]+(;.*)?$/, "", type)
    out = ""
    for (i = 1; i <= n; i++) out = out text (i > 1 ? type : "") part[i] (i < n ? "; " : "")
    return out
}

NR == 1 { print "/** @file"; opening = 1; next }
opening {
    opening = $0 != " */"
    print opening ? " * " line_of(substr($0, 4)) : behind_pre() " */"
    next
}

# the banner of a chapter
/^\/\* ====/ {
    title = $0
    gsub(/^\/\* =* *| *\*\/$/, "", title)
    banner = $0 !~ /\*\/$/
    printf "%s", chapter++ ? "/** @} */ " : ""
    print "/** @defgroup " id chapter " " file ": " title (banner ? "" : " */ /** @{ */")
    summary = 1
    next
}
banner {
    banner = $0 != " */"
    print banner ? " * " line_of(substr($0, 4)) : behind_pre() " @{ */"
    next
}

# a comment before a declaration
/^\/\* [^-]/ && !/clang-format/ {
    comment = 1
    summary = 1
    printf "/** @brief "
    $0 = "   " substr($0, 4)
}
comment {
    comment = !sub(/ *\*\/$/, "")
    print line_of(substr($0, 4)) (comment ? "" : behind_pre() " */")
    next
}

# members of structs and enums, with comments before or behind them
/^typedef (struct|enum)/ { inside = $2 }
/^}/ { inside = "" }
inside && /^ +\/\*/ { note = ""; noting = 1 }
noting {
    noting = !/\*\/$/
    gsub(/^ *(\/\* *)?| *\*\/$/, "")
    note = note (note == "" ? "" : " ") $0
    print ""
    next
}
inside && match($0, /\/\* .* \*\/$/) {
    note = substr($0, RSTART + 3, RLENGTH - 6)
    $0 = substr($0, 1, RSTART - 1)
    sub(/ *$/, "")
}
inside && note != "" {
    print inside == "struct" ? members($0, note) : $0 " /**< " plain(note, 0) " */"
    note = ""
    next
}
# private constants
/^enum \{/ { private = 1 }
private {
    private = !/}/
    print ""
    next
}
{ print }
END { if (chapter) print "/** @} */" }
