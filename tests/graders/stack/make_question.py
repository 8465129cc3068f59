#!/usr/bin/env python3
"""Prints a STACK question that grades the answers of key.json in Maxima, as Moodle XML: make_question.py NAME"""

import json
import re
import sys
from xml.sax.saxutils import escape

sys.path.append("qdot")

from qdot import Qdot  # noqa: E402

qdot = Qdot(command="qdot/qdot")


def original(key):
    """The items of a key, each range at its default; as `qdot check` takes a key that no variant was drawn of."""
    ranges = key.get("ranges", {})

    def value_of(match, alone):
        name = match.group(1)
        if "default" not in ranges[name]:
            raise SystemExit(f"The range {name} has no default: draw a variant of the key first, qdot variant KEY --seed 1")
        value, unit = str(ranges[name]["default"]), ranges[name].get("unit", "")
        return f"{value} {unit}".strip() if alone else f"({value})"

    def filled(value):
        if isinstance(value, dict):
            return {name: filled(part) for name, part in value.items()}
        if isinstance(value, list):
            return [filled(part) for part in value]
        if not isinstance(value, str):
            return value
        return re.sub(r"\$(\w+)", lambda match: value_of(match, match.group() == value), value)

    return [{**item, "expect": filled(item["expect"])} for item in key["items"]]


def in_maxima(text):
    return re.sub(r"\bpi\b", "%pi", str(text))


def equations_of(request):
    """The equations of a system in Maxima's form, and what its key fixes: [M = 2*m]."""
    others = set(request) - {"system", "parameters"}
    if others:
        raise SystemExit(f"STACK questions have no {', '.join(sorted(others))} in a system.")
    given = request.get("parameters", {})
    resolved = qdot.energy(request["system"], parameters=given)["request"]["parameters"] if given else {}
    has_unit = {name for name, value in given.items() if re.fullmatch(r"[-+.\dE]+ ?[^-+*/^\d]\S*", str(value), re.IGNORECASE)}
    fixed = ", ".join(f"{name} = {resolved[name] if name in has_unit else in_maxima(value)}" for name, value in given.items())
    return qdot.equations(request["system"], form="maxima"), f"[{fixed}]"


def words_of(answers):
    """Names that a student may write: of more than one letter they have to be allowed."""
    return sorted(set(re.findall(r"[A-Za-z_]\w+", " ".join(answers))) - {"sin", "cos", "tan", "sqrt", "exp", "log", "pi"})


def number(item, answer):
    """abs(sub - tru) <= atol + rtol*abs(tru), of an answer in SI units."""
    rule = item.get("rule", {})
    if rule.get("kind", "relabs") != "relabs" or set(rule) - {"kind", "rtol", "atol"}:
        raise SystemExit(f"{item['id']}: a STACK question knows only the rule relabs with rtol and atol.")
    (question,) = set(item["expect"]) - {"at"}
    value = qdot.ask(question, item["expect"][question])
    for step in item["expect"]["at"].split("/")[1:]:
        value = value[int(step) if isinstance(value, list) else step]
    decide = f"right: is(abs(float({answer}) - ta_{answer}) <= {rule.get('atol', 1e-8)} + {rule.get('rtol', 0.01)}*abs(ta_{answer}));"
    return {"type": "numerical", "truth": repr(value), "decide": decide, "words": [], "wrong": f"2*ta_{answer} + 1"}


def expression(item, answer):
    equations, fixed = equations_of(item["expect"]["expression"])
    places = {"h": "jacobi_integral", "H": "hamiltonian"}
    named = {**equations["momenta"], **{"Q_" + name: force for name, force in equations["generalized_forces"].items()}}
    of = item["expect"].get("of")
    truth = item["expect"].get("is") or named.get(of) or equations[places.get(of, of)]
    decide = f"right: is(radcan(exponentialize(subst({fixed}, {answer} - ta_{answer}))) = 0);"
    return {"type": "algebraic", "truth": in_maxima(truth), "decide": decide, "words": words_of([truth]), "wrong": f"2*ta_{answer} + 1"}


