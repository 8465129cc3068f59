"""The same request has the same bytes on every processor: glibc's libm takes other roads without AVX2 and FMA, and
no answer may depend on it. `test_same_bytes.py --requests 2000` tries more."""

import json
import pathlib
import random
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "server"))

from running_qdot import RunningQdot  # noqa: E402  (its directory had to be named first)

REQUESTS = 200
# Each server's processor is poorer than the one before it.
NO_FMA = "-AVX512F,-AVX2,-FMA,-FMA4,-AVX,-BMI2"
LEVELS = ("", NO_FMA, NO_FMA + ",-SSE4_1,-SSE4_2,-SSSE3")


def drawn(rng, symbols):
    """Some of a system's numbers, near their defaults."""
    values = {}
    for symbol in symbols:
        try:
            by_default = float(symbol["default"])
        except ValueError:
            continue  # an expression of the others
        if rng.random() < 0.6:
            values[symbol["name"]] = round(by_default * rng.uniform(0.5, 1.6), 6) if by_default else 0
    return values


def methods(server):
    """{name: what a request for it needs beside the name}: some step by a fixed h."""
    document = json.loads(server.request("GET", "/openapi.json").data)
    names = document["components"]["schemas"]["SimulationRequest"]["properties"]["method"]["enum"]
    body = {"system": "spring_pendulum", "t_end": 0.1}
    refused = [name for name in names if server.request("POST", "/v1/simulate", json.dumps({**body, "method": name})).status == 422]
    return {name: {"h": 0.01} if name in refused else {} for name in names}


def simulation(rng, system, methods):
    method = rng.choice(list(methods))
    body = {"t_end": round(rng.uniform(0.5, 6), 3), "samples": 25, "method": method, **methods[method]}
    if "h" in body:
        return body
    if rng.random() < 0.3:
        body = {**body, "max_error": 10.0 ** -rng.randint(4, 9)}
    if any(c["name"] == "theta" for c in system["coordinates"]):
        body["events"] = ["theta=0.05+"]
    return body


def question(rng, systems, methods):
    system = rng.choice(systems)
    parameters = drawn(rng, system["parameters"])
    initial = {c["name"]: round(rng.uniform(0.05, 0.6), 4) for c in system["coordinates"] if c["unit"] == "rad"}
    body = {"system": system["name"], "parameters": parameters}
    kinds = ("simulate", "energy", "modes", "equilibria", "solve_for", "bifurcations", "turning_points", "equations",
             "gait", "accuracy")
    kind = rng.choices(kinds, (12, 4, 4, 4, 4, 1, 4, 1, 1, 1))[0]
    if kind == "simulate":
        return kind, {**body, "initial": initial, **simulation(rng, system, methods)}
    if kind in ("energy", "turning_points"):
        return kind, {**body, "initial": initial}
    if kind == "solve_for":
        name = rng.choice(system["parameters"])["name"]
        return "equilibria", {**body, "solve_for": name, "at": initial}
    if kind == "bifurcations":
        name = rng.choice(system["parameters"])["name"]
        return kind, {"system": system["name"], "parameter": name, "from": 0.1, "to": rng.choice((3, 10))}
    if kind == "gait":
        return kind, {"system": "compass_walker", "parameters": {"gamma": round(rng.uniform(0.004, 0.012), 5), "m": 0}}
    if kind == "accuracy":
        return kind, {**body, "initial": initial, "t_end": 2}
    return kind, body


class SameBytes(unittest.TestCase):
    def test_answers_do_not_depend_on_what_the_processor_can_do(self):
        servers = [RunningQdot("--threads", "1", "--deadline", "60", **({"GLIBC_TUNABLES": "glibc.cpu.hwcaps=" + level} if level else {}))
                   for level in LEVELS]
        try:
            names = json.loads(servers[0].request("GET", "/v1/systems").data)["systems"]
            systems = [json.loads(servers[0].request("GET", "/v1/systems/" + entry["name"]).data) for entry in names]
            known = methods(servers[0])
            self.assertGreater(len(known), 3)
            rng = random.Random(11)
            answered = 0
            for number in range(REQUESTS):
                kind, body = question(rng, systems, known)
                first, *others = [server.request("POST", "/v1/" + kind, json.dumps(body)) for server in servers]
                answered += first.status == 200
                for level, other in zip(LEVELS[1:], others):
                    self.assertEqual((first.status, first.data), (other.status, other.data), f"{level}: {kind} {body}")
            self.assertGreater(answered, REQUESTS // 2)
            print(f"{REQUESTS} requests, {answered} answered, on {len(LEVELS)} processors", file=sys.stderr)
        finally:
            for server in servers:
                server.__exit__()


if __name__ == "__main__":
    if "--requests" in sys.argv:
        at = sys.argv.index("--requests")
        REQUESTS = int(sys.argv[at + 1])
        del sys.argv[at:at + 2]
    unittest.main()
