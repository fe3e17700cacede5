# Install, export and packages. A component is one module: its headers, its library if it has one, its export file.
# The component `common` is what all need: the package config and the licence. The component `programs` is the
# studies to run, with what studies/launcher/CMakeLists.txt adds to them, `python` the Python module; `everything` is a package that brings all
# modules.

if(NOT DRAWPOINT_INSTALL OR NOT DRAWPOINT_BUILD_TOOLKIT)
  return()
endif()
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(drawpoint_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Drawpoint)

# drawpoint_install_target(COMPONENT): the target and its export file.
function(drawpoint_install_target component)
  install(TARGETS drawpoint_${component} EXPORT Drawpoint-${component}
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component})
  install(EXPORT Drawpoint-${component} NAMESPACE Drawpoint:: FILE DrawpointTargets-${component}.cmake
          DESTINATION ${drawpoint_cmake_dir} COMPONENT ${component})
endfunction()

# Headers that the component `record` installs from a folder of another.
set(drawpoint_headers_elsewhere "^$")
if(TARGET drawpoint_record)
  list(JOIN drawpoint_record_headers "|/" drawpoint_headers_elsewhere)
  string(PREPEND drawpoint_headers_elsewhere "/")
endif()

# drawpoint_install(COMPONENT [FOLDER...]): the target, its export file and the headers of its folders.
function(drawpoint_install component)
  drawpoint_install_target(${component})
  set(folders ${ARGN})
  if(NOT folders)
    set(folders ${component})
  endif()
  foreach(folder IN LISTS folders)
    install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/ DESTINATION include/drawpoint/${folder}
            COMPONENT ${component} FILES_MATCHING PATTERN "*.hpp" REGEX "/studies/[a-z_]+$" EXCLUDE # rooms, all inside
            REGEX "${drawpoint_headers_elsewhere}" EXCLUDE)
  endforeach()
endfunction()

foreach(component kriging pareto)
  install(TARGETS drawpoint_${component}_compiled EXPORT Drawpoint-${component})
  install(FILES ${component}/compiled.cpp DESTINATION include/drawpoint/${component} COMPONENT ${component})
endforeach()
foreach(component doe kriging pareto)
  drawpoint_install(${component})
