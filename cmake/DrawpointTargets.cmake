# The repository root is the include directory "drawpoint/": one link in the build tree makes
# <drawpoint/kriging/fit.hpp> true there, as the install makes it true elsewhere.
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/include)
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${PROJECT_BINARY_DIR}/include/drawpoint SYMBOLIC)

# drawpoint_header_module(NAME): the header-only target Drawpoint::NAME.
function(drawpoint_header_module name)
  add_library(drawpoint_${name} INTERFACE)
  add_library(Drawpoint::${name} ALIAS drawpoint_${name})
  set_target_properties(drawpoint_${name} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(drawpoint_${name} INTERFACE cxx_std_20)
  target_include_directories(drawpoint_${name} INTERFACE
    $<BUILD_INTERFACE:${PROJECT_BINARY_DIR}/include> $<INSTALL_INTERFACE:include>)
endfunction()

# drawpoint_compiled_apart(TARGET DEFINITION ON|OFF): whether the target and all that it is linked with have the definition; CMake
# refuses to link it with one that says otherwise, where some functions would have two bodies.
function(drawpoint_compiled_apart target definition value)
  set_property(TARGET ${target} PROPERTY INTERFACE_${definition} ${value})
  set_property(TARGET ${target} APPEND PROPERTY COMPATIBLE_INTERFACE_BOOL ${definition})
endfunction()

# drawpoint_compile_once(NAME): two more targets of the header-only module NAME, whose <NAME>/compiled.cpp holds what is no
# template. Drawpoint::<NAME>_compiled compiles that once per target that links it instead of in each file;
# drawpoint_<NAME>_once compiles it once for all programs of this tree that take it.
function(drawpoint_compile_once name)
  string(TOUPPER DRAWPOINT_${name}_COMPILED definition)
  add_library(drawpoint_${name}_compiled INTERFACE)
  add_library(Drawpoint::${name}_compiled ALIAS drawpoint_${name}_compiled)
  set_target_properties(drawpoint_${name}_compiled PROPERTIES EXPORT_NAME ${name}_compiled)
  target_link_libraries(drawpoint_${name}_compiled INTERFACE drawpoint_${name})
  target_compile_definitions(drawpoint_${name}_compiled INTERFACE ${definition})
  drawpoint_compiled_apart(drawpoint_${name}_compiled ${definition} ON)
  target_sources(drawpoint_${name}_compiled INTERFACE
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/compiled.cpp> $<INSTALL_INTERFACE:include/drawpoint/${name}/compiled.cpp>)

  add_library(drawpoint_${name}_once STATIC EXCLUDE_FROM_ALL compiled.cpp)
  # for the Python module, a shared library
  set_target_properties(drawpoint_${name}_once PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
                        VISIBILITY_INLINES_HIDDEN ON)
  target_link_libraries(drawpoint_${name}_once PUBLIC drawpoint_${name} PRIVATE drawpoint_build_flags)
  target_compile_definitions(drawpoint_${name}_once PUBLIC ${definition})
  drawpoint_compiled_apart(drawpoint_${name}_once ${definition} ON)
endfunction()

# drawpoint_precompile(TARGET HEADER...): compiles the headers once for all files of the target, which include them all the
# same. Worth its five seconds from five files on.
function(drawpoint_precompile target)
  list(TRANSFORM ARGN REPLACE "(.+)" "<\\1>" OUTPUT_VARIABLE headers)
  target_precompile_headers(${target} PRIVATE ${headers})
endfunction()

# GCC takes the types of a .cpp that it meets through #include for types of a header.
set(drawpoint_joined_flags $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)

# drawpoint_join(TARGET GROUP FILE...): compiles the files as one, so that the templates that they share are instantiated once.
# What is in their anonymous namespaces needs names that are unique among them.
function(drawpoint_join target group)
  if(DRAWPOINT_JOIN_SOURCES)
    set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${group})
    set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
    target_compile_options(${target} PRIVATE ${drawpoint_joined_flags})
  endif()
endfunction()

# drawpoint_tests(MODULE STEMS stem... [LIBRARIES library...] [OPTIMISED]): one program test_MODULE of all the files,
# and one ctest entry MODULE.stem per file, which runs the tests that the file defines. Its label is the stem's suffix, so that
# `ctest -L analytic` runs every *_analytic.cpp. The target tests_of_MODULE builds all programs of a module. Tests are optimised
# little: what is saved in compiling them is more than what they then take longer to run, but for the OPTIMISED.
function(drawpoint_tests module)
  cmake_parse_arguments(arg "OPTIMISED" "PROGRAM" "STEMS;LIBRARIES" ${ARGN})
  set(target test_${module})
  if(arg_PROGRAM)
    set(target test_${arg_PROGRAM})
  endif()
  list(TRANSFORM arg_STEMS APPEND .cpp OUTPUT_VARIABLE files)
  add_executable(${target} ${files})
  target_link_libraries(${target} PRIVATE ${arg_LIBRARIES} drawpoint_build_flags GTest::gtest_main)
  if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT arg_OPTIMISED)
    target_compile_options(${target} PRIVATE -O1)
  endif()
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  drawpoint_join_tests(${target} ${files})
  if(NOT TARGET tests_of_${module})
    add_custom_target(tests_of_${module})
  endif()
  add_dependencies(tests_of_${module} ${target})
  set(all)
  foreach(stem IN LISTS arg_STEMS)
    drawpoint_test_filter(${CMAKE_CURRENT_SOURCE_DIR}/${stem}.cpp filter)
    drawpoint_add_test(${module} ${stem} ${target} --gtest_filter=${filter})
    set_tests_properties(${module}.${stem} PROPERTIES FAIL_REGULAR_EXPRESSION "Running 0 tests")
    string(APPEND all ":${filter}")
  endforeach()
  # What no file's filter names would never run.
  add_test(NAME ${module}.${target}_all_tests_are_listed COMMAND ${target} "--gtest_filter=-${all}")
  set_tests_properties(${module}.${target}_all_tests_are_listed PROPERTIES LABELS ${module} PASS_REGULAR_EXPRESSION "Running 0 tests")
