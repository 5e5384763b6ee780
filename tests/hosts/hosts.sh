#!/bin/sh
# SPDX-License-Identifier: MIT
# Builds and runs every host of examples/hosts whose tools are installed, and work; each prints its numbers,
# and what it should have got. From the root of the repository.
. tests/check.sh
hosts=examples/hosts
export PYTHONDONTWRITEBYTECODE=1
warn="-Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wstrict-prototypes -Wmissing-prototypes -Werror -Wno-unknown-warning-option -Wno-pass-failed"

# runs a host and shows what it prints; one that ends with 77 has no device, which for OpenCL can be installed
no_device="there is no device (Debian: pocl-opencl-icd)"
run() {
    what=$1
    shift
    echo "---- $what"
    timeout 300 "$@" > "$scratch/output" 2>&1
    status=$?
    cat "$scratch/output"
    if [ $status -eq 77 ]; then skip "$what" "$no_device"; else check "$what" test $status -eq 0; fi
}
built() { # what, output, command ...: removes the output first, so that what runs is what was built
    rm -f "$2"
    what=$1 output=$2
    shift 2
    check "$what compiles" "$@"
    [ -e "$output" ]
}

# shellcheck disable=SC2086
if built "the shim, an object," "$scratch/sph_shim.o" $CC -std=c99 $warn -O1 -fPIC -I. -c $hosts/sph_shim.c -o "$scratch/sph_shim.o" &&
    built "the shim, a library," "$scratch/libsph_shim.so" $CC -shared "$scratch/sph_shim.o" -o "$scratch/libsph_shim.so" -lm; then
    if built "the shim's test" "$scratch/test_shim" $CC -std=c99 $warn -O1 "$one_copy" -I. tests/hosts/test_shim.c "$scratch/sph_shim.o" -o "$scratch/test_shim" -lm; then
        run "the shim, double" "$scratch/test_shim"
    fi
    if built "the shim's test in float" "$scratch/test_shim-float" $CC -std=c99 $warn -O1 "$one_copy" -DSPH_SINGLE=1 -I. tests/hosts/test_shim.c $hosts/sph_shim.c -o "$scratch/test_shim-float" -lm; then
        run "the shim, float" "$scratch/test_shim-float"
    fi

    # as Phantom is compiled, with all checks, and with the reals that it makes of its own
    fortran="gfortran -Wall -Wextra -Wpedantic -Werror -J $scratch"
    modules="$hosts/sph_c.f90 $hosts/sph.f90"
    if usable Fortran end '' "$fortran -x f95 -ffree-form" -lm; then
        # shellcheck disable=SC2086
        built Fortran "$scratch/host_f90" \
            $fortran -std=f2008 -O2 $modules $hosts/host.f90 "$scratch/sph_shim.o" -o "$scratch/host_f90" -lm &&
            run Fortran "$scratch/host_f90"
        for flags in "-std=f2008 -O2" "-std=f2018 -O1 -fcheck=all" "-std=f2008 -O2 -fdefault-real-8 -fdefault-double-8"; do
            # shellcheck disable=SC2086
            built "the test of its module, $flags," "$scratch/test_fortran" \
                $fortran $flags $modules tests/hosts/test_fortran.f90 "$scratch/sph_shim.o" -o "$scratch/test_fortran" -lm &&
                run "the test of its module, $flags" "$scratch/test_fortran"
        done
        # shellcheck disable=SC2086
        if needs "Fortran against C" python3 && check "calls in Fortran and in C" python3 tests/hosts/fortran_calls.py "$scratch" &&
            built "calls in C" "$scratch/calls.o" $CC -std=c99 $warn -O1 "$one_copy" -I. -c "$scratch/calls.c" -o "$scratch/calls.o" &&
            built "calls in Fortran" "$scratch/calls" \
                $fortran -std=f2008 $modules "$scratch/calls.f90" "$scratch/calls.o" "$scratch/sph_shim.o" -o "$scratch/calls" -lm; then
            run "Fortran against C" "$scratch/calls"
        fi
    fi

    if needs Python python3 && works Python python3 -S -c ''; then
        # every operator: through the shim, inline, and through Python
        check "calls of every operator, in C," sh -c "python3 -S tests/hosts/shim_calls.py C > '$scratch/shim_calls.c'"
        if built "calls of every operator" "$scratch/shim_calls" $CC -std=c99 -O1 "$one_copy" -I. "$scratch/shim_calls.c" "$scratch/sph_shim.o" -o "$scratch/shim_calls" -lm; then
            run "every operator, shim and inline" sh -c "'$scratch/shim_calls' > '$scratch/sums'"
            run "every operator, Python and inline" python3 -S tests/hosts/shim_calls.py "$scratch/libsph_shim.so" "$scratch/sums" without-numpy
        fi
        run "Python, array module" python3 -S $hosts/host.py "$scratch/libsph_shim.so" # -S: without installed packages
        run "Python, what it takes and refuses" python3 tests/hosts/test_python.py "$scratch/libsph_shim.so" without-numpy
        numpy=
        for python in python3 /usr/bin/python3; do
            [ -z "$numpy" ] && "$python" -c 'import numpy' 2> "$scratch/why" && numpy=$python
        done
        if [ -n "$numpy" ]; then
            run "Python, numpy" "$numpy" $hosts/host.py "$scratch/libsph_shim.so"
            run "Python, what it takes and refuses of numpy" "$numpy" tests/hosts/test_python.py "$scratch/libsph_shim.so"
            run "every operator, numpy and inline" "$numpy" tests/hosts/shim_calls.py "$scratch/libsph_shim.so" "$scratch/sums"
            if MPLBACKEND=agg "$numpy" -c 'import matplotlib.pyplot' 2> "$scratch/why"; then
                mkdir -p "$scratch/beside" # the library lies beside the module, as pip would have it
                cp -R $hosts/sph "$scratch/libsph_shim.so" "$scratch/beside"
                mv "$scratch/beside/libsph_shim.so" "$scratch/beside/sph"
                notebook=examples/notebooks/first_laplacian.py
                run "Python, the notebook" sh -c "MPLBACKEND=agg PYTHONPATH='$scratch/beside' '$numpy' $notebook '$scratch/notebook.png' > '$scratch/notebook.said'"
                run "the notebook with its results" sh -c "python3 -S examples/notebooks/render.py -check $notebook < '$scratch/notebook.said'"
                run "the notebook with other results" sh -c "! echo other | python3 -S examples/notebooks/render.py -check $notebook"
                check "the notebook draws" test -s "$scratch/notebook.png"
            else
                skip "Python, the notebook (Debian: python3-matplotlib)" "$(tail -n 1 "$scratch/why")"
            fi
            if "$numpy" -m pytest --version > /dev/null 2>&1; then
                run "Python, by pytest" env SPH_LIBRARY="$scratch/libsph_shim.so" "$numpy" -m pytest -q -p no:cacheprovider tests/hosts/test_python.py
            else
                skip "Python, by pytest (Debian: python3-pytest)" "it is not installed"
            fi
        else
            skip "Python with numpy (Debian: python3-numpy)" "$(tail -n 1 "$scratch/why")"
        fi
        # of a copy, because setuptools builds below the sources; without constant kernels, to compile fast
        installer="pip install (Debian: python3-pip python3-setuptools python3-wheel)"
        pip=
        for python in python3 /usr/bin/python3; do
            [ -z "$pip" ] && "$python" -c 'import setuptools, wheel, pip' 2> "$scratch/why" && pip=$python
        done
        if [ -z "$pip" ]; then
            skip "$installer" "$(tail -n 1 "$scratch/why")"
        else
            mkdir -p "$scratch/source/examples/hosts"
            cp ./sph.h ./sph_ops.h ./sph_kernels.h pyproject.toml setup.py README.md "$scratch/source"
            cp -R $hosts/sph $hosts/sph_shim* "$scratch/source/examples/hosts"
            what="pip install"
            check "$what" env CFLAGS="'$one_copy' '-DSHIM_CONSTANT_KERNELS(EACH)='" "$pip" -m pip install --quiet --no-index --no-build-isolation --target "$scratch/site" "$scratch/source"
            run "Python, installed" sh -c "cd / && PYTHONPATH='$(cd "$scratch" && pwd)/site' '$pip' -c 'import sph; print(sph.__file__, sph.kernel_w(\"m4\", 3, 0, 1))'"
        fi
    fi
