#!/usr/bin/env bash
# What cmake/write_version.cmake finds: no checkout, a clean one, a changed one, a folder
# inside of another checkout. version_test.sh CMAKE SCRIPT
set -euo pipefail
cmake=$1 script=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# expect TEXT FOLDER: the commit found for FOLDER.
expect() {
  "$cmake" -DSOURCE="$2" -DVERSION=1.2.3 -DOUTPUT="$folder/version.cc" -P "$script"
  grep -q '"1.2.3"' "$folder/version.cc" || { echo "no version"; exit 1; }
  local found
  found=$(sed -n 's/.*Commit() { return "\(.*\)"; }/\1/p' "$folder/version.cc")
  [[ $found == "$1" ]] || { echo "expected '$1', found '$found'"; exit 1; }
}

command -v git >/dev/null || { echo "skipped: no git here"; exit 77; }
unset GIT_DIR GIT_WORK_TREE
mkdir -p "$folder/source/inner"
cd "$folder/source"
expect unknown "$PWD"

git init -q .
expect unknown "$PWD"  # a checkout without a commit
echo one >file
git add file
git -c user.name=Test -c user.email=test@example.org commit -q -m first
# A tag must not stand in for the commit.
git tag v9
head=$(git rev-parse --short=10 HEAD)
expect "$head" "$PWD"
touch -d 2001-01-01 "$folder/version.cc"
expect "$head" "$PWD"
[[ $(date -r "$folder/version.cc" +%Y) == 2001 ]] || { echo "written anew"; exit 1; }

echo new >untracked
expect "$head" "$PWD"
echo two >file
expect "$head-dirty" "$PWD"
expect unknown "$PWD/inner"
