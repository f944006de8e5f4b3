#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-2.0-or-later
# A real Slurm controller and node daemon on the loopback, all in a directory of their own. The history of a run must be
# that of a run with local workers: with workers that srun has launched; with the tasks of a job array as workers, whose
# node goes down in the middle and comes back.
#
#   tests/faults/slurm.sh POLARGRAIN CASE [--set ...]
#
# Ends with status 77 (skipped) where Slurm and munge are not installed or this user may not start them.
set -euo pipefail
polargrain=$(realpath "$1")
case_file=$(realpath "$2")
ports=$(realpath "$(dirname "$0")/../support/free_ports.py")
shift 2
settings=("$@")
skip() { echo "skipped: $*"; exit 77; }
for program in munged slurmctld slurmd srun; do
  command -v "$program" >/dev/null || PATH="$PATH:/usr/sbin"
  command -v "$program" >/dev/null || skip "there is no $program (Debian packages slurm-wlm and munge)"
done
((EUID == 0)) || skip "only root may start a node daemon that launches tasks"

base=$(mktemp -d /tmp/polargrain-slurm-XXXXXX)
declare -a daemons=()
finish() {
  local status=$?
  for ((k = ${#daemons[@]} - 1; k >= 0; --k)); do kill "${daemons[k]}" 2>/dev/null || true; done
  wait 2>/dev/null || true
  ((status == 0 || status == 77)) || tail -n 20 "$base"/*.log >&2 || true
  rm -rf "$base"
}
trap finish EXIT
cd "$base"
mkdir state spool munge
chmod 755 "$base" && chmod 711 munge
dd if=/dev/urandom of=munge.key bs=128 count=1 status=none
chmod 400 munge.key
port=$("$ports" 3)
cat >slurm.conf <<EOF
ClusterName=polargrain
SlurmctldHost=$(hostname)(127.0.0.1)
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket=$base/munge/socket
CredType=cred/munge
SlurmctldPort=$port
SlurmdPort=$((port + 1))
StateSaveLocation=$base/state
SlurmdSpoolDir=$base/spool
SlurmctldPidFile=$base/slurmctld.pid
SlurmdPidFile=$base/slurmd.pid
SlurmctldLogFile=$base/slurmctld.log
SlurmdLogFile=$base/slurmd.log
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
MpiDefault=none
ReturnToService=0
NodeName=$(hostname) NodeAddr=127.0.0.1 CPUs=$(nproc) State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
EOF
export SLURM_CONF=$base/slurm.conf

munged --foreground --force --socket="$base/munge/socket" --key-file="$base/munge.key" --pid-file="$base/munge.pid" \
  --log-file="$base/munged.log" --seed-file="$base/munge.seed" >munged.out.log 2>&1 &
daemons+=($!)
slurmctld -D >slurmctld.out.log 2>&1 &
daemons+=($!)
slurmd -D >slurmd.out.log 2>&1 &
daemons+=($!)
patience=400  # s: no verdict hangs on it, it ends a test that has failed
await() {  # COMMAND...: until it succeeds
  local end=$((SECONDS + patience))
  until "$@"; do ((SECONDS < end)) || { echo "waited too long for: $*"; return 1; }; sleep 0.2; done
}
node_is() { [[ $(sinfo --noheader -o %T 2>/dev/null) == "$1" ]]; }
await node_is idle

"$polargrain" keys keys >/dev/null
"$polargrain" run "$case_file" "${settings[@]}" -o local -w 2 --quiet
url=tcp://127.0.0.1:$((port + 2))
"$polargrain" run "$case_file" "${settings[@]}" -o cluster -w 0 --listen "$url" --keys keys --quiet &
run=$!
srun --ntasks=2 --overcommit "$polargrain" worker --connect "$url" --key keys/worker.key >srun.log 2>&1 &
workers=$!
wait $run
wait $workers || { echo "the workers of srun ended badly"; exit 1; }
cmp local/history.csv cluster/history.csv
grep -c "" cluster/history.csv | xargs echo "the same history with workers of srun; lines:"

node=$(hostname)
tasks_are() { [[ $(squeue --noheader --array --format=%T | sort -u) == "$1" ]]; }
no_task_is_left() { [[ -z $(squeue --noheader) ]]; }
row_of_the_start() { grep -qs ^0, array/history.csv || ! kill -0 $run 2>/dev/null; }
is_stopped() { ! [[ $(ps -o stat= -p $run) =~ ^[^TZ] ]]; }

# A run with the tasks of a job array as workers, held behind its start: what happens to the node happens in the middle of it. A busy
# machine may see to its end before: then once more.
for ((attempt = 1; ; ++attempt)); do
  rm -rf array
  "$polargrain" run "$case_file" "${settings[@]}" -o array -w 0 --listen "$url" --keys keys --quiet &
  run=$!
  daemons+=($run)
  sbatch --quiet --requeue --array=1-2 --ntasks=1 --output=array-%a.log \
    --wrap "exec '$polargrain' worker --connect $url --key keys/worker.key"
  await row_of_the_start || { cat array/run.log array-*.log; exit 1; }
  kill -STOP $run 2>/dev/null || true
  await is_stopped
  [[ -e array/summary.json ]] || break
  kill -CONT $run 2>/dev/null || true
  wait $run || { tail array/run.log; exit 1; }
  await no_task_is_left
  ((attempt < 5)) || { echo "the run was always over before the node could fail"; exit 1; }
done
# The node fails: what ran on it is gone, and nobody there can tell Slurm how. First those who would (a task that is told to have
# failed is not put back into the queue), which start the tasks; then the tasks.
mapfile -t tasks < <(scontrol listpids | awk 'NR > 1 && $1 > 0 {print $1}')
((${#tasks[@]})) || { echo "no task runs on the node"; exit 1; }
for parent in $(ps -o ppid= -p "${tasks[*]}" | sort -u); do
  if [[ $(ps -o comm= -p "$parent") == slurmstepd ]]; then kill -KILL "$parent"; fi
done
kill -KILL "${tasks[@]}" 2>/dev/null || true
scontrol update NodeName="$node" State=DOWN Reason="a test"
await tasks_are PENDING || { squeue; exit 1; }
kill -CONT $run
await grep -q "guest 1 .*its connection is closed" array/run.log || { echo "nobody noticed the failure"; exit 1; }
kill -0 $run || { echo "the run did not outlive its workers"; exit 1; }
scontrol update NodeName="$node" State=RESUME
# At once, not after the minutes that Slurm waits with a task it has put back.
# One may have begun by itself between the two commands, and may even be done with the run: then there is nothing to hasten.
for job in $(squeue --noheader --format=%A | sort -u); do
  scontrol update JobId="$job" StartTime=now 2>hastened.log || grep -Eq "already finished|no longer pending" hastened.log ||
    { cat hastened.log; exit 1; }
done
wait $run || { tail array/run.log; exit 1; }
await no_task_is_left
cmp local/history.csv array/history.csv
echo "the same history with a job array whose node went down"
