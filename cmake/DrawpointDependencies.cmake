# The packages that each part needs. A part that is switched off asks for nothing.

find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(PkgConfig REQUIRED)
pkg_check_modules(IPOPT REQUIRED IMPORTED_TARGET ipopt) # Ipopt ships only a pkg-config file
find_package(Threads REQUIRED)

if(DRAWPOINT_BUILD_ENGINE)
  find_package(Simbody 3.7 REQUIRED)
  find_package(fcl 0.7 REQUIRED)
  find_package(TBB 2021 REQUIRED COMPONENTS tbb)
  find_package(hwy 1.0 REQUIRED)
  enable_language(C) # FindHDF5 compiles a C program
  set(HDF5_PREFER_PARALLEL OFF)
  find_package(HDF5 REQUIRED COMPONENTS C)
endif()
if(DRAWPOINT_BUILD_STUDIES)
  find_package(SQLiteCpp REQUIRED)
  find_package(nlohmann_json 3.11 REQUIRED)
  find_package(CLI11 2.1 REQUIRED)
endif()
if(DRAWPOINT_BUILD_TESTS)
  find_package(GTest 1.12 REQUIRED)
  find_package(rapidcheck REQUIRED)
endif()
if(DRAWPOINT_BUILD_BENCHMARKS)
  find_package(benchmark 1.7 REQUIRED)
endif()
