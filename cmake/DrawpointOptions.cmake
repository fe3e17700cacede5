# What to build. Everything but the toolkit is for people who work on Drawpoint itself, so it is ON only at top level.

option(DRAWPOINT_BUILD_TOOLKIT "Build doe, kriging and pareto (need Ipopt)" ON)
option(DRAWPOINT_BUILD_ENGINE "Build the simulation engine (needs Simbody, FCL, oneTBB, Highway, HDF5)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_BUILD_STUDIES "Build the study runner and the studies (needs the engine, SQLite, CLI11)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_BUILD_TESTS "Build the tests (needs GoogleTest, RapidCheck)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_BUILD_FUZZERS "Build the fuzz targets of tests/fuzz (needs Clang)" OFF)
option(DRAWPOINT_BUILD_BENCHMARKS "Build the benchmarks (needs Google Benchmark, CLI11, nlohmann-json)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_INSTALL "Create the install rules" ${PROJECT_IS_TOP_LEVEL})

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

# Warnings and the floating-point contract of our own compiled code; never pushed on to consumers.
# Contraction is off because the same scenario and seed must give the same bits on every machine.
add_library(drawpoint_build_flags INTERFACE)
target_compile_options(drawpoint_build_flags INTERFACE -Wall -Wextra -ffp-contract=off)

# The engine's folders in dependency order; a shorter list builds a part of it (contact alone, for a solver benchmark).
set(DRAWPOINT_ENGINE_FOLDERS contact machine granular record loading CACHE STRING "Folders of engine/ to build")
