#!/bin/bash
# Solves a study in parts, each a task of an array; a job that depends on them gathers the results.
#
# Usage: scripts/slurm/study.sh PARTS TABLE [DECK] [OPTIONS OF axijoint study]
#
#    scripts/slurm/study.sh 8 friction.csv case3.dat -o out
#
# submits both jobs; options of sbatch may stand in its variables (SBATCH_ACCOUNT, SBATCH_PARTITION, SBATCH_TIMELIMIT
# ...). It stands for
#
#    array=$(sbatch --parsable --array=1-8 scripts/slurm/study.sh 8 friction.csv case3.dat -o out)
#    sbatch --dependency=afterany:$array scripts/slurm/study.sh 8 friction.csv case3.dat -o out
#
# which may have any options of sbatch. Rows that a task did not come to are solved by the job that gathers. A task
# that is stopped goes back to the queue and on from there, as in one.sh. Exit codes are the largest of the rows.
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

parts=${1:?the number of parts}
shift
case "$parts" in *[!0-9]* | 0) echo "$parts is no number of parts" >&2; exit 2 ;; esac
# Slurm runs a copy of this script, which has another name; inside an allocation it is submitted, too
if [ -z "${SLURM_JOB_ID:-}" ] || [ "${0##*/}" = study.sh ]; then
   array=$(sbatch --parsable --array="1-$parts" "$0" "$parts" "$@") || exit
   gather=$(sbatch --parsable --dependency="afterany:${array%%;*}" "$0" "$parts" "$@") || exit
   echo "array ${array%%;*} solves $parts parts, job ${gather%%;*} gathers them"
   exit
fi
run_job "$AXIJOINT" study "$@" --part "${SLURM_ARRAY_TASK_ID:-0}/$parts" \
   ${memory:+--memory "$memory"}
