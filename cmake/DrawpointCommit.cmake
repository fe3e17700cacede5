# The commit that is built, in one small source, <build>/studies/commit.cpp: another commit compiles that file
# alone. CMake looks again when the reflog of HEAD grows. "unknown" where the source tree is no clone of its own.

set(drawpoint_commit unknown)
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -c safe.directory=* rev-parse --show-prefix --git-path logs/HEAD --short=12 HEAD
    WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} RESULT_VARIABLE result OUTPUT_VARIABLE answer ERROR_QUIET)
  # An empty line first: the tree is at the top of its repository, not a folder of somebody else's.
  if(result EQUAL 0 AND answer MATCHES "^\n([^\n]+)\n([0-9a-f]+)\n$")
    set(drawpoint_commit ${CMAKE_MATCH_2})
    set(reflog ${CMAKE_MATCH_1})
    cmake_path(ABSOLUTE_PATH reflog BASE_DIRECTORY ${PROJECT_SOURCE_DIR})
    if(EXISTS ${reflog})
      set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${reflog})
    endif()
  endif()
endif()
configure_file(${PROJECT_SOURCE_DIR}/cmake/commit.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/commit.cpp @ONLY)