fi

flags="-std=c++11 -O2 -Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-unknown-warning-option -Wno-pass-failed"
one='#include <vector>\nint main() { return std::vector<int>(1)[0]; }' # there may be no library
for cxx in g++ clang++; do
    usable "C++ by $cxx" "$one" '' "$cxx -x c++ $flags" || continue
    # shellcheck disable=SC2086
    built "C++ by $cxx" "$scratch/host-$cxx" $cxx $flags "$freely" -I. $hosts/host.cpp -o "$scratch/host-$cxx" &&
        run "C++ by $cxx" "$scratch/host-$cxx"
done

wasm="WebAssembly (Debian: emscripten nodejs)"
if needs "$wasm" emcc node && works "$wasm" node -e 0; then
    fetch=
    # the loader of older emscriptens takes a fetch for a browser's
    node --no-experimental-fetch -e 0 2> /dev/null && fetch=--no-experimental-fetch
    # emscripten of Debian finds its node modules only if it is told
    emcc="env NODE_PATH=${NODE_PATH:-/usr/share/nodejs} emcc -O2 -Wno-pass-failed -sALLOW_MEMORY_GROWTH=1"
    # it must not wait for input
    # shellcheck disable=SC2086
    usable "$wasm" "$empty" "node $fetch" "$emcc" &&
        built WebAssembly "$scratch/sph_shim.js" $emcc -I. $hosts/sph_shim.c -o "$scratch/sph_shim.js" \
            -sMODULARIZE=1 -sEXPORTED_FUNCTIONS=_malloc,_free < /dev/null &&
        run WebAssembly node $fetch $hosts/host.js "$scratch/sph_shim.js"
