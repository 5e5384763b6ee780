/* SPDX-License-Identifier: MIT
 *
 * mathml.h - formulas of the headers' comments, such as "grad f_i = K^-1 sum_j V_j (f_j - f_i) grad_i W_ij", as
 * MathML. What it knows: names with _, ^ and * behind them, (...)^, sum_j, Greek letters, grad, lap, d_a, numbers, signs.
 */
#ifndef ATLAS_MATHML_H
#define ATLAS_MATHML_H

#include <ctype.h>
#include <stdio.h>
#include <string.h>

static inline const char *mathml_letter(const char *word)
{
    static const char *const known[][2] = {{"rho", "&#961;"},   {"nu", "&#957;"},    {"mu", "&#956;"},    {"eta", "&#951;"},   {"gamma", "&#947;"}, {"Gamma", "&#915;"},
                                           {"Omega", "&#937;"}, {"psi", "&#968;"},   {"sigma", "&#963;"}, {"alpha", "&#945;"}, {"kappa", "&#954;"}, {"xi", "&#958;"},
                                           {"zeta", "&#950;"},  {"phi", "&#966;"},   {"grad", "&#8711;"}, {"lap", "&#916;"},   {"Pi", "&#928;"}};
    for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
        if (strcmp(word, known[k][0]) == 0) return known[k][1];
    return NULL;
}
static inline void mathml_name(FILE *to, const char *from, int length)
{
    char word[64];
    if (length > 63) length = 63;
    memcpy(word, from, (size_t)length);
    word[length] = '\0';
    if (word[0] == 'd' && mathml_letter(word + 1)) { /* drho */
        fprintf(to, "<mrow><mi>d</mi><mi>%s</mi></mrow>", mathml_letter(word + 1));
        return;
    }
    const char *const letter = mathml_letter(word);
    const int sign = letter && (strcmp(word, "grad") == 0 || strcmp(word, "lap") == 0);
    if (isdigit((unsigned char)word[0])) fprintf(to, "<mn>%s</mn>", word);
    else if (strcmp(word, "and") == 0 || strcmp(word, "with") == 0 || strcmp(word, "in") == 0) fprintf(to, "<mtext>&#160;%s&#160;</mtext>", word);
    else fprintf(to, sign ? "<mi mathvariant=\"normal\">%s</mi>" : "<mi>%s</mi>", letter ? letter : word);
}
/* What stands behind _ or ^: a sign, and letters or digits; or a star. */
static inline const char *mathml_index(FILE *to, const char *at)
{
    if (*at == '*') {
        fputs("<mo>*</mo>", to);
        return at + 1;
    }
    fputs("<mrow>", to);
    if (*at == '-') {
        fputs("<mo>&#8722;</mo>", to);
        at++;
    }
    int length = 0;
    while (isalnum((unsigned char)at[length])) length++;
    if (length == 2 && islower((unsigned char)at[0]) && islower((unsigned char)at[1])) { /* two indices */
        mathml_name(to, at, 1);
        mathml_name(to, at + 1, 1);
    } else mathml_name(to, at, length);
    fputs("</mrow>", to);
    return at + length;
}

static inline void mathml_row(FILE *to, const char *formula, const char *end)
{
    for (const char *at = formula; at < end;) {
        if (isalnum((unsigned char)*at)) {
            int length = 0;
            while (isalnum((unsigned char)at[length])) length++;
            const char *const from = at;
            const int is_sum = length == 3 && strncmp(from, "sum", 3) == 0;
            const char *after = at + length, *below = NULL, *above = NULL;
            if (*after == '_' && isalnum((unsigned char)after[1])) {
                below = after + 1;
                for (after++; isalnum((unsigned char)*after);) after++;
            }
            if (*after == '^' && (isalnum((unsigned char)after[1]) || (after[1] == '-' && isalnum((unsigned char)after[2])))) {
                above = after + 1;
                for (after += 2; isalnum((unsigned char)*after);) after++;
            } else if (*after == '*') above = after++;
            const char *const tag = below && above ? "msubsup" : below ? (is_sum ? "munder" : "msub") : above ? "msup" : NULL;
            if (tag) fprintf(to, "<%s>", tag);
            if (is_sum) fputs("<mo>&#8721;</mo>", to);
            else mathml_name(to, from, length);
            if (below) mathml_index(to, below);
            if (above) mathml_index(to, above);
            if (tag) fprintf(to, "</%s>", tag);
            if (*after == ' ' && (isalnum((unsigned char)after[1]) || after[1] == '(')) fputs("<mspace width=\"0.25em\"/>", to);
            at = after;
            continue;
        }
        if (*at == ' ') {
            at++;
            continue;
        }
        if (*at == ')' && at[1] == '^') {
            fputs("<msup><mo stretchy=\"false\">)</mo>", to);
            at += 2;
            if (*at == '(') { /* to the bracket that closes it */
                const char *const inner = at + 1;
                for (int open = 1; open && ++at < end;) open += (*at == '(') - (*at == ')');
                fputs("<mrow>", to);
                mathml_row(to, inner, at);
                fputs("</mrow>", to);
                at++;
            } else at = mathml_index(to, at);
            fputs("</msup>", to);
            continue;
        }
        if (*at == ';') fputs("<mtext>,</mtext><mspace width=\"1.5em\"/>", to);
        else if (*at == '<' && at[1] != ' ') fputs("<mo stretchy=\"false\">&#10216;</mo>", to);
        else if (*at == '>' && at > formula && at[-1] != ' ' && at[1] != '=') fputs("<mo stretchy=\"false\">&#10217;</mo>", to);
        else if (*at == '-') fputs("<mo>&#8722;</mo>", to);
        else if (strncmp(at, "...", 3) == 0) {
            fputs("<mo>&#8230;</mo>", to);
            at += 2;
        }
        else if (*at == '.') fputs("<mo>&#8901;</mo>", to);
        else if (*at == '&') fputs("<mo>&amp;</mo>", to);
        else if (*at == '<') fputs("<mo>&lt;</mo>", to);
        else if (*at == '>') fputs("<mo>&gt;</mo>", to);
        else if (*at == '*') fputs("<mo>&#8270;</mo>", to);
        else fprintf(to, "<mo%s>%c</mo>", strchr("()[]", *at) ? " stretchy=\"false\"" : "", *at);
        at++;
    }
}
static inline void mathml_write(FILE *to, const char *formula)
{
    fputs("<math display=\"block\">", to);
    mathml_row(to, formula, formula + strlen(formula));
    fputs("</math>", to);
}

#endif
