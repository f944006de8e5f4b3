#!/bin/bash
# SPDX-License-Identifier: GPL-2.0-or-later
# Faults of machines and networks, made on one machine: three hosts are network namespaces joined by a bridge. Each run
# comes to the bytes of the undisturbed one, or ends in words and goes on to them.
#   bed.sh PROGRAM STRANGE_WORKER RENAME_KILLER CLOCK_STEPS [reduced]      status 77: nothing of it is allowed here
set -u
program=$(realpath "$1") stranger=$(realpath "$2") killer=$(realpath "$3") clock=$(realpath "$4") reduced=${5:-}
ports=$(realpath "$(dirname "$0")/../support/free_ports.py")
work=$(mktemp -d)
space=pg$$
failures=0 skipped=0 begun=$SECONDS
declare -a beside=()

clean() {
  for process in "${beside[@]}"; do kill -9 "$process" 2>/dev/null; done
  for host in a b c; do ip netns del "$space$host" 2>/dev/null; done
  ip link del "$space" 2>/dev/null
  umount "$work/full" 2>/dev/null
  rm -rf "$work"
}
trap clean EXIT
cd "$work" || exit 1

cat > case.yaml <<'CASE'
title: Compression of a fake
mesh: {rectangle: {size: [0.4 m, 0.8 m], elements: [2, 4]}}
materials:
  sand: {model: cell, script: fake.in, packing: grains.csv, G: 40 MPa, Gc: 10 MPa, lc: 20 mm}
regions: {all: sand}
boundary:
  - {on: bottom, fix: [u2]}
  - {on: bottom_left, fix: [u1, w]}
  - {on: top, move: {u2: -8 mm}}
  - {on: [left, right], pressure: 100 kPa}
steps: {count: 12, tolerance: 1e-10}
monitors: {top_force: {on: top, reaction: u2}}
CASE
printf '# cell xx=0.1 xy=0 yx=0 yy=0.1 z=0.1\nid,x,y,r,mass,Izz\n1,0.05,0.05,0.04,1.0,8e-4\n' > grains.csv
echo "state_bytes 20000" > fake.in
"$program" run case.yaml --quiet -w 2 -o quiet || exit 1
printf 'state_bytes 20000\nsleep_milliseconds 4\n' > fake.in
"$program" keys keys > /dev/null || exit 1
"$program" keys keys --worker other > /dev/null || exit 1

same() {  # NAME: the history of this run is that of the quiet one
  if cmp -s quiet/history.csv "$1/history.csv"; then echo "ok       $1 ($((SECONDS - begun)) s)"; begun=$SECONDS; return; fi
  echo "FAILED   $1: another history, or none"
  tail -5 "$1/run.log" "$1.err" 2>/dev/null
  failures=$((failures + 1))
}
expect() {  # NAME FILE WORDS
  grep -q -- "$3" "$2" && return
  echo "FAILED   $1: '$3' is not in $2"; tail -5 "$2"
  failures=$((failures + 1))
}
skip() { echo "skipped  $1: $2"; skipped=$((skipped + 1)); }
start() { "$@" & beside+=($!); }
run() {  # NAME ARGUMENTS... in the background with the options $more and limits of $patience; $coordinator is its process
  local name=$1; shift
  "$@" run case.yaml --quiet -o "$name" $more ${patience:+--set "workers={$patience}"} 2> "$name.err" &
  coordinator=$!
}
await() {  # NAME WORDS: until they are in the log of this run, or it has ended
  until grep -qs -- "$2" "$1/run.log"; do kill -0 $coordinator 2>/dev/null || return; sleep 0.05; done
}
guest() { start "$@" worker --connect "$url" --key "keys/${key:-worker}.key" --patience 30 > "guest$RANDOM.log" 2>&1; }

# ---- hosts and lines
make_hosts() {
  ip link add "$space" type bridge 2>/dev/null && ip link set "$space" up || return 1
  for host in a b c; do
    ip netns add "$space$host" && ip link add "$space$host" type veth peer name eth netns "$space$host" &&
      ip link set "$space$host" master "$space" up || return 1
    ip -n "$space$host" link set lo up
    ip -n "$space$host" link set eth up
  done
  ip -n "${space}a" addr add 10.77.0.1/24 dev eth
  ip -n "${space}b" addr add 10.77.0.2/24 dev eth
  ip -n "${space}c" addr add 10.77.0.3/24 dev eth
}
on() { local host=$1; shift; ip netns exec "$space$host" "$@"; }
url=tcp://10.77.0.1:5570
if make_hosts; then
  # A host whose line is cut in the middle and comes back; the other one goes on.
  patience="silence: 5 s" more="-w 0 --listen $url --keys keys" run partition on a "$program"
  guest on b "$program"; guest on c "$program"
  await partition "step 3"
  ip link set "${space}b" down; sleep 7; ip link set "${space}b" up
  wait $coordinator; same partition
  if [ -z "$reduced" ]; then
    # Half-open: the host is gone without a word, its connection stays; nobody else until it is noticed.
    patience="silence: 5 s" more="-w 0 --listen $url --keys keys" run half-open on a "$program"
    guest on b "$program"
    await half-open "step 3"
    ip link set "${space}b" down
    sleep 1; guest on c "$program"
    wait $coordinator; same half-open
    ip link set "${space}b" up
  fi
else
  skip hosts "network namespaces are not allowed"
fi

