# The target docs_api: the API reference of the public headers, <build>/docs/html/index.html, where Doxygen is
# found. A warning is an error. That each name has a comment is not asked for: a comment says what the name does
# not.

find_package(Doxygen QUIET)
if(NOT DOXYGEN_FOUND)
  return()
endif()
set(DOXYGEN_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/docs)
set(DOXYGEN_FILE_PATTERNS *.hpp)
set(DOXYGEN_EXCLUDE_PATTERNS */detail/* */node_modules/*)
set(DOXYGEN_EXCLUDE_SYMBOLS *detail*)
set(DOXYGEN_EXTRACT_ALL YES)
set(DOXYGEN_JAVADOC_AUTOBRIEF YES) # a first sentence is the summary
set(DOXYGEN_BUILTIN_STL_SUPPORT YES)
set(DOXYGEN_HAVE_DOT NO)
set(DOXYGEN_USE_MDFILE_AS_MAINPAGE docs/reference/api.md)
# Programs that the tests compile: docs/reference/api.dox shows pieces of them beside the headers.
set(DOXYGEN_EXAMPLE_PATH docs/cookbook tests/consumer tests/consumer/engine tests/consumer/studies studies)
set(DOXYGEN_GENERATE_TREEVIEW YES)
set(DOXYGEN_DISABLE_INDEX NO)
set(DOXYGEN_TREEVIEW_WIDTH 290)
set(DOXYGEN_HTML_EXTRA_STYLESHEET cmake/reference.css)
set(DOXYGEN_HTML_DYNAMIC_SECTIONS YES)
set(DOXYGEN_TOC_INCLUDE_HEADINGS 3)
set(DOXYGEN_PROJECT_BRIEF "Machine designs and ways of working, explored by simulation")
set(DOXYGEN_SHOW_INCLUDE_FILES NO)
set(DOXYGEN_QUIET YES)
set(DOXYGEN_WARN_AS_ERROR FAIL_ON_WARNINGS)
set(DOXYGEN_INPUT_FILTER "sed -f ${PROJECT_SOURCE_DIR}/cmake/doxygen.sed")
doxygen_add_docs(docs_api doe kriging pareto engine studies docs/reference/api.md docs/reference/api.dox
                 WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "Writing the API reference")
