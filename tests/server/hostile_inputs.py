"""Requests that a hostile or broken client may send, each with the statuses that may answer it.

Bytes as they go over the wire. `None` among the statuses: the server may also just close the connection.
"""

import json
import random

import json_cases

LOCAL = b"Host: localhost\r\n"
GOOD_BODY = b'{"system": "spring_pendulum", "t_end": 1, "samples": 3}'


def get(target, fields=b"", version=b"HTTP/1.1", host=LOCAL):
    return b"GET " + target + b" " + version + b"\r\n" + host + fields + b"\r\n"


def post(body, target=b"/v1/simulate", fields=b"", length=None):
    length = len(body) if length is None else length
    if isinstance(length, int):
        length = str(length).encode()
    return (b"POST " + target + b" HTTP/1.1\r\n" + LOCAL + b"Content-Length: " + length + b"\r\n" + fields
            + b"\r\n" + body)


def simulate(**fields):
    return post(json.dumps({"system": "spring_pendulum", "t_end": 1, "samples": 3} | fields).encode())


def framing():
    yield "no request", b"GARBAGE\r\n\r\n", {400}
    yield "only a line end too many", b"\r\n\r\n\r\n" + get(b"/nowhere"), {404}
    yield "two words", b"GET /\r\n\r\n", {400}
    yield "four words", b"GET / HTTP/1.1 x\r\n" + LOCAL + b"\r\n", {400}
    yield "two blanks", b"GET  / HTTP/1.1\r\n" + LOCAL + b"\r\n", {400}
    yield "tab for blank", b"GET\t/\tHTTP/1.1\r\n" + LOCAL + b"\r\n", {400}
    yield "HTTP/0.9", b"GET /\r\n", {400, 408, None}
    for version in (b"HTTP/2.0", b"HTTP/1.2", b"HTTP/1", b"http/1.1", b"HTTP/1.1.1", b"HTTP/ 1.1", b"XXX/1.1", b"HTTP/11"):
        yield f"version {version}", get(b"/healthz", version=version), {400}
    yield "HTTP/2 preface", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", {400}
    yield "TLS hello", bytes.fromhex("16030100f8010000f40303") + bytes(200) + b"\n\n", {400, 408}
    for method in (b"G(T", b"G:T", b"\x00", b"G\xc3\xa9T", b'"GET"', b"G,T"):
        yield f"method {method}", method + b" / HTTP/1.1\r\n" + LOCAL + b"\r\n", {400}
    yield "a long method", b"A" * 5000 + b" / HTTP/1.1\r\n" + LOCAL + b"\r\n", {400, 404, 405, 414, 431}
    yield "lower case method", b"get /healthz HTTP/1.1\r\n" + LOCAL + b"\r\n", {405}
    for method in (b"PUT", b"DELETE", b"PATCH", b"TRACE", b"CONNECT", b"BREW"):
        yield f"method {method}", method + b" /v1/simulate HTTP/1.1\r\n" + LOCAL + b"\r\n", {405}
    yield "bare LF", b"GET /healthz HTTP/1.1\nHost: localhost\n\n", {400}
    yield "LF in the middle", b"GET /healthz HTTP/1.1\r\nHost: localhost\nA: b\r\n\r\n", {400}
    yield "CR in a value", get(b"/healthz", b"A: b\rC: d\r\n"), {400}
    yield "NUL in a value", get(b"/healthz", b"A: b\x00c\r\n"), {400}
    yield "NUL in a name", get(b"/healthz", b"A\x00: b\r\n"), {400}
    yield "control in a value", get(b"/healthz", b"A: \x07\r\n"), {400}
    yield "folded field", get(b"/healthz", b"A: b\r\n c\r\n"), {400}
    yield "first field folded", b"GET /healthz HTTP/1.1\r\n Host: localhost\r\n\r\n", {400}
    yield "blank before colon", get(b"/healthz", b"A : b\r\n"), {400}
    yield "no colon", get(b"/healthz", b"just text\r\n"), {400}
    yield "no name", get(b"/healthz", b": b\r\n"), {400}
    yield "name not ASCII", get(b"/healthz", b"\xc3\xa9: b\r\n"), {400}
    yield "no Host", get(b"/healthz", host=b""), {400}
    yield "two Hosts", get(b"/healthz", b"Host: localhost\r\n"), {400}
    yield "empty Host", get(b"/healthz", host=b"Host:\r\n"), {400, 421}
    for host in (b"evil.example", b"localhost:1", b"127.0.0.1.evil.example", b"localhost@evil.example", b"169.254.169.254",
                 b"0.0.0.0", b"[::ffff:127.0.0.1]", b"localhost.", b"\xff\xff", b"a" * 3000):
        yield f"Host {host[:30]}", get(b"/healthz", host=b"Host: " + host + b"\r\n"), {421}
    for origin in (b"http://evil.example", b"null", b"https://127.0.0.1", b"http://localhost:1", b"file://", b"x", b""):
        yield f"Origin {origin}", get(b"/healthz", b"Origin: " + origin + b"\r\n"), {403}
        yield f"POST, Origin {origin}", post(GOOD_BODY, fields=b"Origin: " + origin + b"\r\n"), {403}
    yield "preflight", (b"OPTIONS /v1/simulate HTTP/1.1\r\n" + LOCAL + b"Origin: http://evil.example\r\n"
                        b"Access-Control-Request-Method: POST\r\n\r\n"), {403}