endforeach()
# The programs of docs/tutorials/first-pile.md, docs/how-to/toolkit-in-a-project.md and docs/reference/studies.md.
file(GLOB drawpoint_examples ${PROJECT_SOURCE_DIR}/tests/consumer/*.cpp ${PROJECT_SOURCE_DIR}/tests/consumer/engine/*.cpp
     ${PROJECT_SOURCE_DIR}/tests/consumer/studies/*.cpp)
install(FILES ${drawpoint_examples} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drawpoint/examples COMPONENT common)
if(TARGET drawpoint_record)
  drawpoint_install_target(record)
  install(FILES ${drawpoint_record_headers} DESTINATION include/drawpoint/engine/record COMPONENT record)
endif()
if(DRAWPOINT_BUILD_CONTACT)
  list(TRANSFORM drawpoint_contact_folders PREPEND engine/ OUTPUT_VARIABLE folders)
  drawpoint_install(contact ${folders})
endif()
if(DRAWPOINT_BUILD_ENGINE)
  list(TRANSFORM drawpoint_engine_folders PREPEND engine/ OUTPUT_VARIABLE folders)
  drawpoint_install(engine ${folders})
endif()
if(DRAWPOINT_BUILD_STUDIES)
  drawpoint_install(studies)
  install(FILES studies/throw.json studies/throw.py DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drawpoint/examples COMPONENT programs EXCLUDE_FROM_ALL)
  install(FILES CHANGELOG.md docs/reference/studies.md docs/tutorials/first-study.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drawpoint
          COMPONENT programs EXCLUDE_FROM_ALL)
  # Of what the programs hold: the report's libraries, and Debian's packages of headers and of a static library.
  foreach(library plotly.js-dist-min three)
    install(FILES ${PROJECT_BINARY_DIR}/studies/say/page/npm/node_modules/${library}/LICENSE RENAME copyright.${library}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drawpoint COMPONENT programs EXCLUDE_FROM_ALL)
  endforeach()
  foreach(package libeigen3-dev libcli11-dev nlohmann-json3-dev libsqlitecpp-dev libcpp-httplib-dev)
    install(FILES /usr/share/doc/${package}/copyright RENAME copyright.${package}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drawpoint COMPONENT programs EXCLUDE_FROM_ALL OPTIONAL)
  endforeach()
endif()

if(TARGET drawpoint_python)
  # The place of Debian's own packages of Python; pybind11 and Eigen are compiled into the module.
  set(folder lib/python3/dist-packages/drawpoint)
  install(TARGETS drawpoint_python LIBRARY DESTINATION ${folder} COMPONENT python EXCLUDE_FROM_ALL)
  install(DIRECTORY python/drawpoint/ DESTINATION ${folder} COMPONENT python EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN "*.py" PATTERN "*.pyi" PATTERN "py.typed" PATTERN "__pycache__" EXCLUDE)
  foreach(package pybind11-dev libeigen3-dev nlohmann-json3-dev)
    install(FILES /usr/share/doc/${package}/copyright RENAME copyright.${package}
            DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/python3-drawpoint COMPONENT python EXCLUDE_FROM_ALL OPTIONAL)
  endforeach()
endif()

# Which of the header-only modules hand Ipopt on to their users, so that the config looks for it there only.
set(drawpoint_ipopt_components)
foreach(component doe kriging pareto)
  get_target_property(libraries drawpoint_${component} INTERFACE_LINK_LIBRARIES)
  if("PkgConfig::IPOPT" IN_LIST libraries)
    list(APPEND drawpoint_ipopt_components ${component})
  endif()
endforeach()
list(JOIN drawpoint_ipopt_components "|" DRAWPOINT_IPOPT_COMPONENTS)
# pkg-config: drawpoint-COMPONENT.pc, for projects that do not use CMake.
# drawpoint_pkg_config(COMPONENT DESCRIPTION REQUIRES module... [CFLAGS flag...] [LIBS flag...]): LIBS is what a compiled library
# needs, whose file lies beside it.
function(drawpoint_pkg_config component description)
  cmake_parse_arguments(arg "" "" "REQUIRES;CFLAGS;LIBS" ${ARGN})
  set(folder ${CMAKE_INSTALL_DATADIR}/pkgconfig)
  set(DRAWPOINT_PC_LIBS ${arg_LIBS})
  get_target_property(type drawpoint_${component} TYPE)
  if(type STREQUAL "STATIC_LIBRARY")
    set(folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
    list(PREPEND DRAWPOINT_PC_LIBS "-L\${prefix}/${CMAKE_INSTALL_LIBDIR}" -ldrawpoint_${component})
  endif()
  cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX BASE_DIRECTORY ${CMAKE_INSTALL_PREFIX}/${folder} OUTPUT_VARIABLE DRAWPOINT_PC_UP)
  string(REGEX REPLACE "/$" "" DRAWPOINT_PC_UP ${DRAWPOINT_PC_UP})
  get_target_property(libraries drawpoint_${component} INTERFACE_LINK_LIBRARIES)
  if("PkgConfig::IPOPT" IN_LIST libraries)
    list(APPEND arg_REQUIRES ipopt)
  endif()
  if("Threads::Threads" IN_LIST libraries)
    list(APPEND DRAWPOINT_PC_LIBS -pthread)
  endif()
  set(DRAWPOINT_PC_DESCRIPTION ${description})
  list(JOIN arg_REQUIRES ", " DRAWPOINT_PC_REQUIRES)
  list(JOIN arg_CFLAGS " " DRAWPOINT_PC_CFLAGS)
  list(JOIN DRAWPOINT_PC_LIBS " " DRAWPOINT_PC_LIBS)
  configure_file(${PROJECT_SOURCE_DIR}/cmake/drawpoint.pc.in ${PROJECT_BINARY_DIR}/drawpoint-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/drawpoint-${component}.pc DESTINATION ${folder} COMPONENT ${component})
endfunction()
set(drawpoint_same "= ${PROJECT_VERSION}")
drawpoint_pkg_config(doe "Designed experiments over any black box (headers, C++20)" REQUIRES "eigen3 >= 3.4")
drawpoint_pkg_config(kriging "Regression Kriging (headers, C++20)" REQUIRES "drawpoint-doe ${drawpoint_same}")
drawpoint_pkg_config(pareto "Multi-objective search (headers, C++20)" REQUIRES "drawpoint-doe ${drawpoint_same}")
# Neither fcl.pc nor simbody.pc is named: they ask for C++11.
if(TARGET drawpoint_record)
  drawpoint_pkg_config(record "Files of numbers, texts and tables in HDF5 (C++20)" REQUIRES hdf5)
endif()
if(DRAWPOINT_BUILD_CONTACT)
  drawpoint_pkg_config(contact "Convex rocks and their contacts (C++20)" REQUIRES "eigen3 >= 3.4" hdf5 "drawpoint-record ${drawpoint_same}"
                       CFLAGS -DEIGEN_MAX_ALIGN_BYTES=16 -DEIGEN_MALLOC_ALREADY_ALIGNED=1 LIBS -lfcl -lccd -lqhull_r -lhwy -pthread)
endif()
if(DRAWPOINT_BUILD_ENGINE)
  drawpoint_pkg_config(engine "Articulated machines among convex rocks (C++20)" REQUIRES "drawpoint-contact ${drawpoint_same}"
                       LIBS -lSimTKsimbody -lSimTKmath -lSimTKcommon)
endif()

configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/DrawpointConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/DrawpointConfig.cmake
                              INSTALL_DESTINATION ${drawpoint_cmake_dir} NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/DrawpointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/DrawpointConfig.cmake ${PROJECT_BINARY_DIR}/DrawpointConfigVersion.cmake
        DESTINATION ${drawpoint_cmake_dir} COMPONENT common)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/drawpoint
        COMPONENT common)

# One Debian package per component: cpack -G DEB in the build directory. Each has its licence in the file
# "copyright", as Debian wants it.
set(CPACK_PACKAGE_VENDOR "Drawpoint contributors")
set(CPACK_PACKAGE_CONTACT "Drawpoint contributors")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_COMPONENTS_ALL common doe kriging pareto everything)
set(CPACK_STRIP_FILES ON)

# drawpoint_deb(COMPONENT SUMMARY DEPENDENCY...): the name, summary and dependencies of the component's package.
function(drawpoint_deb component summary)
  string(TOUPPER ${component} key)
  list(JOIN ARGN ", " depends)
  set(package libdrawpoint-${component}-dev)
  if(component STREQUAL "everything")
    set(package libdrawpoint-dev)
  elseif(component STREQUAL "programs")
    set(package drawpoint)
  elseif(component STREQUAL "python")
    set(package python3-drawpoint)
  endif()
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${package} PARENT_SCOPE)
  install(FILES ${PROJECT_SOURCE_DIR}/cmake/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(CPACK_DEBIAN_${key}_PACKAGE_DEPENDS "${depends}" PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}" PARENT_SCOPE)
endfunction()

set(same_version "(= ${PROJECT_VERSION})")
# Debian's coinor-libipopt-dev links BLAS and LAPACK and does not bring them.
set(toolkit "libdrawpoint-doe-dev ${same_version}" coinor-libipopt-dev libblas-dev liblapack-dev pkg-config)
drawpoint_deb(common "Drawpoint: CMake package files" cmake)
drawpoint_deb(doe "Drawpoint: designed experiments over any black box (headers)" "libdrawpoint-common-dev ${same_version}" "libeigen3-dev (>= 3.4)")
drawpoint_deb(kriging "Drawpoint: regression Kriging (headers)" ${toolkit})
set(CPACK_DEBIAN_KRIGING_PACKAGE_SUGGESTS nlohmann-json3-dev) # for kriging/save*.hpp alone
drawpoint_deb(pareto "Drawpoint: multi-objective search (headers)" ${toolkit})
if(TARGET drawpoint_record)
  list(APPEND CPACK_COMPONENTS_ALL record)
  drawpoint_deb(record "Drawpoint: files of numbers, texts and tables in HDF5 (library and headers)"
                "libdrawpoint-common-dev ${same_version}" "libeigen3-dev (>= 3.4)" libhdf5-dev pkg-config)
endif()
if(DRAWPOINT_BUILD_CONTACT)
  list(APPEND CPACK_COMPONENTS_ALL contact)
  drawpoint_deb(contact "Drawpoint: convex rocks and their contacts (library and headers)"
                "libdrawpoint-record-dev ${same_version}" "libeigen3-dev (>= 3.4)" libfcl-dev libqhull-dev libhwy-dev libhdf5-dev)
endif()
if(DRAWPOINT_BUILD_ENGINE)
  list(APPEND CPACK_COMPONENTS_ALL engine)
  drawpoint_deb(engine "Drawpoint: articulated machines among convex rocks (library and headers)"
                "libdrawpoint-contact-dev ${same_version}" libsimbody-dev)
endif()
if(DRAWPOINT_BUILD_STUDIES)
  list(APPEND CPACK_COMPONENTS_ALL studies)
  drawpoint_deb(studies "Drawpoint: a study as a program (library and headers)" "libdrawpoint-kriging-dev ${same_version}"
                "libdrawpoint-pareto-dev ${same_version}" "libdrawpoint-record-dev ${same_version}" libsqlitecpp-dev libsqlite3-dev
                libcpp-httplib-dev nlohmann-json3-dev)
  list(APPEND CPACK_COMPONENTS_ALL programs)
  # They load the reference BLAS and LAPACK, which others would do for as dependencies.
  drawpoint_deb(programs "Drawpoint: explore machine designs and strategies by simulation (programs)" libblas3 liblapack3)
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "bash-completion, chromium, ffmpeg, python3, slurm-client")
endif()
if(TARGET drawpoint_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
  math(EXPR next_minor "${Python_VERSION_MINOR} + 1")
  drawpoint_deb(python "Drawpoint: designs, Kriging, optimisation and fronts in Python"
                "python3 (>= ${Python_VERSION_MAJOR}.${Python_VERSION_MINOR})" "python3 (<< ${Python_VERSION_MAJOR}.${next_minor})"
                python3-numpy libblas3 liblapack3)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS ON)
endif()
set(modules ${CPACK_COMPONENTS_ALL})
list(REMOVE_ITEM modules common everything programs python)
list(TRANSFORM modules REPLACE "(.+)" "libdrawpoint-\\1-dev ${same_version}")
drawpoint_deb(everything "Drawpoint: everything to build on (brings all libdrawpoint-*-dev)" ${modules})
include(CPack)
