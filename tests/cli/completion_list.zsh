# What zsh offers for a line whose last word is being typed, one a line:
#   zsh -f completion_list.zsh COMPLETION_SCRIPT LINE
# Completion works in a terminal only, so a zsh with a pseudo-terminal of its own is asked;
# what it hands to compadd is written to a file.
zmodload zsh/zpty
export offered=$(mktemp) script=$1
setup=$(mktemp)
cat >$setup <<'END'
PROMPT=
autoload -U compinit
compinit -u -D
source $script
bindkey '^I' complete-word
zstyle ':completion:*' insert-tab false
compadd() {
  # These only ask which of some words match.
  if [[ ${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then
    builtin compadd "$@"
    return
  fi
  local -a hits
  builtin compadd -A hits "$@"
  (( $#hits )) && print -rl -- $hits >>$offered
  builtin compadd "$@"
}
finish() { exit }
comppostfuncs=(finish)
print ready
END
zpty shell zsh -f -i
zpty -w shell "source $setup"
while zpty -r shell line; do [[ $line == ready* ]] && break; done
zpty -w -n shell "$2"$'\t'
# It leaves when it has completed.
while zpty -t shell 2>/dev/null; do zpty -r shell line || break; done
zpty -d shell
cat $offered
rm -f $offered $setup
