"""A file of motions to compute, and the bytes one machine answers it with."""

import json
import subprocess

from running_qdot import ENVIRONMENT, QDOT


def write_motions(path, count, t_end):
    with open(path, "w", encoding="utf-8") as file:
        for number in range(count):
            motion = {"system": "spring_pendulum", "parameters": {"k": 20 + number / 10}, "t_end": t_end, "samples": 3}
            file.write(json.dumps({"id": number, "simulate": motion}) + "\n")


def answers(path):
    return subprocess.run([QDOT, "batch", path], capture_output=True, check=True, env=ENVIRONMENT).stdout
