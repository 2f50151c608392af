# shellcheck shell=bash disable=SC2034,SC2154
# A cluster of this machine: munged, slurmctld and slurmd on the loopback, with everything
# they write in $folder/slurm. Sourced; start_slurm, stop_slurm.
cluster=$folder/slurm
export SLURM_CONF=$cluster/slurm.conf

# Prints a free port.
free_port() {
  python3 -c 'import socket; s = socket.socket(); s.bind(("", 0)); print(s.getsockname()[1])'
}

write_slurm_conf() {
  cat >"$SLURM_CONF" <<CONF
ClusterName=lanelight
SlurmctldHost=$(hostname -s)(127.0.0.1)
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
SlurmctldPort=$(free_port)
SlurmdPort=$(free_port)
# Credentials of few seconds: a requeued job waits for their end (usually two minutes).
AuthInfo=socket=$cluster/munge.socket,cred_expire=5
StateSaveLocation=$cluster/state
SlurmdSpoolDir=$cluster/spool
SlurmctldPidFile=$cluster/slurmctld.pid
SlurmdPidFile=$cluster/slurmd.pid
SlurmctldLogFile=$cluster/slurmctld.log
SlurmdLogFile=$cluster/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SwitchType=switch/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
SchedulerParameters=sched_interval=2,bf_interval=2,batch_sched_delay=0
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
JobCompType=jobcomp/filetxt
JobCompLoc=$cluster/jobs.log
KillWait=30
MinJobAge=600
ReturnToService=2
NodeName=$(hostname -s) NodeAddr=127.0.0.1 CPUs=2 CoresPerSocket=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
CONF
}

start_slurm() {
  mkdir -p "$cluster/state" "$cluster/spool"
  chmod 755 "$folder" "$cluster"
  head -c 1024 /dev/urandom >"$cluster/munge.key"
  chmod 600 "$cluster/munge.key"
  write_slurm_conf
  munged --force --key-file="$cluster/munge.key" --socket="$cluster/munge.socket" \
    --pid-file="$cluster/munged.pid" --log-file="$cluster/munged.log" \
    --seed-file="$cluster/munge.seed" 2>/dev/null || return 1
  slurmctld -c >/dev/null 2>&1 || return 1
  slurmd -c >/dev/null 2>&1 || return 1
  wait_for 60 is_idle
}

is_idle() { [[ $(sinfo -h -o %t 2>/dev/null) == idle ]]; }

# Only processes that start_slurm has started, each by its own file.
stop_slurm() {
  local name pid
  scancel --user "$(id -un)" 2>/dev/null
  wait_for 20 is_idle
  for name in slurmd slurmctld munged; do
    pid=$(cat "$cluster/$name.pid" 2>/dev/null) || continue
    kill "$pid" 2>/dev/null
    wait_for 20 eval "! kill -0 $pid 2>/dev/null"
  done
}

# state_of JOB: as Slurm tells it, e.g. COMPLETED.
state_of() { scontrol -o show job "$1" | sed -n 's/.*JobState=\([A-Z_]*\).*/\1/p' | head -1; }
is_in_state() { [[ $(state_of "$1") == "$2" ]]; }
