# For Doxygen: the lines that open a header, behind "#pragma once" and perhaps an empty line, are about
# the file.
/^#pragma once$/ {
  s|.*|/// \\file|
  n
  s|^$|///|
}
