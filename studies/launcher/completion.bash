# SPDX-FileCopyrightText: Drawpoint contributors
# SPDX-License-Identifier: Apache-2.0
#
# What can be typed after `drawpoint`: the programs themselves say it. Where they say nothing, bash completes
# names of files.

_drawpoint() {
  mapfile -t COMPREPLY < <("${COMP_WORDS[0]}" complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null)
}
complete -o bashdefault -o default -F _drawpoint drawpoint
