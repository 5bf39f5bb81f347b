# SPDX-License-Identifier: GPL-3.0-or-later
# Spack's recipe: packages/shizuku/package.py of a repository of recipes; spack dev-build shizuku@0.3.0 in a source tree.
from spack.package import *


class Shizuku(CMakePackage, CudaPackage):
    """Position based droplets on wettable solids."""

    version("0.3.0")
    generator("ninja")
    variant("mpi", default=True, description="pbfDroplet -parallel")
    variant("cgal", default=True, description="sampleSurface")
    variant("vtk", default=True, description="ParaView files and pictures")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("boost@1.74:+program_options")
    depends_on("cuda@12:", when="+cuda")
    depends_on("cccl", when="~cuda")
    depends_on("mpi", when="+mpi")
    depends_on("cgal", when="+cgal")
    depends_on("vtk@9:", when="+vtk")
    conflicts("%gcc@:11", msg="C++20 of g++ 12 is needed")

    def cmake_args(self):
        return [self.define("SHIZUKU_CUDA", "REQUIRED" if self.spec.satisfies("+cuda") else "OFF")]
