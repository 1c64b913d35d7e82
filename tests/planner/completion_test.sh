#!/usr/bin/env bash
# Completion as a user meets it: a shell reads its program and is asked. 77, that is skipped, where it is not installed.
#   completion_test.sh PROGRAM bash|zsh|fish
set -uo pipefail
program=$(realpath "$1")
shell=$2
if ! command -v "$shell" > /dev/null; then
  echo "skipped: $shell is not installed"
  exit 77
fi
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
mkdir "runs" "my cases" && touch "lift one.toml" notes.txt "my cases/other.toml"
failures=0
fail() { echo "FAILED: $1"; failures=$((failures + 1)); }

"$program" completion "$shell" > "completion.$shell" || fail "completion $shell"
for verb in $("$program" --help | sed -n '/^Subcommands:/,/^$/p' | awk '/^  [a-z]/ {print $1}'); do
  grep -q "$verb" "completion.$shell" || fail "$shell does not know $verb"
done
if [ "$shell" = zsh ]; then
  zsh -n completion.zsh || fail "zsh cannot read its completion"
  zsh -c 'autoload -U compinit && compinit -u -D && source ./completion.zsh && [[ $_comps[stillhook] = _stillhook ]]' || fail "zsh does not register it"
fi
if [ "$shell" = fish ]; then
  fish -n completion.fish || fail "fish cannot read its completion"
  given=$(fish -c 'source completion.fish; complete -C "stillhook simulate --"' | cut -f 1)
  grep -qxF -- --threads <<< "$given" || fail "fish does not offer --threads"
  fish -c 'source completion.fish; complete -C "stillhook "' | cut -f 1 | grep -qx export || fail "fish does not offer export"
fi
[ "$shell" = bash ] || exit $((failures > 0))

"$program" completion bash > completion.bash || exit 1
# shellcheck disable=SC1091
source ./completion.bash || exit 1
complete -p stillhook > /dev/null || fail "nothing is registered for stillhook"
# What is offered after the words given; the last is the one being typed.
offered() {
  COMP_WORDS=(stillhook "$@")
  COMP_CWORD=$#
  COMPREPLY=()
  _stillhook 2> /dev/null
  printf '%s\n' "${COMPREPLY[@]}"
}
expect() {  # WHAT IS OFFERED, MUST CONTAIN
  [[ $'\n'$1$'\n' == *$'\n'"$2"$'\n'* ]] || fail "'$2' is not among: $(tr '\n' ' ' <<< "$1")"
}
refuse() {
  if [[ $'\n'$1$'\n' == *$'\n'"$2"$'\n'* ]]; then fail "'$2' is offered"; fi
}

# Every verb that --help lists, and every option that the verb's own --help lists.
verbs=$("$program" --help | sed -n '/^Subcommands:/,/^$/p' | awk '/^  [a-z]/ {print $1}')
[ "$(wc -w <<< "$verbs")" -ge 9 ] || fail "verbs: $verbs"
offered_verbs=$(offered "")
for verb in $verbs; do
  expect "$offered_verbs" "$verb"
  options=$("$program" "$verb" --help | grep -oE '^ +(-[a-z],)?--[a-z-]+' | grep -oE '\-\-[a-z-]+')
  [ -n "$options" ] || fail "$verb --help lists no options"
  given=$(offered "$verb" --)
  for option in $options; do expect "$given" "$option"; done
done
expect "$(offered si)" simulate
refuse "$(offered si)" plan
expect "$(offered --v)" --version

# Operands: case files and folders, folders alone, words.
given=$(offered simulate "")
expect "$given" "lift one.toml"
expect "$given" "my cases"
refuse "$given" notes.txt
given=$(offered simulate "lift one.toml" --out "")
expect "$given" runs
refuse "$given" "lift one.toml"
expect "$(offered report "")" runs
refuse "$(offered report "")" notes.txt
expect "$(offered completion "")" fish
expect "$(offered check "lift one.toml" --color "")" never
expect "$(offered check "lift one.toml" --color = al)" always
[ -z "$(offered simulate x --threads "")" ] || fail "a number cannot be completed"

[ "$("$program" completion tcsh > /dev/null 2>&1; echo $?)" = 2 ] || fail "another shell must be refused"
exit $((failures > 0))
