#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs every host of examples/hosts whose tools are installed; each prints its numbers, and what it should have got. From the root of the repository.
. tests/check.sh
hosts=examples/hosts
export PYTHONDONTWRITEBYTECODE=1
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wstrict-prototypes -Wmissing-prototypes -Werror -Wno-unknown-warning-option -Wno-pass-failed"
not_inlined='-DSPH_FN=static __attribute__((noinline, unused))' # for tests that call many copies: seconds to compile, not minutes

# runs a host and shows what it prints; one that ends with 77 has no device
run() {
    what=$1
    shift
    echo "---- $what"
    timeout 300 "$@" > "$scratch/output" 2>&1
    status=$?
    cat "$scratch/output"
    if [ $status -eq 77 ]; then skip "$what" "nothing to run it on"; else check "$what" test $status -eq 0; fi
}
built() { # what, output, command ...: removes the output first, so that what runs is what was built
    rm -f "$2"
    what=$1 output=$2
    shift 2
    check "$what compiles" "$@"
    [ -e "$output" ]
}

# shellcheck disable=SC2086
if built "the shim, an object," "$scratch/sph_shim.o" $CC -std=c99 $warn -O2 -fPIC -I. -c $hosts/sph_shim.c -o "$scratch/sph_shim.o" &&
    built "the shim, a library," "$scratch/libsph_shim.so" $CC -shared "$scratch/sph_shim.o" -o "$scratch/libsph_shim.so" -lm; then
    if built "the shim's test" "$scratch/test_shim" $CC -std=c99 $warn -O1 "$not_inlined" -I. tests/hosts/test_shim.c "$scratch/sph_shim.o" -o "$scratch/test_shim" -lm; then
        run "the shim, double" "$scratch/test_shim"
    fi
    if built "the shim's test in float" "$scratch/test_shim-float" $CC -std=c99 $warn -O1 "$not_inlined" -DSPH_SINGLE=1 -I. tests/hosts/test_shim.c $hosts/sph_shim.c -o "$scratch/test_shim-float" -lm; then
        run "the shim, float" "$scratch/test_shim-float"
    fi

    if needs Fortran gfortran; then
        # shellcheck disable=SC2086
        built Fortran "$scratch/host_f90" gfortran -std=f2018 -Wall -Wextra -Wno-integer-division -Werror -O2 -J "$scratch" $hosts/sph.f90 $hosts/host.f90 "$scratch/sph_shim.o" -o "$scratch/host_f90" -lm &&
            run Fortran "$scratch/host_f90"
    fi

    if needs Python python3; then
        run "Python, array module" python3 -S $hosts/host.py "$scratch/libsph_shim.so" # -S: without installed packages
        run "Python, what it refuses" python3 tests/hosts/test_python.py "$scratch/libsph_shim.so" without-numpy
        numpy=
        for python in python3 /usr/bin/python3; do [ -z "$numpy" ] && "$python" -c 'import numpy' 2> /dev/null && numpy=$python; done
        if [ -n "$numpy" ]; then
            run "Python, numpy" "$numpy" $hosts/host.py "$scratch/libsph_shim.so"
            run "Python, what it refuses of numpy" "$numpy" tests/hosts/test_python.py "$scratch/libsph_shim.so"
        else
            skip "Python with numpy" "no numpy (Debian: python3-numpy)"
        fi
    fi
fi

for cxx in g++ clang++; do
    needs "C++ by $cxx" $cxx || continue
    built "C++ by $cxx" "$scratch/host-$cxx" $cxx -std=c++11 -Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-unknown-warning-option -Wno-pass-failed -O2 -I. $hosts/host.cpp -o "$scratch/host-$cxx" &&
        run "C++ by $cxx" "$scratch/host-$cxx"
done

if needs "WebAssembly (Debian: emscripten nodejs)" emcc node; then
    fetch=
    node --no-experimental-fetch -e 0 2> /dev/null && fetch=--no-experimental-fetch # the loader of older emscriptens takes a fetch for a browser's
    # emscripten of Debian finds its node modules only if it is told; it must not wait for input
    built WebAssembly "$scratch/sph_shim.js" sh -c "NODE_PATH=\${NODE_PATH:-/usr/share/nodejs} emcc -O2 -Wno-pass-failed -I. $hosts/sph_shim.c -o '$scratch/sph_shim.js' -sMODULARIZE=1 -sALLOW_MEMORY_GROWTH=1 -sEXPORTED_FUNCTIONS=_malloc,_free < /dev/null" &&
        run WebAssembly node $fetch $hosts/host.js "$scratch/sph_shim.js"
fi

if compiles '#define CL_TARGET_OPENCL_VERSION 120\n#include <CL/cl.h>\nint main(void) { return clGetPlatformIDs(0, 0, 0) == 1; }' "$CC" -lOpenCL; then
    for single in 0 1; do
        # shellcheck disable=SC2086
        built OpenCL "$scratch/host_opencl-$single" $CC -std=c99 $warn -O2 -DSPH_SINGLE=$single -I. $hosts/host_opencl.c -o "$scratch/host_opencl-$single" -lOpenCL -lm || continue
        for version in CL1.2 CL3.0; do run "OpenCL, $version, SPH_SINGLE=$single" "$scratch/host_opencl-$single" $version; done
    done
else
    skip OpenCL "no headers or library (Debian: opencl-headers ocl-icd-opencl-dev, and pocl-opencl-icd for a device)"
fi

PATH=$PATH:/usr/local/cuda/bin
if needs "CUDA (Debian: nvidia-cuda-toolkit)" nvcc; then # 128: a loop that SPH_CHECK=0 leaves out
    for single in 0 1; do
        built "CUDA, SPH_SINGLE=$single" "$scratch/host_cuda-$single" nvcc -std=c++17 -O2 -Werror all-warnings -diag-suppress 128 -DSPH_SINGLE=$single -I. $hosts/host_cuda.cu -o "$scratch/host_cuda-$single" &&
            run "CUDA, SPH_SINGLE=$single" "$scratch/host_cuda-$single"
    done
fi
finish hosts
