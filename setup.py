# SPDX-License-Identifier: MIT
"""What pyproject.toml cannot say: how the shim is built, a plain shared library beside the module that opens
it with ctypes. CC and CFLAGS are obeyed."""

import os
import re

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

HEADERS = ["sph_kernels.h", "sph_ops.h", "sph.h"]
SHIM = "examples/hosts/"


class BuildShim(build_ext):
    def get_export_symbols(self, ext):
        return []  # it is no module of Python, and says itself what it exports

    def build_extension(self, ext):
        if self.compiler.compiler_type == "msvc":
            ext.extra_compile_args = ["/O2"]
        else:
            ext.extra_compile_args = ["-std=c99", "-O2", "-fopenmp-simd", "-DSPH_SIMD=1"]
            ext.libraries = ["m"]
        super().build_extension(ext)


with open("sph_kernels.h", encoding="utf-8") as file:
    version = ".".join(re.findall(r"#define SPH_VERSION_(?:MAJOR|MINOR|PATCH) (\d+)", file.read()))
os.makedirs("build", exist_ok=True)
setup(
    version=version,
    packages=["sph"],
    package_dir={"sph": SHIM + "sph"},
    package_data={"sph": ["py.typed"]},
    options={"egg_info": {"egg_base": "build"}},
    ext_modules=[
        Extension(
            "sph.sph_shim",
            [SHIM + "sph_shim.c"],
            include_dirs=["."],
            depends=HEADERS
            + [SHIM + name for name in ("sph_shim.h", "sph_shim_sweeps.h", "sph_shim_sweeps.c")],
        )
    ],
    cmdclass={"build_ext": BuildShim},
)
