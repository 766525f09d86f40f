#!/bin/sh
# Makes COUNT hosts, network namespaces with names and addresses of their own (host1 = 10.0.0.1, ...),
# each joined by a virtual Ethernet pair to a hub, and runs COMMAND on host1.
#
#   hosts.sh [--sshd] HUB_PROGRAM COUNT "FAULTS" COMMAND...      FAULTS as for faulty_hub, e.g. "loss=0.05"
#
# For COMMAND, $CROSSWALK_SSH is `hosts.sh --on FOLDER`, which stands in for ssh; with --sshd it is ssh
# itself and every host has a server (root only). Exit 77 when the machine does not allow it.
set -eu
self=$(readlink -f "$0")

if [ "$1" = --on ]; then # FOLDER HOST COMMAND: what sshd does on the other side
  folder=$2 host=$3
  shift 3
  mkdir -p "$folder/$host"
  cd "$folder/$host"
  exec nsenter -t "$(cat "$folder/$host.pid")" -n -u env -u CROSSWALK_LAUNCHER sh -c "$*"
fi

if [ "$1" = --sshd ]; then
  shift
  if [ "$(id -u)" -ne 0 ] || [ ! -x /usr/sbin/sshd ]; then
    echo "no sshd here, or not root"
    exit 77
  fi
  export HOSTS_WITH_SSHD=1
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

# A server on host $1 with a key of its own, whose login folder is FOLDER/HOST as above.
serve() {
  address=10.0.0.$1
  [ -e "$folder/key" ] || ssh-keygen -q -t ed25519 -N "" -f "$folder/key"
  mkdir -p /run/sshd "$folder/host$1"
  cat >"$folder/host$1.sshd" <<END
ListenAddress $address
HostKey $folder/key
AuthorizedKeysFile $folder/key.pub
StrictModes no
UsePAM no
PidFile none
ForceCommand cd $folder/host$1 && exec sh -c "\$SSH_ORIGINAL_COMMAND"
END
  cat >>"$folder/ssh_config" <<END
Host host$1
  HostName $address
  User root
  IdentityFile $folder/key
  StrictHostKeyChecking no
  UserKnownHostsFile /dev/null
  LogLevel ERROR
END
  nsenter -t "$(cat "$folder/host$1.pid")" -n -u /usr/sbin/sshd -D -f "$folder/host$1.sshd" &
  children="$children $!"
}

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
  [ -z "${HOSTS_WITH_SSHD:-}" ] || serve "$i"
done
# shellcheck disable=SC2086
"$hub" $interfaces $faults &
children="$children $!"
export CROSSWALK_SSH="$self --on $folder"
[ -z "${HOSTS_WITH_SSHD:-}" ] || CROSSWALK_SSH="ssh -T -o BatchMode=yes -F $folder/ssh_config"
export CROSSWALK_HOSTS="$folder"
status=0
nsenter -t "$(cat "$folder/host1.pid")" -n -u "$@" || status=$?
exit "$status"
