# A package of Spack: var/spack/repos/builtin/packages/temper/package.py.
from spack.package import *


class Temper(CMakePackage):
    """Primal-dual triangle meshes that solvers can trust: moves vertices, changes weights and flips edges until every
    orthocenter is inside its triangle and every dual edge crosses its edge."""

    homepage = "https://github.com/temper-mesh/temper"
    git = "https://github.com/temper-mesh/temper.git"

    license("Apache-2.0", checked_by="temper-mesh")

    version("main", branch="main")
    version("0.1.0", tag="v0.1.0")

    variant("shared", default=True, description="Shared libraries")
    variant("netcdf", default=False, description="Meshes of MPAS and UGRID")
    variant("hdf5", default=False, description="Meshes in VTKHDF")
    variant("tbb", default=True, description="Threads by oneTBB")
    variant("errors", default=True, description="Errors of solvers on a mesh, by Eigen")
    variant("python", default=False, description="The Python module")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("cli11", type="build")
    depends_on("nlohmann-json", type="build")
    depends_on("clp")
    depends_on("fmt")
    depends_on("pugixml")
    depends_on("zlib-api")
    depends_on("eigen@3.3:", type="build")
    depends_on("tbb", when="+tbb")
    depends_on("netcdf-c@4.6.2:", when="+netcdf")
    depends_on("hdf5@1.10:~mpi", when="+hdf5")
    depends_on("py-pybind11@2.12:", when="+python", type="build")
    depends_on("py-numpy@1.22:", when="+python", type=("build", "run"))

    extends("python", when="+python")
    conflicts("%gcc@:11", msg="temper is written in C++20")

    def cmake_args(self):
        args = [
            self.define_from_variant("BUILD_SHARED_LIBS", "shared"),
            self.define_from_variant("TEMPER_BUILD_TBB", "tbb"),
            self.define_from_variant("TEMPER_BUILD_ERRORS", "errors"),
            self.define_from_variant("TEMPER_BUILD_PYTHON", "python"),
        ]
        if self.spec.satisfies("+python"):
            args.append(self.define("TEMPER_PYTHON", self.spec["python"].command.path))
            args.append(self.define("TEMPER_PYTHON_DIR", python_platlib))
        return args

    def setup_run_environment(self, env):
        # These are loaded when a file needs them, by their names, and Spack has each in a prefix of its own.
        if self.spec.satisfies("+netcdf"):
            env.set("TEMPER_NETCDF", self.spec["netcdf-c"].libs[0])
        if self.spec.satisfies("+hdf5"):
            env.set("TEMPER_HDF5", self.spec["hdf5"].libs[0])
