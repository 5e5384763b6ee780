#!/bin/sh
# SPDX-License-Identifier: MIT
# Options that cannot work do not compile, nor do those that change between two inclusions: in C, C++ and
# OpenCL C, with an error that names the option. What is allowed compiles without a warning. From the root of
# the repository.
. tests/check.sh
warn="-Wall -Wextra -Wpedantic -Wundef -Wredundant-decls -Werror"

ways=''
# way NAME COMPILER FLAGS...: a script of this name that looks at a file and writes no program
way() {
    name=$1
    shift
    usable "options, $name" "$empty" '' "$1" || return
    printf '#!/bin/sh\nexec %s -I. "$@"\n' "$*" > "$scratch/$name"
    chmod +x "$scratch/$name"
    ways="$ways $name"
}
way gcc gcc -std=c99 $warn -Wfatal-errors -fsyntax-only -x c
way clang clang -std=c99 $warn -Wfatal-errors -fsyntax-only -x c
way g++ g++ -std=c++11 $warn -Wfatal-errors -fsyntax-only -x c++
way clang++ clang++ -std=c++11 $warn -Wfatal-errors -fsyntax-only -x c++
way tcc tcc -Wall -c -o "$scratch/tcc.o"

# file NAME LINE...: a source file of these lines
file() {
    into=$scratch/$1.c
    shift
    printf '%s\n' "$@" > "$into"
}
for header in kernels ops; do file $header "#include \"sph_$header.h\"" 'typedef int something;'; done
file search '#include "sph.h"' 'typedef int something;'
# the options of sph.h alone, so that no compiler has to read the operators before it refuses
mkdir "$scratch/alone" && cp sph_kernels.h sph.h "$scratch/alone"
echo '#include "sph_kernels.h"' > "$scratch/alone/sph_ops.h"
file alone '#include "alone/sph.h"'
refused() { # WAY, TEXT, COMPILER'S ARGUMENTS...
    with=$1 words=$2
    # tcc tells the line of an array, but not its name
    case $1$2 in tcc*SPH_INDEX_must_be*) words=sph_kernels.h ;; esac
    shift 2
    # -w: the error itself, and not a warning before it
    check "$with refuses $*" answers error "$words" "$scratch/$with" -w "$@"
}
allowed() { # WAY, COMPILER'S ARGUMENTS...
    with=$1
    shift
    check "$with allows $*" "$scratch/$with" "$@"
}
must_be=SPH_INDEX_must_be_a_signed_integer_of_2_to_8_bytes

# ---------------------------------------------------------------- values

for w in $ways; do
    refused "$w" $must_be -DSPH_INDEX=uint32_t "$scratch/kernels.c"
    allowed "$w" -DSPH_SINGLE=1 -DSPH_CHECK=0 -DSPH_SIMD=0 -DSPH_PURE_SQRT=0 -DSPH_INDEX=int64_t \
        "$scratch/kernels.c"
    case $w in clang | g++) continue ;; esac # as clang++ and gcc
    for option in SINGLE CHECK SIMD PURE_SQRT OPENMP AVX512 AVX2; do
        case $option in OPENMP | AVX*) source=$scratch/alone.c ;; *) source=$scratch/kernels.c ;; esac
        for value in 2 '' yes; do
            refused "$w" "SPH_$option must be 0 or 1" "-DSPH_$option=$value" "$source"
        done
        case $w-$option in
        tcc-PURE_SQRT | *OPENMP | *AVX*)
            refused "$w" "SPH_$option must be 0 here" "-DSPH_$option=1" "$source"
            ;;
        gcc-SIMD) allowed gcc -fopenmp-simd -DSPH_SIMD=1 "$source" ;;
        *) allowed "$w" "-DSPH_$option=1" "$source" ;;
        esac
    done
    for type in float uint8_t; do refused "$w" $must_be "-DSPH_INDEX=$type" "$scratch/kernels.c"; done
    allowed "$w" -DSPH_INDEX=short "$scratch/kernels.c"
    refused "$w" sph_kernels.h -DSPH_INDEX=no_such_type "$scratch/kernels.c"
    allowed "$w" "-DSPH_ASSERT(x)=(void)(x)" "-DSPH_REFUSED(name, i, error)=(void)(error)" "$scratch/kernels.c"
done
for w in $ways; do
    [ "$w" = gcc ] || continue
    for value in -1 '(1)' true 1u; do refused gcc . "-DSPH_CHECK=$value" "$scratch/kernels.c"; done
    for type in unsigned size_t double _Bool int8_t __int128; do
        refused gcc $must_be "-DSPH_INDEX=$type" "$scratch/kernels.c"
    done
    for type in '' 'int *' void; do refused gcc SPH_INDEX "-DSPH_INDEX=$type" "$scratch/kernels.c"; done
    refused gcc SPH_ASSERT -DSPH_ASSERT "$scratch/kernels.c"
    refused gcc SPH_REFUSED -DSPH_REFUSED "$scratch/ops.c"
    allowed gcc -DSPH_OPENMP=0 -DSPH_AVX512=0 -DSPH_AVX2=0 "$scratch/search.c"
    allowed gcc -fopenmp -DSPH_OPENMP=1 "$scratch/search.c"
