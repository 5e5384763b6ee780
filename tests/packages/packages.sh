#!/bin/sh
# SPDX-License-Identifier: MIT
# Every way to get the headers but copying them: installed by make, CMake, Meson, as a Debian package and as
# one file. All that install give the same files, byte for byte. A host is built from each and run, in a
# folder with a space. Skips aloud where a tool is not installed, or does not work.
#     make check-packages
. tests/check.sh
root=$PWD
here=$root/tests/packages
version=$(make -s version)
says="sph.h $version: density"
scratch=$(cd "$scratch" && pwd)
place="$scratch/a folder"
mkdir -p "$place"

# a command after which the program $1 must exist and print its version
host() {
    program=$1
    shift
    : > "$scratch/said"
    "$@" > "$scratch/output" 2>&1 && "$program" > "$scratch/said" 2>&1 &&
        grep -q -F "$says" "$scratch/said" && return
    cat "$scratch/output" "$scratch/said" 2> /dev/null
    return 1
}

check "vcpkg: the version" grep -q "\"version\": \"$version\"" "$here/vcpkg/sph/vcpkg.json"
check "debian: the version" sh -c "head -n 1 '$here/debian/changelog' | grep -F '($version)'"
check "the citation: the version" grep -q -x "version: $version" CITATION.cff
check "the change log: version and date" \
    grep -q -x "## $version ($(sed -n 's/^date-released: //p' CITATION.cff))" CHANGELOG.md

# ---- make install: to a relative prefix with a space, which then moves ----
check "make install" make -s install PREFIX="made here" DESTDIR="$place/"
mv "$place/made here" "$place/moved"
moved=$place/moved
check "what is installed" test "$(cd "$moved" && find . -type f | LC_ALL=C sort)" = "./include/sph.h
./include/sph_kernels.h
./include/sph_ops.h
./share/cmake/sph/sphConfig.cmake
./share/cmake/sph/sphConfigVersion.cmake
./share/pkgconfig/sph.pc"
check "host of installed headers" host "$place/plain" \
    $CC -std=c99 -o "$place/plain" -I"$moved/include" "$here/consumer/main.c" -lm
by_pkg_config() { # its flags have escapes for the shell
    eval "$CC -std=c99 -o '$place/pc' '$here/consumer/main.c' $(pkg-config --cflags --libs sph)"
}
export PKG_CONFIG_PATH="$moved/share/pkgconfig"
if needs pkg-config pkg-config && works pkg-config pkg-config --version; then
    check "pkg-config: version" test "$(pkg-config --modversion sph)" = "$version"
    check "host by pkg-config" host "$place/pc" by_pkg_config
fi
check "make uninstall" sh -c "cp -r '$moved' '$place/gone' && make -s uninstall PREFIX='$place/gone'"
check "nothing is left" test -z "$(find "$place/gone" -type f -o -name sph)"

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
    check "make dist" make -s dist DIST="$place/dist"
    tarball=$place/dist/sph-$version.tar.gz
    check "the tarball has the headers" sh -c "tar -tzf '$tarball' | grep -q '^sph-$version/sph_ops.h'"
    check "sph_all.h beside it" test -s "$place/dist/sph_all.h"
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
cmake_install() {
    cmake -S "$root" -B "$place/cmake" -DCMAKE_INSTALL_PREFIX=/nowhere &&
        cmake --install "$place/cmake" --prefix "$place/by cmake"
}
cmake_host() { # name, options ...
    build=$place/cmake-$1
    shift
    cmake -S "$here/consumer" -B "$build" "$@" && cmake --build "$build"
}
found() { # the version that a host asks for
    cmake -DPACKAGE_FIND_VERSION="$1" -P "$scratch/found.cmake"
}
if needs CMake cmake && works CMake cmake_trivial; then
    check "cmake: install" cmake_install
    check "cmake: the same files" diff -r "$moved" "$place/by cmake"
    check "cmake: find_package" host "$place/cmake-package/consumer" \
        cmake_host package -DVIA=package -DCMAKE_PREFIX_PATH="$moved"
    check "cmake: add_subdirectory" host "$place/cmake-subdirectory/consumer" \
        cmake_host subdirectory -DVIA=subdirectory -DSOURCE="$root"
    if [ -n "$tarball" ]; then
        check "cmake: FetchContent" host "$place/cmake-fetch/consumer" \
            cmake_host fetch -DVIA=fetch -DSOURCE="$tarball"
    fi
    printf 'include("%s")\nif(NOT PACKAGE_VERSION_COMPATIBLE)\nmessage(FATAL_ERROR refused)\nendif()\n' \
        "$moved/share/cmake/sph/sphConfigVersion.cmake" > "$scratch/found.cmake"
    for asked in "$version" "${version%.*}"; do check "cmake: finds $asked" found "$asked"; done
    for asked in 0.0 0.1 0.1.9 "$version.1" "${version%.*}.99" 99; do
        check "cmake: does not take this for $asked" answers 1 refused found "$asked"
    done
