#!/bin/sh
# SPDX-License-Identifier: MIT
# The hosts on many ranks (examples/hosts/host_mpi*): what one rank finds, several find, and each of what can go
# wrong on one rank ends all, soon and with a message. From the root of the repository.
. tests/check.sh
hosts=examples/hosts
packages="(Debian: openmpi-bin libopenmpi-dev libtrilinos-zoltan-dev)"
export OMPI_CC="$CC" MPICH_CC="$CC" OMP_NUM_THREADS=1 OMPI_MCA_mpi_yield_when_idle=1 OMPI_MCA_rmaps_base_oversubscribe=1
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 # in a container there is only root
if ! installed mpicc mpirun || ! compiles '#include <mpi.h>\n#include <zoltan_comm.h>\nint main(void) { return 0; }' \
    mpicc -I/usr/include/trilinos -ltrilinos_zoltan; then
    skip "hosts on many ranks" "MPI and Zoltan are not installed $packages"
    finish mpi
fi
ranks() { # N PROGRAM ...
    with=$1
    shift
    timeout 120 mpirun -n "$with" "$@"
}
if ! ranks 3 true > "$scratch/has.log" 2>&1; then
    echo "failed: mpi: mpirun is installed, but does not start three ranks: $(reason)"
    exit 1
fi
warn="-std=c99 -Wall -Wextra -Wpedantic -Werror"
flags_of() { pkg-config --cflags --libs "$@" | sed 's/-I/-isystem /g'; } # their headers may warn
built() { # NAME PACKAGE ...
    program=$1
    shift
    # shellcheck disable=SC2046,SC2086
    check "$program compiles" mpicc $warn -O2 "$freely" -I. -isystem /usr/include/trilinos \
        $hosts/$program.c tests/hosts/mpi_bytes.c -o "$scratch/$program" $([ $# -eq 0 ] || flags_of "$@") -ltrilinos_zoltan -lm
    [ -e "$scratch/$program" ]
}
run() { # NAME N PROGRAM ...: what it prints goes into scratch/NAME
    to=$scratch/$1
    what=$1
    shift
    # shellcheck disable=SC2016
    check "$what" sh -c 'to=$1; shift; "$@" > "$to"' sh "$to" timeout 120 mpirun -n "$@"
}
fails() { ! "$@"; }
killed() { # it ends soon, and not well
    ranks "$@"
    ended=$?
    [ $ended -ne 0 ] && [ $ended -ne 124 ]
}
word() { # the word behind WORD in the last line of scratch/NAME that has it
    awk -v word="$2" '{ for (i = 1; i < NF; i++) if ($i == word) found = $(i + 1) } END { print found }' "$scratch/$1"
}
less() { [ "$1" ] && [ "$2" ] && awk -v a="$1" -v b="$2" 'BEGIN { exit !(a + 0 <= b + 0) }'; }
same() { [ "$1" ] && [ "$1" = "$2" ]; }
bytes() { # of all values of copies, within 10 percent of 8 each
    awk '$1 == "values" { n = 8 * $2 } $1 == "bytes" { b = $2 } END { exit !(n > 0 && b > 0.9 * n && b < 1.1 * n) }' "$scratch/$1"
}

if built host_mpi_vary; then
    vary=$scratch/host_mpi_vary
    for box in 0 1; do # none, and a periodic one
        for n in 1 2 4; do
            run vary-$box-$n $n "$vary" 4000 $box
            for criterion in gather larger adaptive; do
                for m in 1 $n; do grep "^$criterion" "$scratch/vary-$box-$m" | sed 's/;.*//' > "$scratch/pairs-$m"; done
                check "the same pairs on $n ranks, $box, $criterion" cmp "$scratch/pairs-1" "$scratch/pairs-$n"
            done
        done
        check "lengths grow, and with them the halo, $box" less "$(awk -v n="$(word vary-$box-4 first)" 'BEGIN { print 2 * n + 1 }')" \
            "$(word vary-$box-4 last)"
        check "all have a length, $box" grep -q "^adaptive h 0[.0-9]* to 0.1[0-9]* hash [0-9a-f]* rounds [2-9]* alone 0;" "$scratch/vary-$box-4"
        check "radii differ, $box" less 10 "$(word vary-$box-1 smallest | sed 's/;//')"
        check "a pruned halo is less than half, $box" \
            less "$(awk -v n="$(word vary-$box-4 pruned)" 'BEGIN { print 2 * n }')" "$(word vary-$box-4 copies | sed 's/,//')"
    done
    check "a box that is none" answers error "rank [01]: sph_part_of: a box length is" ranks 2 "$vary" 500 nan
    check "a box that is too small" answers error "rank [01]: sph_.*: a box length is" ranks 2 "$vary" 500 0.2
    for n in 0 1 3; do check "$n particles on 4 ranks" answers 0 "of $n particles" ranks 4 "$vary" $n; done
fi

if ! installed pkg-config || ! pkg-config --exists PETSc; then
    skip "Poisson's equation on many ranks" "PETSc is not installed (Debian: petsc-dev pkg-config)"
elif built host_mpi_poisson PETSc; then
    poisson=$scratch/host_mpi_poisson
    run poisson-1 1 "$poisson" -side 28 -write "$scratch/u"
    for n in 2 4; do
        run poisson-$n $n "$poisson" -side 28 -compare "$scratch/u"
        check "the solution of one rank on $n" less "$(word poisson-$n difference)" 1e-8
        check "its error on $n ranks" less "$(word poisson-$n error)" "$(word poisson-1 error)"
    done
    for n in 1 2 4; do
        check "the residual on $n ranks is the true one" less "$(word poisson-$n residual)" 1.0001e-10
        check "multigrid on $n ranks" less "$(word poisson-$n iterations)" 10
    done
    run poisson-coarse 3 "$poisson" -side 20 -parts 2 # one rank is empty
    # of first order at least, from spacing 1/19 to 1/27
    check "the error falls with the spacing" less "$(word poisson-1 error)" "$(awk -v e="$(word poisson-coarse error)" 'BEGIN { print e * 19 / 27 }')"
    run poisson-jump-1 1 "$poisson" -side 16 -jump 1000 -write "$scratch/jump"
    run poisson-jump-4 4 "$poisson" -side 16 -jump 1000 -compare "$scratch/jump"
    # the largest value there is some 100
    check "a coefficient that jumps" less "$(word poisson-jump-4 difference)" 1e-6
    check "too few points for a matrix" answers error "points along the cube" ranks 2 "$poisson" -side 2
fi

if ! installed pkg-config || ! pkg-config --exists hdf5-openmpi; then
    skip "a dam break on many ranks" "parallel HDF5 is not installed (Debian: libhdf5-openmpi-dev pkg-config)"
elif built host_mpi_dam hdf5-openmpi; then
    dam=$scratch/host_mpi_dam
    at=$scratch/at
    run dam-1 1 "$dam" -resolution 4 -steps 400 -sorted -every 200 -keep -write "$scratch/one"
    cp "$scratch/one.h5" "$scratch/one_000000400.h5"
    for n in 2 4; do
        steps=$((100 * n))
        run dam-$n $n "$dam" -resolution 4 -steps $steps -sorted -every 200 -keep -write "$at" -compare "$scratch/one_000000$steps.h5"
        check "the same bits on $n ranks" grep -q "3068 of 3068 particles have the same bits" "$scratch/dam-$n"
        check "bytes of the halo on $n ranks" bytes dam-$n
        # whose rows were swept while copies were on their way
        check "inner particles on $n ranks" less 400 "$(word dam-$n inner)"
        check "outer particles on $n ranks" less "$(word dam-$n inner)" 2900
        check "balance on $n ranks" awk '{ for (i = 1; i < NF; i++) if ($i == "imbalance") { n++; bad += $(i + 1) > 1.1 } } END { exit bad || n < 3 }' "$scratch/dam-$n"
    done
    check "particles moved, and cuts were made anew" less 1 "$(word dam-4 balanced)"
    run dam-unsorted 3 "$dam" -resolution 4 -steps 200 -parts 2 -compare "$scratch/one_000000200.h5" # one rank is empty
    check "not sorted: nearly the same" less "$(word dam-unsorted position)" 1e-10
    check "one rank of three is empty" less 1 "$(word dam-unsorted empty)"
    run dam-3 3 "$dam" -resolution 4 -steps 200 -sorted -write "$at"
    run dam-3-2 2 "$dam" -resolution 4 -steps 400 -sorted -restart "$at.h5" -compare "$scratch/one.h5"
    check "3 ranks, then 2: the same bits" grep -q "3068 of 3068 particles have the same bits" "$scratch/dam-3-2"

    cp "$at.h5" "$scratch/before"
    check "a rank is killed in the middle of a file" killed 2 "$dam" -resolution 4 -steps 210 -restart "$at.h5" -write "$at" -break 210
    check "there was a part of a file" test -s "$at.h5.part"
    check "and the one before is whole" cmp "$at.h5" "$scratch/before"
    for moment in 1 2 3; do # and whenever: a file is written each step
        rm -f "$scratch/pids"
        # shellcheck disable=SC2016
        ranks 2 sh -c 'echo $$ >> "$0"; exec "$@"' "$scratch/pids" "$dam" -resolution 4 -steps 1000000 -sorted -every 1 \
            -restart "$at.h5" -write "$at" > "$scratch/log" 2>&1 &
        waited=0
        until ! cmp -s "$at.h5" "$scratch/before" || [ $waited -ge 100 ]; do sleep 1; waited=$((waited + 1)); done
        sleep 0.$((moment * 3))
        kill -9 "$(tail -n 1 "$scratch/pids")"
        check "a rank killed at any moment ends all" fails wait $!
        check "there were new files" less 0 "$(($(cmp -s "$at.h5" "$scratch/before"; echo $?) - 1))"
        run dam-killed 1 "$dam" -resolution 4 -steps 0 -restart "$at.h5"
        check "a file that can be read is left" same "$(word dam-killed mass)" "$(word dam-1 mass)"
        cp "$at.h5" "$scratch/before"
    done
    if ! installed python3; then
        skip "the pictures" "python3 is not installed"
    else
        # shellcheck disable=SC2046,SC2086
        check "what reads arrays compiles" mpicc $warn tests/hosts/mpi_arrays.c -o "$scratch/arrays" $(flags_of hdf5-openmpi) -lm
        # shellcheck disable=SC2016
        check "the pictures are XML" sh -c 'python3 -S tests/hosts/mpi_pictures.py "$1.xmf" > "$2"' sh "$at" "$scratch/pictures"
        check "the pictures name what is there" grep -q "$(basename "$at").h5 /PartType0/Coordinates Float 8 3068 3" "$scratch/pictures"
        check "as it is" answers 0 "6 arrays" "$scratch/arrays" "$scratch" "$scratch/pictures"
        sed 's/3068/3067/' "$scratch/pictures" > "$scratch/pictures-wrong"
        check "and not otherwise" answers 1 "not what the pictures say" "$scratch/arrays" "$scratch" "$scratch/pictures-wrong"
    fi
    check "a halo that is too small" answers error "the halo is too small" ranks 3 "$dam" -resolution 4 -steps 5 -halo 0.7
    check "a file that is not there" answers error "does not exist" ranks 2 "$dam" -resolution 4 -steps 5 -restart "$scratch/none.h5"
    check "a file that is no HDF5" answers error "is no HDF5 file" ranks 2 "$dam" -resolution 4 -steps 5 -restart "$at.xmf"
    check "a file of another size" answers error "another -resolution" ranks 2 "$dam" -resolution 5 -steps 5 -restart "$at.h5"
    check "a file that cannot be written" answers error "cannot write" ranks 2 "$dam" -resolution 4 -steps 1 -write "$scratch/none/at"
    head -c 100000 "$at.h5" > "$scratch/short.h5"
    check "half a file" answers error "short.h5" ranks 2 "$dam" -resolution 4 -steps 5 -restart "$scratch/short.h5"
    cat > "$scratch/other.c" << 'END'
#include <hdf5.h>
int main(int argc, char **argv)
{
    const hid_t file = H5Fcreate(argv[argc - 1], H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), group = H5Gcreate2(file, "Header", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    return H5Gclose(group) < 0 || H5Fclose(file) < 0;
}
END
    # shellcheck disable=SC2046
    check "another program's file compiles" mpicc "$scratch/other.c" -o "$scratch/other" $(flags_of hdf5-openmpi)
    check "another program's file" "$scratch/other" "$scratch/other.h5"
    check "a file of another program" answers error "no file of host_mpi_dam" ranks 2 "$dam" -resolution 4 -steps 5 -restart "$scratch/other.h5"
    check "an option that there is not" answers error "option -stepps" ranks 2 "$dam" -stepps 5
fi
finish mpi