done
opencl="clang -x cl -cl-std=CL1.2 -Xclang -finclude-default-header -fsyntax-only -Wall -Wextra -Werror"
: > "$scratch/nothing.c"
if needs "options, OpenCL" clang && works "options, OpenCL" $opencl "$scratch/nothing.c"; then
    printf '#!/bin/sh\nexec %s -I. "$@"\n' "$opencl" > "$scratch/opencl"
    chmod +x "$scratch/opencl"
    refused opencl "SPH_CHECK must be 0 or 1" -DSPH_CHECK=yes "$scratch/kernels.c"
    refused opencl "SPH_PURE_SQRT must be 0 here" -DSPH_PURE_SQRT=1 "$scratch/kernels.c"
    refused opencl $must_be -DSPH_INDEX=uint "$scratch/kernels.c"
    allowed opencl -DSPH_INDEX=long -DSPH_SINGLE=1 "$scratch/ops.c"
    ways="$ways opencl"
fi

# ---------------------------------------------------------------- from one inclusion to the next

# changed OPTION HEADER FIRST SECOND WAY...: a file that defines it as FIRST, includes the header, defines it
# as SECOND, and includes sph_ops.h, or sph.h where the header is that
changed() {
    last=sph_ops.h
    [ "$2" != sph.h ] || last=sph.h
    define="#define SPH_$1 $3"
    file "from-$1-$2" "${3:+$define}" "#include \"$2\"" "#undef SPH_$1" "#define SPH_$1$4" \
        "#include \"$last\"" 'typedef int something;'
    option=$1 from=$scratch/from-$1-$2.c
    shift 4
    for w in $ways; do
        case " $* " in *" $w "*) refused "$w" "SPH_${option}_must_not_change_between_inclusions" "$from" ;; esac
    done
}
every='gcc clang g++ clang++ tcc' most='gcc clang++ tcc'
changed SINGLE sph_kernels.h 0 ' 1' $every opencl
changed SINGLE sph_ops.h '' ' 1' gcc
changed CHECK sph_kernels.h 1 ' 0' $most
changed CHECK sph.h '' ' 0' clang++
changed SIMD sph_kernels.h 0 ' 1' $most
changed PURE_SQRT sph_kernels.h 0 ' 1' $most
changed INDEX sph_kernels.h short ' int' $every opencl
changed INDEX sph.h '' ' int64_t' tcc
changed ASSERT sph_kernels.h '' '(x) assert(x)' $most
changed REFUSED sph_kernels.h '' '(a, b, c) note(a, b, c)' $most
changed OPENMP sph.h 0 ' 1' gcc clang++ tcc
changed AVX512 sph.h 0 ' 1' tcc
changed AVX2 sph.h 0 ' 1' tcc
# what stays is allowed, however often and in whatever order, also where it is said again
for option in 'SINGLE 1' 'CHECK 0' 'INDEX int64_t' 'ASSERT(x) (void)(x)' 'OPENMP 0'; do
    name=SPH_${option%%[( ]*}
    file "stays-$name" "#define SPH_$option" '#include "sph_kernels.h"' "#undef $name" \
        "#define SPH_$option" '#include "sph.h"' '#include "sph_ops.h"' '#include "sph.h"'
    for w in $ways; do
        case $w-$option in tcc-* | gcc-CHECK*) allowed "$w" "$scratch/stays-$name.c" ;; esac
    done
done

# what one file does is no business of another: a part in float and one in double make a program
file part '#include "sph.h"' 'int PART(void);' \
    'int PART(void) { return sizeof(sph_real) == (SPH_SINGLE ? sizeof(float) : sizeof(double)); }'
file both 'int in_float(void);' 'int in_double(void);' \
    'int main(void) { return !(in_float() && in_double()); }'
check "a part in float" $CC -std=c99 -I. -DPART=in_float -DSPH_SINGLE=1 -DSPH_INDEX=int64_t -c \
    -o "$scratch/float.o" "$scratch/part.c"
check "a part in double" $CC -std=c99 -I. -DPART=in_double -DSPH_CHECK=0 -c \
    -o "$scratch/double.o" "$scratch/part.c"
check "both link" $CC -o "$scratch/both" "$scratch/both.c" "$scratch/float.o" "$scratch/double.o"
check "both run" "$scratch/both"
finish options
