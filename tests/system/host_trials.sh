#!/bin/sh
# Short coupled runs on two and on three hosts whose network loses 5 %, doubles 2 % and reorders 2 % of
# the frames and delays each by up to 20 ms: all must have the channels of a run on one machine.
#
#   host_trials.sh PROGRAM_FOLDER SCENARIO [TRIALS]      20 trials by default; exit 77: not allowed here
set -eu
programs=$1 scenario=$2 trials=${3:-20}
here=$(dirname "$(readlink -f "$0")")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
channels() { grep -v '^#' "$1/channels.csv" | md5sum; }

"$programs/crosswalk" run "$scenario" --until-ms 0.2 --out "$folder/here" >"$folder/log" 2>&1
reference=$(channels "$folder/here")
result=0
for placement in "2 fe=host2,recorder=host2" "3 mb=host2,fe=host3,recorder=host3"; do
  count=${placement% *}
  same=0
  for i in $(seq "$trials"); do
    status=0
    "$here/hosts.sh" "$programs/faulty_hub" "$count" \
      "loss=0.05 duplicate=0.02 reorder=0.02 jitter_ms=20 seed=$i" \
      "$programs/crosswalk" run "$scenario" --until-ms 0.2 --on "${placement#* }" \
      --out "$folder/apart" >"$folder/log" 2>&1 || status=$?
    [ "$status" -ne 77 ] || exit 77
    if [ "$status" -eq 0 ] && [ "$(channels "$folder/apart")" = "$reference" ]; then
      same=$((same + 1))
    else
      result=1
      echo "$count hosts, seed $i: exit $status"
      tail -n 5 "$folder/log"
    fi
    rm -rf "$folder/apart"
  done
  echo "$count hosts: $same of $trials bit-identical"
done
exit "$result"
