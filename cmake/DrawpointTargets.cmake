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

# drawpoint_test(MODULE FILE_STEM LIBRARY...): one executable and one ctest entry a file; the label is the stem's suffix,
# so that `ctest -L analytic` runs every *_analytic.cpp. The target tests_of_MODULE builds all of a module.
function(drawpoint_test module stem)
  set(target test_${module}_${stem})
  add_executable(${target} ${stem}.cpp)
  target_link_libraries(${target} PRIVATE ${ARGN} drawpoint_build_flags GTest::gtest_main)
  target_compile_definitions(${target} PRIVATE DRAWPOINT_TEST_REFERENCE="${PROJECT_SOURCE_DIR}/tests/reference")
  set_target_properties(${target} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  add_test(NAME ${module}.${stem} COMMAND ${target})
  if(NOT TARGET tests_of_${module})
    add_custom_target(tests_of_${module})
  endif()
  add_dependencies(tests_of_${module} ${target})
  string(REGEX MATCH "[a-z]+$" label ${stem})
  set(limit 600)
  if(CMAKE_BUILD_TYPE STREQUAL "Debug") # the sanitizers' presets
    set(limit 7200)
  endif()
  set_tests_properties(${module}.${stem} PROPERTIES LABELS "${label};${module}" TIMEOUT ${limit})
endfunction()

# drawpoint_benchmark(FILE_STEM LIBRARY...): one executable in <build>/benchmarks.
function(drawpoint_benchmark stem)
  add_executable(${stem} ${stem}.cpp)
  target_link_libraries(${stem} PRIVATE ${ARGN} drawpoint_build_flags)
  set_target_properties(${stem} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/benchmarks)
endfunction()
