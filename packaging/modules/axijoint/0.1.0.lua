-- axijoint for Lmod: MODULEPATH leads to the folder above this one (doc/install.md)
local prefix = "/opt/axijoint/" .. myModuleVersion() -- where it was installed

whatis("Name: axijoint")
whatis("Version: " .. myModuleVersion())
whatis("Description: finite element analysis of axisymmetric bodies with joints that open and slip")
help([[axijoint help; man axijoint (found by PATH). Threads: OMP_NUM_THREADS or axijoint run --threads.]])

-- Modules that it was built with, if its libraries are theirs:
-- depends_on("gcc/12", "hdf5", "openblas", "metis", "suite-sparse")

prepend_path("PATH", pathJoin(prefix, "bin"))
prepend_path("CMAKE_PREFIX_PATH", prefix)
setenv("AXIJOINT", pathJoin(prefix, "bin/axijoint")) -- which the Python package runs