def lengths():
    body = b"{}"
    for length in (b"+2", b"-2", b"2, 2", b"2,2", b"0x2", b"2.0", b"2 2", b"abc", b"", b"'2'", b"\xb2", b"1e1"):
        yield f"Content-Length {length}", post(body, length=length), {400}
    yield "Content-Length twice", post(body, fields=b"Content-Length: 2\r\n"), {400}
    yield "Content-Length twice, different", post(body, fields=b"Content-Length: 3\r\n"), {400}
    for length in (b"1048577", b"99999999999", b"18446744073709551615", b"18446744073709551616", b"9" * 400):
        yield f"Content-Length {length[:25]}", post(body, length=length), {413}
    for coding in (b"chunked", b"xchunked", b"gzip, chunked", b"chunked, identity", b"", b"\x0bchunked", b"CHUNKED"):
        status = {400, 411}
        yield f"Transfer-Encoding {coding}", post(body, fields=b"Transfer-Encoding: " + coding + b"\r\n"), status
    yield "Transfer-Encoding alone", (b"POST /v1/simulate HTTP/1.1\r\n" + LOCAL + b"Transfer-Encoding: chunked\r\n\r\n"
                                      b"2\r\n{}\r\n0\r\n\r\n"), {411}
    yield "chunk of size -2", (b"POST /v1/simulate HTTP/1.1\r\n" + LOCAL + b"Transfer-Encoding: chunked\r\n\r\n"
                               b"fffffffffffffffe\r\n"), {411}
    yield "blank before the colon of Transfer-Encoding", post(body, fields=b"Transfer-Encoding : chunked\r\n"), {400}
    for coding in (b"gzip", b"deflate", b"br", b"identity, gzip", b"x"):
        yield f"Content-Encoding {coding}", post(body, fields=b"Content-Encoding: " + coding + b"\r\n"), {415}
    yield "Expect", post(body, fields=b"Expect: a-miracle\r\n"), {417}
    yield "POST without a length", b"POST /v1/simulate HTTP/1.1\r\n" + LOCAL + b"\r\n", {411}
    yield "GET whose body is a request", get(b"/nowhere", b"Content-Length: 40\r\n") + b"GET /evil HTTP/1.1\r\n".ljust(40), {404}


