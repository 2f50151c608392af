#!/usr/bin/env bash
# What is installed beside the program, made from what it says of itself: completion
# scripts, and man pages where help2man is. write_extras.sh LANELIGHT FOLDER
set -euo pipefail
lanelight=$(readlink -f "$1") folder=$2
rm -rf "$folder"
mkdir -p "$folder"/{bash,zsh,fish}
"$lanelight" completion bash >"$folder/bash/lanelight"
"$lanelight" completion zsh >"$folder/zsh/_lanelight"
"$lanelight" completion fish >"$folder/fish/lanelight.fish"

command -v help2man >/dev/null || exit 0
mkdir -p "$folder"/{man1,programs,notes}
version=$("$lanelight" --version | cut -d ' ' -f 2)
# "render  Render a scene to ..." for every command.
commands=$("$lanelight" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]\)/\1/p')

# page NAME MEANING SEE_ALSO: the man page of programs/NAME.
page() {
  printf '[SEE ALSO]\n%s\n' "$3" >"$folder/notes/$1"
  # Examples stay as they are, line by line.
  help2man --no-info --section 1 --name "$2" --include "$folder/notes/$1" \
    --version-string "$1 (lanelight) $version" "$folder/programs/$1" |
    sed -e 's/^Exit codes: /.SH "EXIT STATUS"\n/' |
    sed -e '/^\.SH EXAMPLES*$/,/^\.SH/{s/^\.IP$/.IP\n.nf/;s/^\.\(SH [^E]\|SH "\|PP\)/.fi\n&/}' \
      >"$folder/man1/$1.1"
  gzip -9nf "$folder/man1/$1.1"
}

ln -s "$lanelight" "$folder/programs/lanelight"
all=
while read -r name meaning; do
  all+="${all:+, }.BR lanelight-$name (1)"
  printf '#!/bin/sh\nexec "%s" %s "$@"\n' "$lanelight" "$name" \
    >"$folder/programs/lanelight-$name"
  chmod +x "$folder/programs/lanelight-$name"
  page "lanelight-$name" "${meaning,}" ".BR lanelight (1)"
done <<<"$commands"
page lanelight "SIMD wavefront path tracer for pbrt-v4 scenes" "${all//, /,$'\n'}"
rm -r "$folder"/{programs,notes}