fi

platforms='#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
int main(void) { return clGetPlatformIDs(0, 0, 0) == 1; }' # there may be none: the host says so
opencl="OpenCL (Debian: opencl-headers ocl-icd-opencl-dev, and pocl-opencl-icd for a device)"
if usable "$opencl" "$platforms" '' "$CC -std=c99 $warn -O2" -lOpenCL -lm; then
    for single in 0 1; do
        # shellcheck disable=SC2086
        built OpenCL "$scratch/host_opencl-$single" $CC -std=c99 $warn -O2 "$freely" -DSPH_SINGLE=$single -I. $hosts/host_opencl.c -o "$scratch/host_opencl-$single" -lOpenCL -lm || continue
        for version in CL1.2 CL3.0; do run "OpenCL, $version, SPH_SINGLE=$single" "$scratch/host_opencl-$single" $version; done
        # shellcheck disable=SC2086
        built "OpenCL, lists" "$scratch/lists-$single" $CC -std=c99 $warn -O2 "$freely" -DSPH_SINGLE=$single -I. $hosts/host_opencl_lists.c -o "$scratch/lists-$single" -lOpenCL -lm &&
            run "OpenCL, lists made on the device, SPH_SINGLE=$single" "$scratch/lists-$single"
        # shellcheck disable=SC2086
        built "OpenCL, vortex" "$scratch/vortex-$single" $CC -std=c99 $warn -O2 "$freely" -DSPH_SINGLE=$single -I. $hosts/host_opencl_vortex.c -o "$scratch/vortex-$single" -lOpenCL -lm &&
            run "OpenCL, a vortex that stays on the device, SPH_SINGLE=$single" "$scratch/vortex-$single"
    done
fi

PATH=$PATH:/usr/local/cuda/bin
nvcc="nvcc -std=c++17 -O2 -Werror all-warnings -diag-suppress 128" # 128: a loop that SPH_CHECK=0 leaves out
if usable "CUDA (Debian: nvidia-cuda-toolkit)" "$empty" '' "$nvcc -x cu"; then
    no_device="a GPU is not on this machine"
    for single in 0 1; do
        # shellcheck disable=SC2086
        built "CUDA, SPH_SINGLE=$single" "$scratch/host_cuda-$single" \
            $nvcc -DSPH_SINGLE=$single -I. $hosts/host_cuda.cu -o "$scratch/host_cuda-$single" &&
            run "CUDA, SPH_SINGLE=$single" "$scratch/host_cuda-$single"
        # shellcheck disable=SC2086
        built "CUDA, vortex, SPH_SINGLE=$single" "$scratch/cuda_vortex-$single" \
            $nvcc -DSPH_SINGLE=$single -I. $hosts/host_cuda_vortex.cu -o "$scratch/cuda_vortex-$single" &&
            run "CUDA, a vortex that stays on the device, SPH_SINGLE=$single" "$scratch/cuda_vortex-$single"
    done
fi
finish hosts