def sizes():
    yield "long target", get(b"/" + b"a" * 9000), {414}
    yield "longer target", get(b"/" + b"a" * 20000), {414}
    yield "endless request line", b"G" * 100000, {414}
    yield "long field", get(b"/healthz", b"A: " + b"b" * 17000 + b"\r\n"), {431}
    yield "many fields", get(b"/healthz", b"".join(b"A%d: b\r\n" % i for i in range(65))), {431}
    yield "very many fields", get(b"/healthz", b"A: b\r\n" * 20000), {431}
    yield "body of 1 MiB and one byte", post(b"{" * (1024 * 1024 + 1)), {413}
    yield "body of 1 MiB", post(b"{" * (1024 * 1024)), {400, 413}
    yield "body of 64 KiB and one byte", post(b" " * (64 * 1024) + b"1"), {413}
    yield "long query", get(b"/v1/energy?" + b"a=1&" * 2000), {422}
    yield "2000 parameters of one name", get(b"/v1/energy?system=spring_pendulum" + b"&m=1" * 1500), {422}


def encodings():
    for target in (b"/%", b"/%2", b"/%zz", b"/%00", b"/%ff", b"/%c0%af", b"/v1/energy?system=%ff", b"/v1/energy?%00=1",
                   b"/v1/energy?system=%ed%a0%80"):
        yield f"target {target}", get(target), {400}
    for target in (b"/../../etc/passwd", b"/%2e%2e/%2e%2e/etc/passwd", b"/v1/systems/../../etc/passwd", b"//", b"/v1//simulate",
                   b"/v1/simulate/", b"/v1/systems/..%2f..%2fetc%2fpasswd", b"/v1/systems/a%0d%0aX:%20y", b"/errors/%3cscript%3e",
                   b"/v1/problems/0", b"/v1/problems/11", b"/v1/problems/1e1", b"/v1/problems/-1", b"/v1/problems/99999999999999999999",
                   b"/healthz/x", b"/HEALTHZ", b"/a%0d%0ab", b"/\xc3\xa9", b"*"):
        yield f"target {target}", get(target), {404}
    yield "target with a blank", get(b"/a b"), {400}
    yield "target with raw bytes", get(b"/\xff\xfe"), {400}
    yield "query of raw bytes", get(b"/v1/energy?system=\xff"), {400}
    yield "absolute target", get(b"http://localhost/nowhere"), {404}
    yield "CRLF in a query", get(b"/v1/energy?system=a%0d%0aSet-Cookie:x"), {422}
    yield "Accept of another type", get(b"/v1/systems", b"Accept: image/png\r\n"), {406}
    yield "Accept of nonsense", get(b"/v1/systems", b"Accept: ;;;,,,q=\r\n"), {200, 406}
    for kind in (b"text/plain", b"multipart/form-data; boundary=x", b"application/xml", b"image/png", b"application/json; charset=utf-16"):
        yield f"Content-Type {kind}", post(GOOD_BODY, fields=b"Content-Type: " + kind + b"\r\n"), {415}
    yield "form that is not JSON", post(b"system=x", fields=b"Content-Type: application/x-www-form-urlencoded\r\n"), {415}
    yield "Content-Type twice", post(GOOD_BODY, fields=b"Content-Type: a/b\r\nContent-Type: application/json\r\n"), {400}


def json_texts():
    for name, text in (json_cases.BROKEN | json_cases.REFUSED).items():
        yield name, post(text), {400}
    for name, text in json_cases.ACCEPTED.items():
        yield name, post(text), {422}
    for name, text in (("brackets", b"[" * 60000), ("braces", b'{"":' * 15000)):
        yield f"endless {name}", post(text), {422}
    yield "seventeen deep", post(b"[" * 17 + b"]" * 17), {422}
    yield "many nodes", post(b'{"times":[' + b"0," * 11000 + b"0]}"), {422}
    yield "duplicate keys", post(b'{"system":"spring_pendulum","t_end":1,"t_end":2}'), {422}
    yield "duplicate keys written differently", post(b'{"system":"spring_pendulum","t_end":1,"t\\u005fend":2}'), {422}
    yield "NUL in a key", post(b'{"a\\u0000b":1}'), {422}
    yield "a number of a megabyte", post(b'{"t_end":' + b"1" * 60000 + b"}"), {400, 422}
    yield "2000 unknown fields", post(json.dumps({f"f{i}": i for i in range(2000)}).encode()), {422}
    yield "an unknown field of 30 kB", post(json.dumps({"x" * 30000: 1}).encode()), {422}


