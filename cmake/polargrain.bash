# SPDX-License-Identifier: GPL-2.0-or-later
# Completion of polargrain for bash: commands and options are those that the installed program tells, so that this file
# knows none of them.
_polargrain() {
  local word=${COMP_WORDS[COMP_CWORD]} command=${COMP_WORDS[1]:-}
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    local commands
    commands=$("${COMP_WORDS[0]}" --help 2>/dev/null | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\{1,\}\) .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$commands --help --version" -- "$word")
  elif [[ $word == -* ]]; then
    local options
    options=$("${COMP_WORDS[0]}" "$command" --help 2>/dev/null | grep -oE -- '^ +(-[a-z],)?--[a-z-]+' | grep -oE -- '--[a-z-]+')
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
  elif ((COMP_CWORD == 2)) && [[ $command == examples ]]; then
    local names
    names=$("${COMP_WORDS[0]}" examples 2>/dev/null | sed -n 's/^  \([a-z_]\{1,\}\) .*/\1/p')
    mapfile -t COMPREPLY < <(compgen -W "$names" -- "$word")
  fi
}
# Where nothing is proposed: names of files.
complete -o default -F _polargrain polargrain
