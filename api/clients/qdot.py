"""qdot from Python: one file, no dependencies. Copy it beside your program.

    >>> from qdot import Qdot
    >>> mechanics = Qdot("http://localhost:8080")
    >>> modes = mechanics.modes("cart_pendulum", k="2*m*g/l")
    >>> [mode["omega"] for mode in modes["modes"]]
    [3.5017852589786256, 7.003570517957251]

    >>> swing = mechanics.simulate("spring_pendulum", l="60 cm", theta="30deg", t_end=2, samples=3, digits=4)
    >>> swing["trajectory"]["theta"]
    [0.5236, 0.2391, -0.3502]

A parameter, a coordinate or a velocity of the system is given by its own name, k=10, theta="30deg", theta_dot=0, or
in its place, parameters={"k": 10}, initial={"theta": "30deg"}. A number is in SI units; a text may carry its unit or be
an expression of parameters. What comes back is the answer of the service as it is, a dict: trajectory columns are
lists, so `pandas.DataFrame(swing["trajectory"])` is a table. What is wrong with a request is raised as a Problem that
says where, why and what to write instead.

Without a server: Qdot(command="build/release/qdot") asks the command line, with the same answers. Key grades with it, in
the cells of a notebook or in any other test.
"""

from __future__ import annotations

import decimal
import difflib
import fractions
import functools
import json
import math
import os
import subprocess
import threading
import time
import urllib.error
import urllib.parse
import urllib.request
from typing import Any, Dict, Iterable, Iterator, List, Mapping, Optional, Sequence, Union

Value = Union[float, int, str]
Values = Mapping[str, Value]
System = Union[str, Mapping[str, Any]]
Answer = Dict[str, Any]

# Lines of a batch that go over HTTP at a time: few enough for a service's limits and its deadline.
LINES_AT_ONCE = 100
BYTES_AT_ONCE = 500_000

__all__ = ["Qdot", "Key", "Problem", "Unreachable"]


