#!/bin/bash
# Runs one deck in several processes by MPI, on one node or more.
#
# Usage: sbatch [OPTIONS OF SBATCH] scripts/slurm/mpi.sh DECK [OPTIONS OF axijoint run]
#
#    export AXIJOINT_MPI=/home/me/axijoint/bin/axijoint-mpi
#    sbatch --nodes=2 --ntasks=16 --cpus-per-task=4 --mem=64G scripts/slurm/mpi.sh chimney.dat -o out
#
# Two minutes before its time is over the job is stopped, keeps how far it is, and goes back to the queue; its next
# start goes on from there, with as many processes as it has then.
# AXIJOINT_MPI is the path of the program that is built for MPI (doc/cluster.md), MPIRUN what starts it: mpirun, or
# "srun --mpi=pmix" where the MPI of the site knows it.
#
# Options on the command line of sbatch win over these:
#SBATCH --job-name=axijoint
#SBATCH --ntasks=2
#SBATCH --cpus-per-task=1
#SBATCH --mem=4G
#SBATCH --time=1:00:00
#SBATCH --signal=B:USR1@120
#SBATCH --requeue
#SBATCH --open-mode=append

# Runs a program and ends the job with its exit code. `B:` sends the signal to this shell alone, which hands it on;
# a signal also ends `wait`, which is then called again. The job goes back to the queue if the program was stopped by
# the signal (exit code 75) while the job was to run on: not if it was cancelled, not if Slurm puts it back itself, and
# not if it has kept nothing since it began, for then its next start would come no farther.
run_job() { # program, arguments
   local begun code folder=. kept=unknown last='' seen=0 word
   for word in "$@"; do
      [ "$last" != -o ] || folder=$word
      last=$word
   done
   begun=$folder/.begun.$SLURM_JOB_ID
   { mkdir -p "$folder" && : >"$begun"; } 2>/dev/null || begun=''
   signals=0
   trap 'signals=$((signals + 1)); kill -USR1 "$program" 2>/dev/null' USR1 TERM
   "$@" &
   program=$!
   while wait "$program"; code=$?; [ "$seen" -lt "$signals" ]; do seen=$signals; done
   if [ -n "$begun" ]; then
      kept=$(find "$folder" -maxdepth 1 -newer "$begun" \( -name '*.state' -o -name '*.h5' -o -name '*.rows' \) -print -quit)
      rm -f "$begun"
   fi
   if [ "$signals" -gt 0 ] && [ "$code" -eq 75 ] &&
      [ "$(squeue --noheader --job="$SLURM_JOB_ID" --format=%T)" = RUNNING ]; then
      if [ -n "$kept" ]; then
         echo "The job goes back to the queue" >&2
         scontrol requeue "$SLURM_JOB_ID"
      else
         echo "The job ends, for in its time nothing was kept that it could go on from: give it more time" \
            "(axijoint estimate --slurm DECK says how much), or room for its files" >&2
      fi
   fi
   exit "$code"
}

AXIJOINT=${AXIJOINT_MPI:-axijoint-mpi}
command -v "$AXIJOINT" >/dev/null || {
   echo "there is no program $AXIJOINT: set the variable AXIJOINT_MPI to its path, or load its module" >&2
   exit 127
}
export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} # what the job has
memory=${SLURM_MEM_PER_NODE#0}                     # 0 is all of the machine
# Processes of a node share its memory; 2(x3),1 is two on each of three nodes and one on the last
tasks=$(echo "${SLURM_TASKS_PER_NODE:-1}" | sed 's/([^)]*)//g' | tr ',' '\n' | sort -n | tail -n 1)

# shellcheck disable=SC2086  # several words
run_job ${MPIRUN:-mpirun --bind-to none} "$AXIJOINT" run "$@" --resume ${memory:+--memory $((memory/tasks))}
