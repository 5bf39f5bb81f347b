# SPDX-License-Identifier: GPL-3.0-or-later
# Recipe for Spack 1: packages/shizuku/package.py of a repository of recipes; spack dev-build shizuku@0.4.0 in a source tree.
from spack_repo.builtin.build_systems.cmake import CMakePackage, generator
from spack_repo.builtin.build_systems.cuda import CudaPackage

from spack.package import *


class Shizuku(CMakePackage, CudaPackage):
    """Position based droplets on wettable solids."""

    license("GPL-3.0-or-later")
    version("0.4.0")
    generator("ninja")
    variant("mpi", default=True, description="pbfDroplet -parallel")
    variant("cgal", default=True, description="sampleSurface")
    variant("vtk", default=True, description="ParaView files and pictures")

    depends_on("cxx", type="build")
    depends_on("cmake@3.22:", type="build")
    depends_on("boost@1.74:+program_options")
    depends_on("eigen@3.3:")
    depends_on("cuda@12:", when="+cuda")
    depends_on("thrust@1.16:", when="~cuda")
    depends_on("cub@1.16:1", when="~cuda")
    depends_on("mpi", when="+mpi")
    depends_on("cgal", when="+cgal")
    depends_on("vtk@9:", when="+vtk")
    conflicts("%gcc@:11", msg="C++20 of g++ 12 is needed")

    def cmake_args(self):
        cuda = self.spec.satisfies("+cuda")
        args = [self.define("SHIZUKU_CUDA", "REQUIRED" if cuda else "OFF")]
        if cuda and not self.spec.satisfies("cuda_arch=none"):
            args.append(self.define("CMAKE_CUDA_ARCHITECTURES", self.spec.variants["cuda_arch"].value))
        return args