def _plain(value: Any) -> Any:
    """Arrays and numbers of other libraries, such as numpy's, as JSON has them; decimals and fractions as they are."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, (decimal.Decimal, fractions.Fraction)):
        return str(value)
    raise TypeError(f"a {type(value).__name__} has no place in a request")


class Problem(Exception):
    """The service refused a request, or could not compute it.

    >>> try:
    ...     Qdot("http://localhost:8080").modes("cart_pendulum", kk=10)
    ... except Problem as problem:
    ...     print(problem)
    422 The request does not fit the schema: 1 field is wrong.
      #/kk: There is no field 'kk'. Did you mean 'parameters.k'?
    """

    def __init__(self, document: Mapping[str, Any], retry_after: Optional[float] = None):
        self.document = dict(document)  #: the whole problem, RFC 9457
        self.retry_after = retry_after  #: seconds after which a service that is too busy may be asked again
        self.status: int = document.get("status", 0)
        self.title: str = document.get("title", "")
        self.detail: str = document.get("detail", "")
        self.errors: List[Dict[str, Any]] = document.get("errors", [])
        super().__init__("\n  ".join([f"{self.status} {self.title}: {self.detail}", *map(self._words, self.errors)]))

    @staticmethod
    def _words(error: Mapping[str, Any]) -> str:
        text = f"{error.get('pointer') or error.get('parameter')}: {error['detail']}"
        if error.get("did_you_mean"):
            return text + f" Did you mean '{error['did_you_mean']}'?"
        return text + (f" Write one of {', '.join(error['allowed'])}." if error.get("allowed") else "")


class Unreachable(ConnectionError):
    """Nothing answers there."""


class Qdot:
    """The service at an address, or the program `command`. `token`: for a service that was started with one."""

    def __init__(self, address: str = "http://localhost:8080", *, command: Optional[str] = None,
                 token: Optional[str] = None, timeout: float = 120):
        address = address if "://" in address else "http://" + address
        address = address.rstrip("/")
        self.address = address[:-len("/v1")] if address.endswith("/v1") else address
        self.command = command
        self.token = token
        self.timeout = timeout
        self._systems: Dict[str, Answer] = {}

    # What can be asked. None stands for a field that is left out.

    def simulate(self, system: System, *, parameters: Optional[Values] = None, initial: Optional[Values] = None,
                 inputs: Optional[Values] = None, t_start: Optional[Value] = None, t_end: Optional[Value] = None,
                 samples: Optional[int] = None, dt: Optional[Value] = None, times: Optional[Sequence[Value]] = None,
                 include: Optional[Sequence[str]] = None, events: Optional[Sequence[str]] = None,
                 on_invalid: Optional[str] = None, impacts: Optional[bool] = None, steps: Optional[int] = None,
                 method: Optional[str] = None, h: Optional[Value] = None, rtol: Optional[Value] = None,
                 atol: Optional[Value] = None, accuracy: Optional[str] = None, max_error: Optional[Value] = None,
                 max_evaluations: Optional[int] = None, verify: Optional[bool] = None,
                 precision: Optional[str] = None, digits: Optional[int] = None, **symbols: Value) -> Answer:
        """A motion: answer["trajectory"] has a list for t and for each coordinate and velocity.

        answer["accuracy"]["max_abs_error"] has the error of each column, over all rows.
        """
        return self._ask("simulate", locals())

    def equations(self, system: System, *, form: Optional[str] = None) -> Answer:
        """The equations of motion, derived; form: text, latex, mathml, sympy, maxima or c."""
        return self._ask("equations", locals())

    def energy(self, system: System, *, parameters: Optional[Values] = None, initial: Optional[Values] = None,
               inputs: Optional[Values] = None, t: Optional[Value] = None, digits: Optional[int] = None,
               **symbols: Value) -> Answer:
        """Energies, momenta, accelerations and reactions at a state."""
        return self._ask("energy", locals())

    def modes(self, system: System, *, parameters: Optional[Values] = None, equilibrium: Optional[Values] = None,
              initial: Optional[Values] = None, inputs: Optional[Values] = None, digits: Optional[int] = None,
              **symbols: Value) -> Answer:
        """Natural frequencies and mode shapes at an equilibrium: answer["modes"], ascending omega."""
        return self._ask("modes", locals())

    def equilibria(self, system: System, *, parameters: Optional[Values] = None, initial: Optional[Values] = None,
                   inputs: Optional[Values] = None, solve_for: Optional[str] = None, at: Optional[Values] = None,
                   digits: Optional[int] = None, **symbols: Value) -> Answer:
        """All equilibria with their stability; or the parameter solve_for that makes the position `at` one.

        >>> Qdot().equilibria("rotating_l_bar", solve_for="Omega", at={"theta": "30deg"})["Omega"]
        4.855906243855786
        """
        return self._ask("equilibria", locals())

    def turning_points(self, system: System, *, parameters: Optional[Values] = None,
                       initial: Optional[Values] = None, inputs: Optional[Values] = None,
                       coordinate: Optional[str] = None, t_start: Optional[Value] = None,
                       t_end: Optional[Value] = None, on_invalid: Optional[str] = None,
                       impacts: Optional[bool] = None, digits: Optional[int] = None, **symbols: Value) -> Answer:
        """How far a coordinate goes: theta_max and theta_min for the coordinate theta.

        >>> Qdot().turning_points("free_spin_pendulum")["theta_max_deg"]
        55.131909145890695
        """
        return self._ask("turning_points", locals())

    def bifurcations(self, system: System, *, parameter: str, from_: Value, to: Value,
                     parameters: Optional[Values] = None, initial: Optional[Values] = None,
                     inputs: Optional[Values] = None, digits: Optional[int] = None, **symbols: Value) -> Answer:
        """Critical values of a parameter between from_ and to, with the branches that meet there."""
        return self._ask("bifurcations", locals())

    def gait(self, system: System = "compass_walker", *, parameters: Optional[Values] = None,
             gait: Optional[str] = None, digits: Optional[int] = None, **symbols: Value) -> Answer:
        """Periodic gaits of a walker."""
        return self._ask("gait", locals())

    def accuracy(self, system: System, *, parameters: Optional[Values] = None, initial: Optional[Values] = None,
                 inputs: Optional[Values] = None, t_start: Optional[Value] = None, t_end: Optional[Value] = None,
                 samples: Optional[int] = None, dt: Optional[Value] = None, times: Optional[Sequence[Value]] = None,
                 impacts: Optional[bool] = None, methods: Optional[Sequence[str]] = None,
                 max_error: Optional[Value] = None, measure: Optional[bool] = None, digits: Optional[int] = None,
                 **symbols: Value) -> Answer:
        """The measured trade of error against work for one motion."""
        return self._ask("accuracy", locals())

    def check(self, items: Sequence[Mapping[str, Any]], *, seed: Optional[int] = None,
              reveal: Optional[bool] = None) -> Answer:
        """Grades submissions: each item has what is expected and what was submitted.

        >>> Qdot().check([{"id": "1", "expect": {"turning_points": {"system": "free_spin_pendulum"}, "at": "/theta_max"},
        ...                "submitted": "55.1deg"}])["items"][0]["correct"]
        True
        """
        return self._ask("check", locals())

    def sweep(self, ask: Mapping[str, Any], *, vary: Union[str, Mapping[str, Any]],
              collect: Union[str, Sequence[str], Mapping[str, str]], from_: Optional[Value] = None,
              to: Optional[Value] = None, count: Optional[int] = None, spacing: Optional[str] = None,
              values: Optional[Sequence[Value]] = None, uniform: Optional[Sequence[Value]] = None,
              normal: Optional[Sequence[Value]] = None, seed: Optional[int] = None) -> Answer:
        """One question over a grid or a sample of parameters and initial values: answer["columns"] has a list for each.

        >>> swept = Qdot().sweep({"modes": {"system": "cart_pendulum"}}, vary="k", from_=10, to=30, count=3,
        ...                      collect={"slow": "/modes/0/omega"})
        >>> swept["columns"]
        {'k': [10.0, 20.0, 30.0], 'slow': [2.4525697096160592, 3.2597023678301, 3.7303818285192216]}
        """
        return self._ask("sweep", locals())

    def batch(self, lines: Iterable[Mapping[str, Any]]) -> Iterator[Answer]:
        """Many requests, each {"id": 1, "modes": {...}}: their answers, {"id": 1, "status": 200, "answer": {...}}, in order.

        Both are read one by one, so that a million of them take no memory. A wrong one is answered by its problem and
        spoils no other. A service that is too busy is asked again when it says so, for as long as `timeout`.

        >>> questions = ({"id": k, "modes": {"system": "cart_pendulum", "parameters": {"k": k}}} for k in (10, -1))
        >>> [(line["id"], line["status"]) for line in Qdot().batch(questions)]
        [(10, 200), (-1, 422)]
        """
        texts = (json.dumps(line, allow_nan=False).encode() + b"\n" for line in lines)
        return self._run_batch(texts) if self.command else self._send_batch(texts)

    # What there is.

    def systems(self, name: Optional[str] = None) -> Answer:
        """All systems, or one: its parameters and coordinates with units, defaults and meanings.

        >>> [p["name"] for p in Qdot().systems("cart_pendulum")["parameters"]]
        ['M', 'm', 'k', 'l', 'g']
        """
        return self._read("systems", name)

    def problems(self, number: Optional[int] = None) -> Answer:
        """The practice sheet, or one of its problems with questions, requests and answers."""
        return self._read("problems", number)

    def ask(self, endpoint: str, request: Mapping[str, Any]) -> Answer:
        """Any endpoint with a request in its JSON form: ask("modes", {"system": "cart_pendulum"})."""
        body = json.dumps(request, allow_nan=False, default=_plain)
        if self.command:
            return self._run(endpoint, "--request", "-", body=body)
        return self._send("/v1/" + urllib.parse.quote(endpoint), body)

    def __getattr__(self, name: str) -> Any:
        """A question of the service that has no method here, such as one of a later version: its fields are as there."""
        if name.startswith("_"):
            raise AttributeError(f"Qdot has no {name}")
        endpoints = self._endpoints()
        if name in endpoints:
            return functools.partial(self._question, name)
        known = endpoints + [word for word in dir(type(self)) if not word.startswith("_") and word not in endpoints]
        near = difflib.get_close_matches(name, known, 1)
        advice = f"did you mean {near[0]}?" if near else "there are " + ", ".join(known)
        raise AttributeError(f"Qdot has no {name}: {advice}")

    # How it is asked.

    def _endpoints(self) -> List[str]:
        """What can be asked of the service, by its own description; nothing where none answers."""
        try:
            paths = (self._run("openapi") if self.command else json.loads(self._fetch("/openapi.json", None, "")))["paths"]
        except (Problem, OSError):
            return []
        return [path[len("/v1/"):] for path, methods in paths.items() if "post" in methods and "." not in path]

    def _question(self, endpoint: str, system: System, *, parameters: Optional[Values] = None,
                  initial: Optional[Values] = None, inputs: Optional[Values] = None, **symbols: Any) -> Answer:
        return self._ask(endpoint, {"system": system, "parameters": parameters, "initial": initial, "inputs": inputs,
                                    "symbols": {name.rstrip("_"): value for name, value in symbols.items()}})

    def _ask(self, endpoint: str, arguments: Dict[str, Any]) -> Answer:
        symbols = arguments.pop("symbols", {})
        request = {name.rstrip("_"): value for name, value in arguments.items() if name != "self" and value is not None}
        for name, value in symbols.items():
            place = self._place_of(name, request["system"])
            if place is None:
                request[name] = value  # the service says what is wrong with it
            else:
                request[place] = {**request.get(place, {}), name: value}
        return self.ask(endpoint, request)

    def _place_of(self, name: str, system: System) -> Optional[str]:
        """Where a request has the system's symbol of this name: "parameters", "initial" or "inputs"."""
        scene = system
        if isinstance(system, str):
            if system not in self._systems:
                try:
                    self._systems[system] = self.systems(system)
                except Problem:
                    return None  # there is no such system, which the question itself will say better
            scene = self._systems[system]
        assert isinstance(scene, Mapping)
        coordinates = [entry["name"] for entry in scene.get("coordinates", [])]
        if name in coordinates or name in [coordinate + "_dot" for coordinate in coordinates]:
            return "initial"
        for place in ("parameters", "inputs"):
            if name in [entry["name"] for entry in scene.get(place, [])]:
                return place
        return None

    def _read(self, kind: str, name: Union[str, int, None]) -> Answer:
        if self.command:
            return self._run(kind, *([] if name is None else [str(name)]))
        path = f"/v1/{kind}" + ("" if name is None else "/" + urllib.parse.quote(str(name), safe=""))
        return self._send(path, None)

    def _send(self, path: str, body: Optional[str]) -> Answer:
        return json.loads(self._fetch(path, None if body is None else body.encode(), "application/json"))

    def _fetch(self, path: str, body: Optional[bytes], content_type: str) -> bytes:
        headers = {"Content-Type": content_type}
        if self.token:
            headers["Authorization"] = "Bearer " + self.token
        request = urllib.request.Request(self.address + path, body, headers)
        try:
            with urllib.request.urlopen(request, timeout=self.timeout) as response:
                return response.read()
        except urllib.error.HTTPError as error:
            wait = error.headers.get("Retry-After")
            raise Problem(self._document(error.read(), error.code), float(wait) if wait else None) from None
        except urllib.error.URLError as error:
            raise Unreachable(f"No qdot answers at {self.address} ({error.reason}); start one with: qdot serve") from None

    def _run(self, *words: str, body: str = "") -> Answer:
        assert self.command
        run = subprocess.run([self.command, *words], input=body.encode(), capture_output=True, timeout=self.timeout,
                             check=False)
        if run.returncode == 0:
            return json.loads(run.stdout)
        raise Problem(self._document(run.stderr, 0))

    # Many lines.

    def _send_batch(self, lines: Iterable[bytes]) -> Iterator[Answer]:
        portion: List[bytes] = []
        size = 0
        for line in lines:
            if portion and (len(portion) == LINES_AT_ONCE or size + len(line) > BYTES_AT_ONCE):
                yield from self._answers(portion)
                portion, size = [], 0
            portion.append(line)
            size += len(line)
        if portion:
            yield from self._answers(portion)

    def _answers(self, portion: List[bytes]) -> Iterator[Answer]:
        """Of lines that go together. What is too much for the service at once is asked in two parts."""
        try:
            text = self._when_there_is_room(b"".join(portion))
        except Problem as problem:
            if problem.status not in (413, 422, 503):
                raise
            if len(portion) == 1:
                yield {"id": json.loads(portion[0]).get("id"), "status": problem.status, "answer": problem.document}
                return
            half = len(portion) // 2
            yield from self._answers(portion[:half])
            yield from self._answers(portion[half:])
            return
        for number, line in enumerate(text.splitlines()):
            answer = json.loads(line)
            if number > 0 and answer["status"] == 422 and answer["answer"]["instance"] == "/v1/batch" \
                    and answer["answer"]["type"] == "/errors/limit-exceeded":  # enough answers: the rest apart
                yield from self._answers(portion[number:])
                return
            yield answer

    def _when_there_is_room(self, lines: bytes) -> bytes:
        last = time.monotonic() + self.timeout
        while True:
            try:
                return self._fetch("/v1/batch", lines, "application/x-ndjson")
            except Problem as problem:
                took_too_long = problem.document.get("type") == "/errors/deadline"
                if took_too_long or problem.retry_after is None or time.monotonic() + problem.retry_after > last:
                    raise
                time.sleep(problem.retry_after)

    def _run_batch(self, lines: Iterable[bytes]) -> Iterator[Answer]:
        assert self.command
        failures: List[BaseException] = []

        def feed(pipe: Any) -> None:
            try:
                with pipe:
                    for line in lines:
                        pipe.write(line)
            except BrokenPipeError:
                pass  # its exit code says why
            except BaseException as failure:  # of the caller's own iterator
                failures.append(failure)

        with subprocess.Popen([self.command, "batch"], stdin=subprocess.PIPE, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE) as process:
            assert process.stdout and process.stderr
            feeder = threading.Thread(target=feed, args=(process.stdin,), daemon=True)
            process.stdin = None  # the thread's own from now on
            feeder.start()
            try:
                for answer in process.stdout:
                    yield json.loads(answer)
                said = process.stderr.read()
                if process.wait() != 0:
                    raise Problem(self._document(said, 0))
                feeder.join()
            finally:
                process.kill()  # of no effect when it has ended
        if failures:
            raise failures[0]

    @staticmethod
    def _document(text: bytes, status: int) -> Answer:
        try:
            document = json.loads(text)
        except ValueError:
            return {"status": status, "title": "no problem document", "detail": text.decode("utf-8", "replace")[:500]}
        return document if isinstance(document, dict) else {"status": status, "detail": str(document)}