def equation(item, answer):
    equations, fixed = equations_of(item["expect"]["equation"])
    of = item["expect"]["of"]
    (truth,) = [entry["equation"] for entry in equations["equations_of_motion"] if entry["coordinate"] == of]
    motion = ", ".join(f"{name} = {value}" for name, value in equations["accelerations"].items())
    decide = (f"residual: subst({fixed}, lhs({answer}) - rhs({answer}));\n"
              f"motion: subst({fixed}, [{in_maxima(motion)}]);\n"
              f"slope: radcan(exponentialize(diff(residual, {of}_ddot)));\n"
              "right: is(radcan(exponentialize(subst(motion, residual))) = 0) and not is(slope = 0);")
    return {"type": "algebraic", "truth": in_maxima(truth), "decide": decide, "words": words_of([truth, *equations["accelerations"].values()]),
            "wrong": "0 = 0"}


def part_of(item, answer):
    kinds = {"expression": expression, "equation": equation}
    return next((kinds[kind] for kind in kinds if kind in item["expect"]), number)(item, answer)


def element(name, text):
    return f"<{name}>{escape(str(text))}</{name}>"


def text_of(name, text, form=""):
    return f"<{name}{form}><text>{escape(text)}</text></{name}>"


def input_of(answer, part):
    fields = {"name": answer, "type": part["type"], "tans": f"ta_{answer}", "boxsize": 60, "strictsyntax": 1, "insertstars": 1,
              "syntaxhint": "", "forbidwords": "", "allowwords": ", ".join(part["words"]), "forbidfloat": 0,
              "requirelowestterms": 0, "checkanswertype": 0, "mustverify": 1, "showvalidation": 1}
    return "<input>" + "".join(element(*field) for field in fields.items()) + "</input>"


def tree_of(item, answer, part):
    note = "prt_" + answer
    node = {"name": 0, "answertest": "AlgEquiv", "sans": "right", "tans": "true", "testoptions": "", "quiet": 1,
            "truescoremode": "=", "truescore": 1, "truepenalty": "", "truenextnode": -1, "trueanswernote": note + "-0-T"}
    other = {"falsescoremode": "=", "falsescore": 0, "falsepenalty": "", "falsenextnode": -1, "falseanswernote": note + "-0-F"}
    html = ' format="html"'
    return ("<prt>" + element("name", note) + element("value", item.get("points", 1)) + element("autosimplify", 1)
            + text_of("feedbackvariables", part["decide"]) + "<node>" + "".join(element(*field) for field in node.items())
            + text_of("truefeedback", "", html) + "".join(element(*field) for field in other.items())
            + text_of("falsefeedback", "", html) + "</node></prt>")


def question_test(number_of, parts, is_right):
    inputs = "".join("<testinput>" + element("name", answer) + element("value", f"ta_{answer}" if is_right else part["wrong"])
                     + "</testinput>" for answer, (_, part) in parts.items())
    note = "-0-T" if is_right else "-0-F"
    expected = "".join("<expected>" + element("name", "prt_" + answer) + element("expectedscore", int(is_right))
                       + element("expectedpenalty", 0 if is_right else 0.1) + element("expectedanswernote", f"prt_{answer}{note}")
                       + "</expected>" for answer in parts)
    return "<qtest>" + element("testcase", number_of) + inputs + expected + "</qtest>"


def main(name):
    with open("key.json", encoding="utf-8") as file:
        items = original(json.load(file))
    parts = {f"ans{i}": (item, part_of(item, f"ans{i}")) for i, item in enumerate(items, 1)}
    html = ' format="html"'
    text = "".join(f"<p>{escape(item['id'])}: [[input:{answer}]] [[validation:{answer}]] [[feedback:prt_{answer}]]</p>"
                   for answer, (item, _) in parts.items())
    print('<?xml version="1.0" encoding="UTF-8"?>', "<quiz>", '<question type="stack">', text_of("name", name),
          text_of("questiontext", text, html), text_of("generalfeedback", "", html),
          element("defaultgrade", sum(item.get("points", 1) for item in items)), element("penalty", 0.1),
          text_of("questionvariables", "\n".join(f"ta_{answer}: {part['truth']};" for answer, (_, part) in parts.items())),
          text_of("specificfeedback", "", html), text_of("questionnote", ""), element("questionsimplify", 1),
          element("assumepositive", 0), element("multiplicationsign", "dot"), element("sqrtsign", 1), element("complexno", "i"),
          *[input_of(answer, part) for answer, (_, part) in parts.items()],
          *[tree_of(item, answer, part) for answer, (item, part) in parts.items()],
          question_test(1, parts, True), question_test(2, parts, False), "</question>", "</quiz>", sep="\n")


if __name__ == "__main__":
    main(sys.argv[1])
