#!/bin/bash
# Runs the decks of a list, each as a task of an array.
#
# Usage: sbatch --array=1-N [OPTIONS OF SBATCH] scripts/slurm/decks.sh LIST [OPTIONS OF axijoint run]
#
#    ls decks/*.dat >list
#    sbatch --array=1-$(grep -c . list) scripts/slurm/decks.sh list -o out
#    sbatch --array=1-1000%20 scripts/slurm/decks.sh list -o out         # at most 20 at once
#
# LIST has the path of a deck on each line; task K runs the K-th. Each is stopped in time, goes back to the queue and on
# from there as in one.sh. The exit code of a task is that of axijoint: `sacct --job=ID --format=JobID,State,ExitCode`.
# AXIJOINT is the path of the program, if it is not on the PATH. See doc/cluster.md.
#
# Options on the command line of sbatch win over these:
#SBATCH --job-name=axijoint
#SBATCH --nodes=1
#SBATCH --ntasks=1
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

AXIJOINT=${AXIJOINT:-axijoint}
command -v "$AXIJOINT" >/dev/null || {
   echo "there is no program $AXIJOINT: set the variable AXIJOINT to its path, or load its module" >&2
   exit 127
}
export OMP_NUM_THREADS=${SLURM_CPUS_PER_TASK:-1} # what the job has
memory=${SLURM_MEM_PER_NODE#0}                     # 0 is all of the machine

list=${1:?the list of decks}
shift
deck=$(sed 's/^[[:blank:]]*//; s/[[:space:]]*$//' "$list" | grep . | sed -n "${SLURM_ARRAY_TASK_ID:?submit this script with --array=1-N}p")
[ -n "$deck" ] || { echo "$list has no deck $SLURM_ARRAY_TASK_ID" >&2; exit 2; }
run_job "$AXIJOINT" run "$deck" "$@" --resume ${memory:+--memory "$memory"}