def numbers():
    for name, value in (("t_end", 0), ("t_end", -1), ("t_end", 1e300), ("t_end", 1e10), ("t_end", 1e-300), ("t_end", None),
                        ("t_end", []), ("t_end", {}), ("t_end", True), ("t_end", "soon"), ("t_end", "1 m"), ("t_end", "1e"),
                        ("t_end", ""), ("t_end", "1" * 5000), ("samples", 0), ("samples", 1), ("samples", -1), ("samples", 100001),
                        ("samples", 1e300), ("samples", 2.5), ("samples", 2**63), ("samples", 2**64), ("samples", -2**63), ("samples", "3"),
                        ("rtol", 0), ("rtol", -1), ("rtol", 1e10), ("rtol", 1e-16), ("atol", 0), ("atol", -1), ("atol", 2), ("atol", 1e300),
                        ("digits", 0), ("digits", 18), ("digits", -1), ("digits", 1.5), ("max_error", 0), ("max_error", 2),
                        ("max_evaluations", 0), ("max_evaluations", 1e12), ("dt", 0), ("dt", -1), ("dt", 1e-12), ("dt", 0.3), ("times", [2, 1]),
                        ("times", [1, 1]), ("times", ["x"]), ("times", 3), ("times", [[1]]), ("method", "magic"), ("method", 1),
                        ("accuracy", "best"), ("include", ["secrets"]), ("include", "energy,secrets"), ("events", ["theta"]),
                        ("events", ["theta=0"] * 21), ("events", ["theta=" + "(" * 3000]), ("on_invalid", "panic"), ("steps", 0), ("steps", 3),
                        ("format", "exe"), ("verify", "no"), ("kk", 1), ("system", "no_such_system"), ("system", ""), ("system", None),
                        ("system", 5), ("system", []), ("system", {}), ("system", "../../etc/passwd"), ("system", "x" * 5000),
                        ("parameters", {"m": 0}), ("parameters", {"m": -1}), ("parameters", {"m": "heavy"}), ("parameters", {"m": "1 s"}),
                        ("parameters", {"zz": 1}), ("parameters", [1]), ("parameters", {"m": None}), ("parameters", {"m": 1e400}),
                        ("initial", {"l": 1e308}), ("initial", {"l": 0}), ("initial", {"theta": "30 kg"}), ("initial", {"nope": 1}),
                        ("initial", 5), ("initial", {"theta_dot": 1e200}), ("inputs", {"F": "1"})):
        yield f"{name}={str(value)[:25]}", simulate(**{name: value}), {400, 422}


