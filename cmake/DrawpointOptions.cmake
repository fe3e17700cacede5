# What to build. Everything but the toolkit is for people who work on Drawpoint itself, so it is ON only at top level.

option(DRAWPOINT_BUILD_TOOLKIT "Build doe, kriging and pareto (need Ipopt)" ON)
option(DRAWPOINT_BUILD_CONTACT "Build rocks and contact solving (needs FCL, Highway, HDF5)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_BUILD_ENGINE "Build machines and the loading case (needs DRAWPOINT_BUILD_CONTACT and Simbody)" ${DRAWPOINT_BUILD_CONTACT})
set(studies_by_default OFF)
if(PROJECT_IS_TOP_LEVEL AND DRAWPOINT_BUILD_TOOLKIT AND DRAWPOINT_BUILD_ENGINE)
  set(studies_by_default ON)
endif()
option(DRAWPOINT_BUILD_STUDIES "Build the study runner and the studies (needs the toolkit, SQLite, HDF5, CLI11; the loading study also the engine)" ${studies_by_default})
option(DRAWPOINT_BUILD_PYTHON "Build the Python module (needs the toolkit, pybind11, nlohmann-json); skipped where these are missing" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_BUILD_TESTS "Build the tests (needs GoogleTest, RapidCheck)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_BUILD_FUZZERS "Build the fuzz targets of tests/fuzz (needs Clang)" OFF)
option(DRAWPOINT_BUILD_BENCHMARKS "Build the benchmarks (needs Google Benchmark, CLI11, nlohmann-json)" ${PROJECT_IS_TOP_LEVEL})
option(DRAWPOINT_JOIN_SOURCES "Compile several sources at a time (off: each by itself, as clang-tidy wants them)" ON)
option(DRAWPOINT_INSTALL "Create the install rules" ${PROJECT_IS_TOP_LEVEL})

if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
if(PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(DRAWPOINT_CCACHE ccache DOC "Compiler cache, used where it is found")
  if(DRAWPOINT_CCACHE)
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros ${DRAWPOINT_CCACHE})
    add_compile_options(-fpch-preprocess) # so that it may keep what was compiled with a precompiled header
  endif()
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
if(PROJECT_IS_TOP_LEVEL)
  set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
endif()

# Warnings and the floating-point contract of our own compiled code; never pushed on to consumers.
# Contraction is off because the same scenario and seed must give the same bits on every machine.
add_library(drawpoint_build_flags INTERFACE)
target_compile_options(drawpoint_build_flags INTERFACE -Wall -Wextra -ffp-contract=off)

if(DRAWPOINT_BUILD_ENGINE AND NOT DRAWPOINT_BUILD_CONTACT)
  message(FATAL_ERROR "DRAWPOINT_BUILD_ENGINE is ON and DRAWPOINT_BUILD_CONTACT is OFF, but machines work on contacts; switch both on or both off")
endif()
if(DRAWPOINT_BUILD_STUDIES AND NOT DRAWPOINT_BUILD_TOOLKIT)
  message(FATAL_ERROR "DRAWPOINT_BUILD_STUDIES is ON and DRAWPOINT_BUILD_TOOLKIT is OFF, but studies use doe, kriging and pareto; switch both on or both off")
endif()
