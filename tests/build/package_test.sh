#!/usr/bin/env bash
# Packs what was built, unpacks it elsewhere and uses it from there: package_test.sh BUILD
set -euo pipefail
build=$(readlink -f "$1")
for tool in cpack dpkg-deb dpkg-shlibdeps help2man; do
  command -v $tool >/dev/null || { echo "skipped: no $tool here"; exit 77; }
done
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
fail() { echo "FAILED: $*"; exit 1; }

cpack --config "$build/CPackConfig.cmake" -B "$folder" >"$folder/log" 2>&1 ||
  { cat "$folder/log"; fail "cpack"; }
deb=$(echo "$folder"/lanelight_*.deb)
dpkg-deb --info "$deb" >"$folder/info"
for library in libopenexr libtbb12 libhwy1 libhdf5 libxxhash zlib1g libc6 \
  libstdc++6; do
  grep -q "^ Depends:.*$library" "$folder/info" || fail "does not depend on $library"
done
for line in "Section: graphics" "Maintainer: The Lanelight authors" "Package: lanelight"; do
  grep -q "^ $line" "$folder/info" || fail "no '$line'"
done
dpkg-deb --contents "$deb" | grep -v ' root/root ' && fail "files that are not root's"

root=$folder/root
dpkg-deb -x "$deb" "$root"
for file in share/bash-completion/completions/lanelight share/zsh/vendor-completions/_lanelight \
  share/fish/vendor_completions.d/lanelight.fish share/doc/lanelight/copyright \
  share/doc/lanelight/README.md share/doc/lanelight/docs/study.md; do
  [[ -s $root/usr/$file ]] || fail "no $file"
done
lanelight=$root/usr/bin/lanelight
commands=$("$lanelight" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z]*\) .*/-\1/p')
for command in "" $commands; do
  page=$root/usr/share/man/man1/lanelight$command.1.gz
  [[ -s $page ]] || fail "no man page lanelight$command"
  zcat "$page" | grep -q "^lanelight$command .- " || fail "no name in lanelight$command(1)"
done
zcat "$root/usr/share/man/man1/lanelight-render.1.gz" | grep -q 'max.-depth' ||
  fail "no flags in lanelight-render(1)"

# The Python package finds the program of the same installation.
if /usr/bin/python3 -c 'import numpy' 2>/dev/null; then
  found=$(env -u LANELIGHT PYTHONPATH="$root/usr/lib/python3/dist-packages" /usr/bin/python3 -c \
    'import lanelight; print(lanelight.find_program())')
  [[ $found == "$lanelight" ]] || fail "Python finds '$found'"
fi

# Away from the sources, so that nothing but the package is used.
cd "$folder"
"$lanelight" --version
for scene in cornell-box instances; do
  "$lanelight" render "$root/usr/share/lanelight/scenes/$scene.pbrt" -o $scene.exr \
    --resolution 32x24 --spp 4 --quiet
  [[ -s $scene.exr ]] || fail "no image of $scene"
done
