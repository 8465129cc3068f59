import json
import subprocess
import tarfile

# Twig puts the student's answer and the question's key here, and escapes both.
ANSWERS = """{{ STUDENT_ANSWER | e('py') }}"""
KEY = """{{ QUESTION.globalextra | e('py') }}"""


def refused(why):
    return {"fraction": 0, "prologuehtml": "<p>" + why + "</p>"}


def graded():
    with tarfile.open("qdot-bundle.tar.gz") as bundle:
        bundle.extractall()
    for name, text in (("answers.csv", ANSWERS), ("key.json", KEY)):
        with open(name, "w", encoding="utf-8") as file:
            file.write(text)
    run = subprocess.run(["qdot/qdot", "check", "--key", "key.json", "--answers", "answers.csv", "--format", "coderunner"],
                         stdout=subprocess.PIPE)
    if run.returncode != 0:
        return refused("Your answers cannot be read: is the first line id,submitted, is each id one of the questions, and there once?")
    return json.loads(run.stdout.decode())


print(json.dumps(graded()))
