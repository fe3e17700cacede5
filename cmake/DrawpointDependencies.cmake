# The packages that each part needs. A part that is switched off asks for nothing.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
if(DRAWPOINT_BUILD_TOOLKIT)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET ipopt) # Ipopt ships only a pkg-config file
endif()
find_package(Threads REQUIRED)

if(DRAWPOINT_BUILD_ENGINE)
  find_package(Simbody 3.7 REQUIRED)
endif()
if(DRAWPOINT_BUILD_CONTACT)
  find_package(fcl 0.7 REQUIRED)
  find_package(hwy 1.0 REQUIRED)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(QHULL REQUIRED IMPORTED_TARGET qhull_r) # its CMake files name a static library, which need not be there
endif()
if(DRAWPOINT_BUILD_CONTACT OR DRAWPOINT_BUILD_STUDIES)
  find_package(PkgConfig REQUIRED)
  pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5) # FindHDF5 gives paths, which an exported target must not hold
endif()
if(DRAWPOINT_BUILD_STUDIES)
  find_package(SQLiteCpp REQUIRED)
  find_package(PkgConfig REQUIRED)
  # Debian's is a compiled library whose classes depend on the flags that its pkg-config file names
  pkg_check_modules(HTTPLIB REQUIRED IMPORTED_TARGET cpp-httplib)
endif()
if(DRAWPOINT_BUILD_STUDIES OR DRAWPOINT_BUILD_BENCHMARKS)
  find_package(nlohmann_json 3.11 REQUIRED)
  find_package(CLI11 2.1 REQUIRED)
endif()
if(DRAWPOINT_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(rapidcheck REQUIRED)
  find_package(nlohmann_json 3.11 QUIET) # for kriging/save.hpp and save_fidelities.hpp alone
endif()
if(DRAWPOINT_BUILD_BENCHMARKS)
  find_package(benchmark 1.7 REQUIRED)
  find_package(CLI11 2.1 REQUIRED)
  find_package(nlohmann_json 3.11 REQUIRED)
endif()
