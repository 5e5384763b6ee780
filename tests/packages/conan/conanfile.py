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
    no_copy_source = True
    headers = ("sph.h", "sph_ops.h", "sph_kernels.h")

    def _root(self):
        return os.path.join(self.recipe_folder, "..", "..", "..")

    def set_version(self):
        text = load(self, os.path.join(self._root(), "sph_kernels.h"))
        self.version = ".".join(re.search(rf"#define SPH_VERSION_{part} (\d+)", text).group(1) for part in ("MAJOR", "MINOR", "PATCH"))

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
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.system_libs = ["m"] if self.settings.get_safe("os") != "Windows" else []
