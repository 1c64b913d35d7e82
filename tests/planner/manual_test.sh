#!/usr/bin/env bash
# The manual page renders without a warning and knows every verb and option.
#   manual_test.sh PROGRAM
set -uo pipefail
program=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
command -v man > /dev/null || { echo "skipped: man is not installed; setup installs man-db"; exit 77; }
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

"$program" man > stillhook.1 || exit 1
LC_ALL=C.UTF-8 MANWIDTH=100 man --warnings -E UTF-8 -l stillhook.1 > page.txt 2> warnings.txt || fail "man ends with $?"
[ -s warnings.txt ] && fail "warnings: $(cat warnings.txt)"
page=$(sed 's/.\x08//g' page.txt)
for title in NAME SYNOPSIS DESCRIPTION COMMANDS "EXIT STATUS" ENVIRONMENT FILES EXAMPLES; do
  grep -q "^$title" <<< "$page" || fail "no section $title"
done
for verb in $("$program" --help | sed -n '/^Subcommands:/,/^$/p' | awk '/^  [a-z]/ {print $1}'); do
  [[ $page == *"stillhook $verb"* ]] || fail "no verb $verb"
  for option in $("$program" "$verb" --help | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE '\-\-[a-z-]+' | grep -v -- --help); do
    [[ $page == *"$option"* ]] || fail "no option $option of $verb"
  done
done
exit $((failures > 0))
