"""Answers a file of requests with Dask's workers, here or of a cluster: python3 dask_batch.py requests.ndjson answers.ndjson

Each task asks the program for a slice of the lines, and the answers come back in the order of the requests. Dask gives the
task of a worker that is lost to another, and one that failed, as where memory ran out, is tried again. The answers take
their file's place when all are there.
"""

import argparse
import itertools
import os
import subprocess

from distributed import Client, LocalCluster


def answers_to(lines, program):
    """Of one slice; it runs on a worker."""
    return subprocess.run([program, "batch", "--jobs", "1"], input=lines, capture_output=True, check=True).stdout


def slices_of(file, lines_of_slice):
    while lines := b"".join(itertools.islice(file, lines_of_slice)):
        yield lines


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("requests")
    parser.add_argument("answers")
    parser.add_argument("--scheduler", help="address of a scheduler, such as tcp://host:8786; without it, workers on this machine")
    parser.add_argument("--program", default="qdot", help="as the workers find it")
    parser.add_argument("--slice", type=int, default=1000, help="lines of a task")
    options = parser.parse_args()
    cluster = options.scheduler or LocalCluster(threads_per_worker=1, dashboard_address=None)
    part = options.answers + ".part"
    with Client(cluster) as client, open(options.requests, "rb") as requests, open(part, "wb") as answers:
        slices = list(slices_of(requests, options.slice))
        # pure=False: two slices of the same lines are two tasks.
        for answer in client.gather(client.map(answers_to, slices, program=options.program, pure=False, retries=3)):
            answers.write(answer)
    os.replace(part, options.answers)
    if options.scheduler is None:
        cluster.close()


if __name__ == "__main__":
    main()