endfunction()

# drawpoint_join_tests(TARGET FILE...): compiles up to 13 files of tests at a time, so that the templates that they all use are
# instantiated once. Each file stands in a namespace of its own, after all headers of all files: names need to be unique
# in their file only. So such a file names its own headers in <>, and opens no namespace of the tree.
function(drawpoint_join_tests target)
  list(LENGTH ARGN count)
  if(NOT DRAWPOINT_JOIN_SOURCES OR count LESS 2)
    return()
  endif()
  set(headers)
  foreach(file IN LISTS ARGN)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${file})
    file(STRINGS ${CMAKE_CURRENT_SOURCE_DIR}/${file} lines REGEX "^#include <")
    list(APPEND headers ${lines})
  endforeach()
  list(REMOVE_DUPLICATES headers)
  list(JOIN headers "\n" headers)
  set(all_headers ${CMAKE_CURRENT_BINARY_DIR}/${target}_headers.hpp)
  file(CONFIGURE OUTPUT ${all_headers} CONTENT "#pragma once\n${headers}\n" @ONLY)
  math(EXPR batches "(${count} + 12) / 13")
  math(EXPR size "(${count} + ${batches} - 1) / ${batches}")
  target_compile_options(${target} PRIVATE ${drawpoint_joined_flags})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE ${size} UNITY_BUILD_UNIQUE_ID this_file
    UNITY_BUILD_CODE_BEFORE_INCLUDE "#include \"${all_headers}\"\nnamespace this_file {" UNITY_BUILD_CODE_AFTER_INCLUDE "}")
endfunction()

# drawpoint_test_filter(FILE OUTPUT): the GoogleTest filter for the tests that the file defines.
function(drawpoint_test_filter file output)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${file})
  file(READ ${file} text)
  string(REGEX MATCHALL "(TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP)\\([ \n]*[A-Za-z0-9_]+,[ \n]*[A-Za-z0-9_]+" heads "${text}")
  set(names)
  foreach(head IN LISTS heads)
    string(REGEX MATCH "^([A-Z_]+)\\([ \n]*([A-Za-z0-9_]+),[ \n]*([A-Za-z0-9_]+)" head "${head}")
    set(name ${CMAKE_MATCH_2}.${CMAKE_MATCH_3})
    if(CMAKE_MATCH_1 STREQUAL "TEST_P")
      set(name */${name}/*)
    elseif(CMAKE_MATCH_1 STREQUAL "TYPED_TEST")
      set(name ${CMAKE_MATCH_2}/*.${CMAKE_MATCH_3})
    endif()
    list(APPEND names ${name})
  endforeach()
  list(JOIN names ":" names)
  set(${output} "${names}" PARENT_SCOPE)
endfunction()

# drawpoint_long_tests(NAME SECONDS...): `ctest --parallel` starts the longest first, so that none is left over at the end.
function(drawpoint_long_tests)
  while(ARGN)
    list(POP_FRONT ARGN name seconds)
    set_tests_properties(${name} PROPERTIES COST ${seconds})
  endwhile()
endfunction()

function(drawpoint_add_test module stem)
  add_test(NAME ${module}.${stem} COMMAND ${ARGN})
  string(REGEX MATCH "[a-z]+$" label ${stem})
  set(limit 600)
  if(CMAKE_BUILD_TYPE STREQUAL "Debug") # the sanitizers' presets
    set(limit 7200)
  endif()
  set_tests_properties(${module}.${stem} PROPERTIES LABELS "${label};${module}" TIMEOUT ${limit})
endfunction()

# drawpoint_benchmark(FILE_STEM LIBRARY...): one executable in <build>/benchmarks. `FOLDER_benchmarks` builds those of its
# folder, `all_benchmarks` those of all, `checked_benchmarks` (.ci/run) those that are not tried otherwise: a folder that
# does so sets drawpoint_tried_apart for them.
function(drawpoint_benchmark stem)
  add_executable(${stem} ${stem}.cpp)
  target_link_libraries(${stem} PRIVATE ${ARGN} drawpoint_build_flags)
  set_target_properties(${stem} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/benchmarks)
  get_filename_component(folder ${CMAKE_CURRENT_SOURCE_DIR} NAME)
  if(NOT TARGET ${folder}_benchmarks)
    add_custom_target(${folder}_benchmarks)
    add_dependencies(all_benchmarks ${folder}_benchmarks)
  endif()
  add_dependencies(${folder}_benchmarks ${stem})
  if(NOT drawpoint_tried_apart)
    add_dependencies(checked_benchmarks ${stem})
  endif()
endfunction()
