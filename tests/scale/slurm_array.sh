#!/bin/bash
#SBATCH --job-name=qdot --array=0-9 --requeue --output=log.%a
# Answers a file of requests on a cluster, a slice a task, in a directory that all nodes share:
#     split -d -a 3 -n l/10 requests.ndjson in.
#     sbatch slurm_array.sh
#     cat $(ls in.??? | sed s/in/out/) > answers.ndjson  # fails where a slice is missing: sbatch --array=3 slurm_array.sh
# A node may be taken for lost while it still writes. So each try has a file of its own, and a whole one gets the name.
set -euo pipefail
slice=$(printf %03d "$SLURM_ARRAY_TASK_ID")
part=part.$slice.$SLURM_JOB_ID.${SLURM_RESTART_COUNT:-0}
"${QDOT:-qdot}" batch "in.$slice" --jobs "${SLURM_CPUS_PER_TASK:-1}" --output "$part"
mv "$part" "out.$slice"