fi

# ---- Meson ----
printf "project('trivial', 'c')\nexecutable('trivial', 'trivial.c')\n" > "$trivial/meson.build"
meson_host() { # project folder, build folder, options
    project=$1 build=$2
    shift 2
    meson setup "$build" "$project" "$@" && meson compile -C "$build"
}
meson_trivial() { meson_host "$trivial" "$trivial/meson" && "$trivial/meson/trivial"; }
meson_install() {
    meson setup "$place/meson-sph" "$root" --prefix /usr &&
        DESTDIR="$place/by meson" meson install -C "$place/meson-sph"
}
if needs Meson meson ninja && works Meson meson_trivial; then
    mkdir -p "$place/meson/subprojects/sph/tests/packages"
    cp "$here/consumer/main.c" "$here/consumer/meson.build" "$place/meson"
    cp sph.h sph_ops.h sph_kernels.h meson.build "$place/meson/subprojects/sph"
    cp -r "$here/install" "$place/meson/subprojects/sph/tests/packages"
    check "meson: subproject" host "$place/meson/build/consumer" \
        meson_host "$place/meson" "$place/meson/build" --force-fallback-for=sph
    check "meson: install" meson_install
    check "meson: the same files" diff -r "$moved" "$place/by meson/usr"
    if installed pkg-config; then
        check "meson: installed" host "$place/meson-installed/consumer" \
            meson_host "$here/consumer" "$place/meson-installed" --wrap-mode=nofallback
    fi
fi

# ---- Debian, Conan, vcpkg ----
debian_package() {
    mkdir -p "$place/debian/tests/packages" &&
        cp -r Makefile LICENSE sph.h sph_ops.h sph_kernels.h "$here/debian" "$place/debian" &&
        cp -r "$here/install" "$place/debian/tests/packages" &&
        (cd "$place/debian" && dpkg-buildpackage -us -uc -b) &&
        dpkg-deb -x "$place/libsph-dev_${version}_all.deb" "$place/by debian" &&
        $CC -std=c99 -o "$place/by debian/host" -I"$place/by debian/usr/include" "$here/consumer/main.c" -lm
}
package="the Debian package"
if needs "$package" dpkg-buildpackage dh && works "$package" dpkg-checkbuilddeps "$here/debian/control"; then
    check "debian: libsph-dev" host "$place/by debian/host" debian_package
    check "debian: the same files" diff -r -x doc "$moved" "$place/by debian/usr"
    if needs "lintian's word on the Debian package" lintian; then
        check "debian: lintian" lintian --no-cfg --allow-root --fail-on error "$place"/sph_*.changes
    fi
fi
check "vcpkg: the port has the name of its folder" grep -q '"name": "sph"' "$here/vcpkg/sph/vcpkg.json"
if needs "the Conan recipe" conan && works "the Conan recipe" conan profile show; then
    check "conan: create" conan create "$here/conan"
fi
if needs "the vcpkg port" vcpkg && works "the vcpkg port" vcpkg version; then
    check "vcpkg: install" vcpkg install sph --overlay-ports="$here/vcpkg"
fi
finish packages
