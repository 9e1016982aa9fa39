#!/bin/bash
# How many of a model's sentences pass, by reason: some tasks, the first variation of each, one sentence a request.
#   tests/bench/paraphrase.sh URL MODEL [COUNT]     with `stampede` on the PATH
set -euo pipefail
url=$1 model=$2 count=${3:-4}
tasks=(push_button close_box put_rubbish_in_bin open_drawer lamp_on take_lid_off_saucepan put_knife_in_knife_block pick_up_cup
  stack_wine open_window close_fridge reach_target put_tray_in_oven phone_on_base toilet_seat_up turn_tap stack_blocks
  put_item_in_drawer meat_on_grill take_money_out_safe)
out=$(mktemp -d)
for task in "${tasks[@]}"; do
  first=$(stampede list "$task" --json | sed -n 's/.*"variation": "\([^"]*\)".*/\1/p' | head -1)
  stampede paraphrase "$task" --variation "$first" --count "$count" --each 1 --url "$url" --model "$model" \
    --out "$out/$task.sentences.json" --show-refused >>"$out/answers" 2>>"$out/story" || true
done
grep -hE '^ +[0-9]+ [a-z_]+$' "$out/answers" | awk '{ n[$2] += $1 } END { for (reason in n) print n[reason], reason }' | sort -rn
awk '/ passed/ { received += $4; passed += $6 } END { print received " received, " passed " passed" }' "$out/answers"
echo "all of it: $out" >&2
