#!/bin/sh
# SPDX-License-Identifier: MIT
# Every way to get the headers but copying them: installed by make, CMake, Meson, as a Debian package and as
# one file; a host is built from each and run. Skips aloud where a tool is not installed, or does not work.
#     make check-packages
. tests/check.sh
root=$PWD
here=$root/tests/packages
version=$(make -s version)
says="sph.h $version: density"
scratch=$(cd "$scratch" && pwd)

# a command after which the program $1 must exist and print its version
host() {
    program=$1
    shift
    "$@" > "$scratch/output" 2>&1 && "$program" > "$scratch/said" 2>&1 && grep -q -F "$says" "$scratch/said" && return
    cat "$scratch/output" "$scratch/said" 2> /dev/null
    return 1
}

check "versions agree" test "$(sed -n 's/.*"version": "\(.*\)".*/\1/p' "$here/vcpkg/vcpkg.json") $(sed -n '1s/.*(\(.*\)).*/\1/p' "$here/debian/changelog")" = "$version $version"
check "the change log has this version" grep -q "^## $version" CHANGELOG.md

# ---- make install ----
check "make install" make -s install PREFIX=/usr DESTDIR="$scratch/installed"
check "what is installed" test "$(cd "$scratch/installed" && find . -type f | LC_ALL=C sort | tr '\n' ' ')" = \
    "./usr/include/sph.h ./usr/include/sph_kernels.h ./usr/include/sph_ops.h ./usr/share/pkgconfig/sph.pc "
check "host of installed headers" host "$scratch/plain" $CC -std=c99 -o "$scratch/plain" -I"$scratch/installed/usr/include" "$here/consumer/main.c" -lm
if needs pkg-config pkg-config && works pkg-config pkg-config --version; then
    export PKG_CONFIG_SYSROOT_DIR="$scratch/installed" PKG_CONFIG_PATH="$scratch/installed/usr/share/pkgconfig"
    check "pkg-config: version" test "$(pkg-config --modversion sph)" = "$version"
    # shellcheck disable=SC2046
    check "host by pkg-config" host "$scratch/pc" $CC -std=c99 -o "$scratch/pc" "$here/consumer/main.c" $(pkg-config --keep-system-cflags --cflags --libs sph)
    unset PKG_CONFIG_SYSROOT_DIR PKG_CONFIG_PATH
fi
check "make uninstall" make -s uninstall PREFIX=/usr DESTDIR="$scratch/installed"
check "nothing is left" test -z "$(find "$scratch/installed" -type f)"