def expressions():
    scene = {"name": "own", "parameters": [{"name": "m", "unit": "kg", "default": 1}],
             "coordinates": [{"name": "x", "unit": "m", "initial": 1}],
             "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "0"]}]}
    bad = ["", "(", ")", "x+", "*x", "x x", "x;y", "x=1", "import os", "__class__", "system('ls')", "x.y", "x[0]", "f(x)", "sin", "sin()",
           "sin(x,x)", "sin x", "@", "x\0", "é", "1e999999", "1..2", "0x10", "x^^2", "x**2**", "(" * 1000 + "x" + ")" * 1000,
           "-" * 4000 + "x", "+".join(["x"] * 3000), "x^" * 500 + "x", "sin(" * 200 + "x" + ")" * 200, "unknown_name", "m+x", "sin(x)",
           "x" * 5000, "9" * 4000, "x/0", "log(x)"]
    for text in bad:
        body = scene | {"bodies": [{"kind": "particle", "mass": "m", "position": [text, "0"]}]}
        yield f"position {text[:20]!r}", post(json.dumps({"system": body, "t_end": 1}).encode()), {400, 422}
        force = {"system": "forced_spring_pendulum", "t_end": 1, "inputs": {"F": text}}
        # What a coordinate may not be, a force of time may: the sine of t is one.
        statuses = {200, 400, 422}
        yield f"force {text[:20]!r}", post(json.dumps(force).encode()), statuses
    swelling = "x"
    for _ in range(9):
        swelling = f"({swelling})*sin({swelling})"
    body = scene | {"bodies": [{"kind": "particle", "mass": "m", "position": [swelling[:4000], "0"]}]}
    yield "swelling position", post(json.dumps({"system": body, "t_end": 1}).encode()), {200, 422, 503}
    for change in ({"bodies": []}, {"bodies": [{}]}, {"bodies": 5}, {"coordinates": []}, {"coordinates": [{"name": "x"}] * 50},
                   {"name": "x" * 10000}, {"name": "<script>"}, {"parameters": [{"name": "sin", "unit": "kg", "default": 1}]},
                   {"parameters": [{"name": "m", "unit": "bananas", "default": 1}]}, {"bodies": [{"kind": "blob"}]}, {"gravity": ["0"]},
                   {"unknown": 1}, {"lagrangian": "x"}):
        yield f"scene with {str(change)[:30]}", post(json.dumps({"system": scene | change, "t_end": 1}).encode()), {200, 400, 422}
    cyclic = scene | {"parameters": [{"name": "a", "unit": "kg", "default": "m"}, {"name": "m", "unit": "kg", "default": "a"}]}
    yield "parameters of each other", post(json.dumps({"system": cyclic, "t_end": 1}).encode()), {422}


def ask(path, **fields):
    return post(json.dumps(fields).encode(), target=path.encode())


def eight_angles(lagrangian):
    return {"name": "own", "coordinates": [{"name": name, "unit": "rad", "initial": 0.1, "initial_rate": 0.01} for name in "abcdefgh"],
            "parameters": [{"name": "K", "unit": "J", "default": 1}, {"name": "J", "unit": "kg*m^2", "default": 1}],
            "lagrangian": lagrangian}


def coupled_rotors():
    """Its mass matrix is full, and every product in it is of sums of other sines."""
    names = "abcdefgh"

    def square(k):
        terms = (f"sin({names[(3 * i + k) % 8]}*{names[(i * k + 5) % 8]}+{k})*{name}_dot" for i, name in enumerate(names))
        return "(" + "+".join(terms) + ")^2"

    return eight_angles("J/2*(" + "+".join([square(k) for k in range(1, 13)] + [f"{name}_dot^2" for name in names]) + ")")


def rough_landscape():
    """Quick to derive; but in 8 dimensions there is no end to where its equilibria might be."""
    names = "abcdefgh"
    dice = random.Random(1)
    hills = (f"sin({'+'.join(dice.choices(names, k=8))})^6" for _ in range(60))
    return eight_angles("J/2*(" + "+".join(f"{name}_dot^2" for name in names) + ") - K*(" + "+".join(hills) + ")")


def endless():
    """Each takes seconds of a thread, most would take hours: their end is a limit or the deadline. Not of all_inputs()."""
    refused = {422, 503}
    yield "equations of coupled rotors", ask("/v1/equations", system=coupled_rotors()), {200, 503}
    yield "simulate of coupled rotors", ask("/v1/simulate", system=coupled_rotors(), t_end=1e6), refused
    yield "equilibria of a rough landscape", ask("/v1/equilibria", system=rough_landscape()), {200, 503}
    yield "a long motion", simulate(t_end=1e6, rtol=1e-13, method="adams"), refused
    curves = ["+".join(f"sin({k}*theta)" for k in range(1, 100)) + f"={k / 100}" for k in range(10)]
    yield "events of many harmonics", simulate(t_end=5000, events=curves), refused


GROUPS = (framing, lengths, sizes, encodings, json_texts, numbers, expressions)


def all_inputs():
    """(name, bytes, statuses)"""
    for group in GROUPS:
        for name, data, statuses in group():
            yield f"{group.__name__}: {name}", data, statuses
