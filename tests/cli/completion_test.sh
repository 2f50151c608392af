#!/usr/bin/env bash
# Shell completion as users meet it: completion_test.sh LANELIGHT. Shells that are not
# installed are left out, and that is said.
set -uo pipefail
export LC_ALL=C
lanelight=$(readlink -f "$1") here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
failed=0
fail() { echo "FAILED: $*"; failed=1; }

mkdir -p "$folder/bin" "$folder/here/scenes one"
ln -s "$lanelight" "$folder/bin/lanelight"
PATH=$folder/bin:$PATH
cd "$folder/here"
touch box.pbrt "glass ball.pbrt" notes.txt image.exr grid.toml

# What there is to complete, taken from the help texts.
commands=$(lanelight --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/\1/p')
[[ $(wc -w <<<"$commands") -ge 9 ]] || fail "few commands: $commands"
flags_of() { lanelight "$1" --help | grep -oE '^  (-[a-z],)?--[a-z-]+' | grep -oE -- '--.*'; }

# has TEXT WORD...: the words are lines of the text.
has() {
  local text=$1 word
  shift
  for word; do grep -qxF -- "$word" <<<"$text" || fail "no '$word' in: ${text//$'\n'/ }"; done
}

# lacks TEXT WORD...: they are not.
lacks() {
  local text=$1 word
  shift
  for word; do grep -qxF -- "$word" <<<"$text" && fail "'$word' is in: ${text//$'\n'/ }"; done
}

# What is offered for a last word that is still being typed: SHELL_offers WORD...
bash_offers() {
  bash --norc -c 'source "$1"; shift
    COMP_WORDS=(lanelight "$@") COMP_CWORD=$#
    _lanelight
    printf "%s\n" "${COMPREPLY[@]}"' bash "$folder/script.bash" "$@"
}
fish_offers() {
  local line
  line="lanelight $(printf '%s ' "${@:1:$#-1}")${*: -1}"
  fish --no-config -c 'source $argv[1]; complete -C $argv[2]' "$folder/script.fish" \
    "$line" | cut -f 1
}
# zsh completes for a terminal only: one of zsh's own, in which Ctrl-D lists what there is.
zsh_offers() {
  local line
  line="lanelight $(printf '%s ' "${@:1:$#-1}")${*: -1}"
  zsh -f "$here/completion_list.zsh" "$folder/script.zsh" "$line"
}

for shell in bash zsh fish; do
  if ! command -v $shell >/dev/null; then
    echo "left out: no $shell here"
    continue
  fi
  script=$folder/script.$shell
  lanelight completion $shell >"$script" || fail "no script for $shell"
  $shell -n "$script" || { fail "$shell does not understand its script"; continue; }
  # shellcheck disable=SC2086
  has "$(${shell}_offers '')" $commands
  lacks "$(${shell}_offers 're')" plan
  for command in $commands; do
    # shellcheck disable=SC2046
    has "$(${shell}_offers "$command" --)" $(flags_of "$command")
  done
  lacks "$(${shell}_offers info --)" --spp
  has "$(${shell}_offers render --depth '')" half float
  lacks "$(${shell}_offers render --depth '')" --spp box.pbrt
  has "$(${shell}_offers render --build f)" fast
  lacks "$(${shell}_offers render --build f)" high
  has "$(${shell}_offers completion '')" bash zsh fish
  # shellcheck disable=SC2086
  has "$(${shell}_offers help '')" $commands
  lacks "$(${shell}_offers render --spp '')" --depth box.pbrt
  has "$(${shell}_offers render '')" box.pbrt
  has "$(${shell}_offers render -o i)" image.exr
  echo "looked at $shell"
done

# Files: scenes where scenes are wanted, anything for an image, folders for a folder.
has "$(bash_offers render '')" 'glass ball.pbrt' 'scenes one'
lacks "$(bash_offers render '')" notes.txt
has "$(bash_offers study --out '')" 'scenes one'
has "$(bash_offers sweep '')" grid.toml 'scenes one'
lacks "$(bash_offers sweep '')" box.pbrt
lacks "$(bash_offers study --out '')" box.pbrt
has "$(bash_offers render --depth = h)" half
has "$(bash_offers render --depth =)" half float
has "$(bash_offers render --png --q)" --quiet
has "$(bash_offers render --png im)" image.exr
exit $failed
