"""axijoint for Spack. In a repository of one's own (doc/install.md): packages/axijoint/package.py"""
from spack_repo.builtin.build_systems.cmake import CMakePackage

from spack.package import *


class Axijoint(CMakePackage):
    """Fourier finite element analysis of axisymmetric bodies with joints that open and slip"""

    # The repository; with `spack develop --path DIRECTORY axijoint@main` nothing is fetched from it
    homepage = "https://localhost/axijoint"
    git = "https://localhost/axijoint.git"

    license("GPL-3.0-or-later")

    version("main", branch="main")

    depends_on("c", type="build")
    depends_on("fortran", type="build")
    depends_on("cmake@3.20:", type="build")
    depends_on("hdf5+fortran~mpi")
    depends_on("openblas threads=pthreads")
    depends_on("metis@5:~int64")
    depends_on("suite-sparse@7:")

    requires("%gcc@12:", msg="axijoint is built with gfortran 12 or later")

    def cmake_args(self):
        return [self.define("HDF5_ROOT", self.spec["hdf5"].prefix)]
