# SPDX-License-Identifier: MIT
#     conan create tests/packages/conan          from the root of the repository (Conan 2)
import os
import re

from conan import ConanFile
from conan.tools.files import copy, load


class Sph(ConanFile):
    name = "sph"
    description = "Header-only C99 toolkit of kernels and operators for smoothed particle hydrodynamics"
    license = "MIT"
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"  # of the host, which alone is compiled
    no_copy_source = True
    headers = ("sph.h", "sph_ops.h", "sph_kernels.h")

    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._root(), "sph_kernels.h"))
        self.version = ".".join(re.findall(r"#define SPH_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", text))

    def export_sources(self):
        for name in (*self.headers, "LICENSE"):
            copy(self, name, self._root(), self.export_sources_folder)

    def package(self):
        for name in self.headers:
            copy(self, name, self.source_folder, os.path.join(self.package_folder, "include"))
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))

    def package_id(self):
        self.info.clear()

    def package_info(self):
        # what find_package(sph) and pkg-config find: Conan writes these files itself
        self.cpp_info.set_property("cmake_file_name", "sph")
        self.cpp_info.set_property("cmake_target_name", "sph::sph")
        self.cpp_info.set_property("pkg_config_name", "sph")
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["m"]
