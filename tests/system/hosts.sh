#!/bin/sh
# Makes COUNT hosts, network namespaces with names and addresses of their own (host1 = 10.0.0.1, ...),
# each joined by a virtual Ethernet pair to a hub, and runs COMMAND on host1.
#
#   hosts.sh HUB_PROGRAM COUNT "FAULTS" COMMAND...      FAULTS as for faulty_hub, e.g. "loss=0.05"
#
# For COMMAND, $CROSSWALK_SSH is `hosts.sh --on FOLDER`, which stands in for ssh. Exit 77 when the
# machine does not allow it.
set -eu
self=$(readlink -f "$0")

if [ "$1" = --on ]; then # FOLDER HOST COMMAND: what sshd does on the other side
  folder=$2 host=$3
  shift 3
  mkdir -p "$folder/$host"
  cd "$folder/$host"
  exec nsenter -t "$(cat "$folder/$host.pid")" -n -u env -u CROSSWALK_LAUNCHER sh -c "$*"
fi

if [ "$1" != --inside ]; then
  [ "$(id -u)" -eq 0 ] && user= || user=-r
  # shellcheck disable=SC2086  # one option or none
  unshare $user -n -u true 2>/dev/null || { echo "no network namespaces here"; exit 77; }
  # shellcheck disable=SC2086
  exec unshare $user -n "$self" --inside "$@"
fi
shift

hub=$1 count=$2 faults=$3
shift 3
folder=$(mktemp -d)
children=
cleanup() {
  # shellcheck disable=SC2086  # a list of numbers
  kill $children 2>/dev/null || true
  rm -rf "$folder"
}
trap cleanup EXIT
trap 'exit 130' INT TERM

here=$(readlink /proc/self/ns/net)
interfaces=
for i in $(seq "$count"); do
  unshare -n -u sh -c "hostname host$i; exec sleep 100000" </dev/null >/dev/null 2>&1 &
  pid=$!
  children="$children $pid"
  echo "$pid" >"$folder/host$i.pid"
  while [ "$(cat "/proc/$pid/comm")" != sleep ] || [ "$(readlink "/proc/$pid/ns/net")" = "$here" ]; do
    sleep 0.01
  done
  ip link add "hub$i" type veth peer name eth0 netns "$pid"
  ip link set "hub$i" up
  nsenter -t "$pid" -n sh -c "ip addr add 10.0.0.$i/24 dev eth0; ip link set eth0 up; ip link set lo up
    ip route add 224.0.0.0/4 dev eth0"
  interfaces="$interfaces hub$i"
done
# shellcheck disable=SC2086
"$hub" $interfaces $faults &
children="$children $!"
export CROSSWALK_SSH="$self --on $folder"
export CROSSWALK_HOSTS="$folder"
status=0
nsenter -t "$(cat "$folder/host1.pid")" -n -u "$@" || status=$?
exit "$status"
