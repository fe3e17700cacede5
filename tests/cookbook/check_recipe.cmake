cmake_minimum_required(VERSION 3.25)
# Runs a program of the cookbook as the page says and expects that the page links the program and shows what it prints and its figure.
# -DRECIPE= -DPROGRAM= -DSOURCES= -DPAGE= -DFOLDER=
file(READ ${PAGE} page)

function(expect_on_page what text)
  string(FIND "${page}" "${text}" place)
  if(place EQUAL -1)
    message(SEND_ERROR "docs/how-to/cookbook.md, ${RECIPE}: ${what} is not on the page; put it there:\n${text}")
  endif()
endfunction()

expect_on_page("a link to the program" "](../cookbook/${RECIPE}.cpp)\n")
set(csv ${FOLDER}/${RECIPE}.csv)
file(REMOVE ${csv})
set(command ${PROGRAM} ${csv})
if(EXISTS ${SOURCES}/${RECIPE}.py)
  expect_on_page("a link to the script" "](../cookbook/${RECIPE}.py)\n")
  set(command /usr/bin/python3 ${SOURCES}/${RECIPE}.py ${command}) # Debian's, which has numpy
endif()

execute_process(COMMAND ${command} RESULT_VARIABLE code OUTPUT_VARIABLE printed ERROR_VARIABLE errors)
if(NOT code EQUAL 0 OR NOT errors STREQUAL "")
  message(FATAL_ERROR "${RECIPE} ended with ${code}:\n${printed}${errors}")
endif()
expect_on_page("what it prints" "```text\n${printed}```\n")

file(STRINGS ${csv} lines)
list(LENGTH lines count)
if(count LESS 10)
  message(SEND_ERROR "${csv} has ${count} lines; nothing to draw")
endif()
expect_on_page("the figure" "](../images/cookbook/${RECIPE}.svg)\n")
get_filename_component(figure ${SOURCES}/../images/cookbook/${RECIPE}.svg ABSOLUTE)
file(SIZE ${figure} size)
if(size GREATER 40000)
  message(SEND_ERROR "${figure} has ${size} bytes; a page loads ten of them, so at most 40000 each")
endif()