class Key:
    """A key file, a check without what was submitted. It asks the program beside this file, as a bundle has it; or `qdot`.

    >>> import tempfile
    >>> with tempfile.NamedTemporaryFile("w", suffix=".json") as file:
    ...     _ = file.write('''{"items": [
    ...       {"id": "q1", "expect": {"turning_points": {"system": "free_spin_pendulum"}, "at": "/theta_max"}}]}''')
    ...     file.flush()
    ...     key = Key(file.name, Qdot())
    >>> key.grade("q1", "55.1deg")["correct"]
    True
    >>> key.assert_right("q1", "-55.1deg")
    Traceback (most recent call last):
    AssertionError: q1 is not right. The sign is wrong.
    """

    def __init__(self, file: Union[str, "os.PathLike[str]"], qdot: Optional[Qdot] = None):
        with open(file, encoding="utf-8") as text:
            self._key: Dict[str, Any] = json.load(text)
        self._key.pop("variant", None)  # the numbers that were drawn are in the items, too
        if "ranges" in self._key:
            raise ValueError("The key has ranges: draw a variant of it first, qdot variant KEY --seed 1.")
        beside = os.path.join(os.path.dirname(os.path.abspath(__file__)), "qdot")
        self._qdot = qdot or Qdot(command=beside if os.access(beside, os.X_OK) else "qdot")

    @property
    def items(self) -> List[str]:
        return [item["id"] for item in self._key["items"]]

    def points(self, item: str) -> float:
        """What a right answer to an item earns."""
        return self._item(item).get("points", 1)

    def grade(self, item: str, submitted: Any) -> Answer:
        """What check says of one answer: `correct` is True, False or None, where it has no verdict."""
        request = {**self._key, "items": [{**self._item(item), "submitted": self._plain(submitted)}], "format": "json"}
        return self._qdot.ask("check", request)["items"][0]

    def assert_right(self, item: str, submitted: Any) -> None:
        """Raises an AssertionError that says what is said of the answer where it is not right."""
        graded = self.grade(item, submitted)
        if graded["correct"] is True:
            return
        said = graded["format_errors"] + graded["feedback"]
        if graded["diagnosis"]:
            said.append(graded["diagnosis"]["text"])
        verdict = "is not right." if graded["correct"] is False else "cannot be graded."
        raise AssertionError(" ".join([item, verdict, *said]))

    def _item(self, name: str) -> Dict[str, Any]:
        for item in self._key["items"]:
            if item["id"] == name:
                return item
        raise KeyError(f"the key has no item {name}, only {', '.join(self.items)}")

    def _plain(self, value: Any) -> Any:
        """As JSON has it: numbers and lists of them also where they are another library's, everything else as text."""
        if hasattr(value, "tolist"):
            value = value.tolist()
        if isinstance(value, (list, tuple)):
            return [self._plain(entry) for entry in value]
        if isinstance(value, Mapping):
            return {str(name): self._plain(entry) for name, entry in value.items()}
        is_number = isinstance(value, int) or isinstance(value, float) and math.isfinite(value)
        return value if is_number else str(value)
