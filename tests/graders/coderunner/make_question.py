#!/usr/bin/env python3
"""Prints a CodeRunner question with the key and the bundle of this directory in it, as Moodle XML: make_question.py NAME"""

import base64
import json
import sys
from xml.sax.saxutils import escape

TEXT = "<p>Write each answer behind its comma.</p>"


def contents(name):
    with open(name, encoding="utf-8") as file:
        return file.read()


def element(name, text):
    return f"    <{name}>{escape(str(text))}</{name}>\n"


def main(name):
    key = contents("key.json")
    items = json.loads(key)["items"]
    with open("qdot-bundle.tar.gz", "rb") as bundle:
        support = base64.b64encode(bundle.read()).decode()
    fields = {"coderunnertype": "python3", "prototypetype": 0, "allornothing": 0, "penaltyregime": "0",
              "answerboxlines": 10, "answerpreload": "id,submitted\n" + "".join(item["id"] + ",\n" for item in items),
              "globalextra": key, "useace": 0, "template": contents("template.py"), "iscombinatortemplate": 1,
              "allowmultiplestdins": 0, "grader": "TemplateGrader", "cputimelimitsecs": 10, "memlimitmb": 768,
              "defaultgrade": sum(item.get("points", 1) for item in items)}
    print('<?xml version="1.0" encoding="UTF-8"?>\n<quiz>\n  <question type="coderunner">\n'
          f"    <name><text>{escape(name)}</text></name>\n"
          f'    <questiontext format="html"><text>{escape(TEXT)}</text></questiontext>\n'
          + "".join(element(*field) for field in fields.items())
          + '    <testcases>\n      <testcase testtype="0" useasexample="0" hiderestiffail="0" mark="1">\n'
          "        <testcode><text></text></testcode>\n        <stdin><text></text></stdin>\n        <expected><text></text></expected>\n"
          "        <extra><text></text></extra>\n        <display><text>SHOW</text></display>\n      </testcase>\n"
          f'      <file name="qdot-bundle.tar.gz" path="/" encoding="base64">{support}</file>\n'
          "    </testcases>\n  </question>\n</quiz>")


if __name__ == "__main__":
    main(sys.argv[1])