# ---- slow and bad lines: a relay that holds bytes back, as kernels without netem cannot
cat > relay.py <<'RELAY'
import asyncio, random, sys
port, to, delay, loss, rate = int(sys.argv[1]), int(sys.argv[2]), *map(float, sys.argv[3:6])
chance = random.Random(20261122)
async def pass_on(reader, writer):
    while data := await reader.read(65536):
        # TCP's treatment of a lost packet: it comes later, and all behind it.
        await asyncio.sleep(delay + (0.2 if chance.random() < loss else 0.0) + (len(data) / rate if rate else 0.0))
        writer.write(data)
        await writer.drain()
    writer.close()
async def serve(reader, writer):
    there, back = await asyncio.open_connection("127.0.0.1", to)
    await asyncio.gather(pass_on(reader, back), pass_on(there, writer), return_exceptions=True)
async def main():
    await (await asyncio.start_server(serve, "127.0.0.1", port)).serve_forever()
asyncio.run(main())
RELAY
line() {  # NAME DELAY LOSS RATE (s, share, bytes/s): two guests alone, on a line like that
  local port
  port=$("$ports" 2)
  start python3 relay.py $((port + 1)) "$port" "$2" "$3" "$4"
  local relay=$!
  more="-w 0 --listen tcp://127.0.0.1:$port --keys keys" run "$1" "$program"
  url=tcp://127.0.0.1:$((port + 1))
  guest "$program"; guest "$program"
  wait $coordinator; same "$1"
  kill $relay
}
line delay 0.003 0 0
if [ -z "$reduced" ]; then
  line loss 0 0.02 0
  line rate 0 0 2e6
fi

# ---- keys and guests, on this machine
url=tcp://127.0.0.1:$("$ports")
more="-w 1 --listen $url --keys keys" run revoked "$program"
guest "$program"; key=other guest "$program"
await revoked "step 3"
cp keys/workers.allowed all.allowed
public=$(awk '/^public/ {print $2}' keys/other.key)
grep -vF -e "$public" all.allowed > keys/workers.allowed   # from the next run on
wait $coordinator; same revoked
more="-w 0 --listen $url --keys keys" run revoked-next "$program"
key=other guest "$program"
await revoked-next "not in workers.allowed"  # it waits for somebody who may come in
guest "$program"
wait $coordinator; same revoked-next
cp all.allowed keys/workers.allowed

if [ -z "$reduced" ]; then
  patience="cell_time: 2 s" more="-w 0 --listen $url --keys keys" run endless-working "$program"
  start "$stranger" works --key keys/worker.key --connect "$url" > stranger.log 2>&1
  await endless-working "takes longer than"
  guest "$program"
  wait $coordinator; same endless-working
fi

ulimit -n "$(ulimit -Hn)"
connections=$(($(ulimit -n) > 10500 ? 10000 : $(ulimit -n) - 500))
more="-w 2 --listen $url --keys keys" run connections "$program"
start python3 -c "
import socket, sys, time
held = []
for _ in range($connections):
    for attempt in range(100):
        try:
            held.append(socket.create_connection(('127.0.0.1', ${url##*:}), 5)); break
        except OSError:
            time.sleep(0.02)
print(len(held), flush=True)
time.sleep(60)" > connections.txt
wait $coordinator; same connections
[ "$connections" = 10000 ] || skip "10,000 connections" "$connections only: the limit of open files"

# ---- the machine
# Its clock set an hour back and forth: what is told is odd, what is waited for and computed is not.
more="-w 2" run clock env LD_PRELOAD="$clock" "$program"
wait $coordinator; same clock
hours=$(cut -c2-14 clock/run.log | grep '^2' | sort -u | wc -l)
[ "$hours" -ge 2 ] || { echo "FAILED   clock: it never stepped"; failures=$((failures + 1)); }
expect clock clock/summary.json '"total": [0-9]'

if mkdir full && mount -t tmpfs -o size=64k none full 2>/dev/null; then
  head -c 1M /dev/zero > full/fill 2>/dev/null
  more="-w 1" run full-tmpdir env TMPDIR="$work/full" "$program"
  if wait $coordinator; then same full-tmpdir; else
    expect full-tmpdir full-tmpdir.err "TMPDIR"
    echo "ok       full-tmpdir: refused in words"
  fi
else
  skip full-tmpdir "not allowed to mount"
fi

more="-w 3" run out-of-memory "$program"
await out-of-memory "step 3"
for worker in $(pgrep -P $coordinator | head -2); do prlimit --pid "$worker" --as=1000000; done
wait $coordinator; same out-of-memory

# Workers killed while the states of a step are on their way: 2 MB a cell.
if [ -z "$reduced" ]; then
  printf 'state_bytes 2000000\n' > fake.in
  "$program" run case.yaml --quiet -w 2 -o quiet-large || exit 1
  more="-w 3" run upload "$program"
  for step in $(seq 2 2 12); do
    await upload "step $step\$"
    for worker in $(pgrep -P $coordinator); do kill -9 "$worker" 2> /dev/null; sleep 0.05; done
  done
  wait $coordinator
  cmp -s quiet-large/history.csv quiet/history.csv && same upload
fi

# The coordinator killed at each of the renames that put a checkpoint in place, before and behind it.
printf 'state_bytes 20000\n' > fake.in
[ -z "$reduced" ] && places="1 2 3 4 7 10" || places="2 3"
for behind in "" 1; do
  for place in $places; do
    name=rename-$place$behind
    more="--checkpoint-minutes 0 -w 1"
    run "$name" env LD_PRELOAD="$killer" KILL_AT_RENAME="$place" ${behind:+KILL_AFTER_RENAME=1} "$program"
    wait $coordinator 2> /dev/null
    more="--resume -w 1"
    [ -e "$name/checkpoint.h5" ] || more="-w 1"
    run "$name" "$program"; wait $coordinator
    same "$name"
  done
done

echo "$failures failed, $skipped skipped"
[ $failures = 0 ]
