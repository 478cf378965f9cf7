#!/bin/bash
# SPDX-License-Identifier: MIT
# What #debug says in the scenes of tests/golden/eval/core_*.scn must be the same from povray and from
# the expected files, which eval_golden compares with ours. povray breaks lines at 80 columns, so blanks
# and line breaks do not count.
# Usage: language_compare.sh    Exit status 77 (skipped) where povray is not installed.
command -v povray >/dev/null || { echo "povray is not installed: skipped"; exit 77; }
folder=$(cd "$(dirname "$0")/../golden/eval" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cp "$folder"/core_* "$work" && cd "$work" || exit 1
status=0
for scene in core_*.scn; do
  rm -f said.txt
  povray "+I$scene" -D -F +W4 +H4 +GDsaid.txt -GR -GS >log.txt 2>&1
  if [ "$(tr -d ' \n' <said.txt)" = "$(tr -d ' \n' <"${scene%.scn}.out.expected")" ]; then
    echo "same: $scene"
  else
    echo "DIFFERENT: $scene"
    diff <(tr -s ' \n' '\n\n' <said.txt) <(tr -s ' \n' '\n\n' <"${scene%.scn}.out.expected")
    grep "Parse Error" log.txt
    status=1
  fi
done
exit $status