# ---- one file: the tests of the headers must say of it what they say of the three ----
sh "$here/amalgamate.sh" > "$scratch/sph_all.h"
check "sph_all.h: one licence" test "$(grep -c '^ \* MIT License' "$scratch/sph_all.h")" -eq 1
mkdir -p "$scratch/all/tests" "$scratch/all/examples/common"
for h in sph.h sph_ops.h sph_kernels.h; do echo '#include "../sph_all.h"' > "$scratch/all/$h"; done
cp "$root"/tests/*.h "$root"/tests/test_known_answers.c "$root"/tests/test_fluid.c "$scratch/all/tests"
cp "$root"/examples/common/*.h "$scratch/all/examples/common"
for t in known_answers fluid; do
    for where in "$scratch/all" "$root"; do
        check "$t" $CC -std=c99 -O1 -w -I"$where" -o "$scratch/$t" "$where/tests/test_$t.c" -lm
        "$scratch/$t" >> "$scratch/$t.said" 2>&1
    done
    check "$t: sph_all.h is the three headers" test "$(sort -u "$scratch/$t.said" | wc -l)" -eq 1
    check "$t: all passed" grep -q ' 0 failed' "$scratch/$t.said"
done

# ---- make dist ----
tarball=
if needs "make dist" git && works "make dist" git -C "$root" rev-parse HEAD; then
    check "make dist" make -s dist DIST="$scratch/dist"
    tarball=$scratch/dist/sph-$version.tar.gz
    check "the tarball has the headers" sh -c "tar -tzf '$tarball' | grep -q '^sph-$version/sph_ops.h'"
    check "sph_all.h beside it" test -s "$scratch/dist/sph_all.h"
fi

# a program that the tools below have to build before they count
trivial=$scratch/trivial
mkdir -p "$trivial"
echo "$empty" > "$trivial/trivial.c"

# ---- CMake ----
printf 'cmake_minimum_required(VERSION 3.14)\nproject(trivial C)\nadd_executable(trivial trivial.c)\n' \
    > "$trivial/CMakeLists.txt"
cmake_trivial() {
    cmake -S "$trivial" -B "$trivial/cmake" && cmake --build "$trivial/cmake" && "$trivial/cmake/trivial"
}
cmake_host() { # name, options ...
    build=$scratch/cmake-$1
    shift
    cmake -S "$here/consumer" -B "$build" "$@" && cmake --build "$build"
}
if needs CMake cmake && works CMake cmake_trivial; then
    check "cmake: install" sh -c "cmake -S '$root' -B '$scratch/cmake' -DCMAKE_INSTALL_PREFIX='$scratch/prefix' > '$scratch/output' 2>&1 && cmake --install '$scratch/cmake' >> '$scratch/output'"
    check "cmake: find_package" host "$scratch/cmake-package/consumer" cmake_host package -DVIA=package -DCMAKE_PREFIX_PATH="$scratch/prefix"
    check "cmake: add_subdirectory" host "$scratch/cmake-subdirectory/consumer" cmake_host subdirectory -DVIA=subdirectory -DSOURCE="$root"
    if [ -n "$tarball" ]; then check "cmake: FetchContent" host "$scratch/cmake-fetch/consumer" cmake_host fetch -DVIA=fetch -DSOURCE="$tarball"; fi
fi

# ---- Meson ----
printf "project('trivial', 'c')\nexecutable('trivial', 'trivial.c')\n" > "$trivial/meson.build"
meson_host() { # project folder, build folder
    meson setup "$2" "$1" && meson compile -C "$2"
}
meson_trivial() { meson_host "$trivial" "$trivial/meson" && "$trivial/meson/trivial"; }
if needs Meson meson ninja && works Meson meson_trivial; then
    mkdir -p "$scratch/meson/subprojects/sph"
    cp "$here/consumer/main.c" "$here/consumer/meson.build" "$scratch/meson"
    cp sph.h sph_ops.h sph_kernels.h meson.build "$scratch/meson/subprojects/sph"
    check "meson: subproject" host "$scratch/meson/build/consumer" meson_host "$scratch/meson" "$scratch/meson/build"
    check "meson: install" sh -c "meson setup '$scratch/meson-sph' '$root' --prefix /usr > '$scratch/output' 2>&1 && DESTDIR='$scratch/meson-installed' meson install -C '$scratch/meson-sph' >> '$scratch/output'"
    check "meson: the same files" test "$(cd "$scratch/meson-installed" && find . -type f | LC_ALL=C sort | tr '\n' ' ')" = \
        "./usr/include/sph.h ./usr/include/sph_kernels.h ./usr/include/sph_ops.h ./usr/share/pkgconfig/sph.pc "
fi

# ---- Debian, Conan, vcpkg ----
debian_package() {
    mkdir -p "$scratch/debian" && cp -r Makefile LICENSE sph.h sph_ops.h sph_kernels.h "$here/debian" "$scratch/debian" &&
        (cd "$scratch/debian" && dpkg-buildpackage -us -uc -b) && dpkg-deb -x "$scratch/libsph-dev_${version}_all.deb" "$scratch/deb" &&
        $CC -std=c99 -o "$scratch/deb/host" -I"$scratch/deb/usr/include" "$here/consumer/main.c" -lm
}
package="the Debian package"
if needs "$package" dpkg-buildpackage dh && works "$package" dpkg-checkbuilddeps "$here/debian/control"; then
    check "debian: libsph-dev" host "$scratch/deb/host" debian_package
fi
if needs "the Conan recipe" conan && works "the Conan recipe" conan profile show; then
    check "conan: create" conan create "$here/conan"
fi
if needs "the vcpkg port" vcpkg && works "the vcpkg port" vcpkg version; then
    check "vcpkg: install" vcpkg install sph --overlay-ports="$here"
fi
finish packages
