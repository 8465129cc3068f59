"""The mechanics of a scene, derived from its file by SymPy alone."""

import numpy
import sympy
from sympy.physics.mechanics import LagrangesMethod, ReferenceFrame, dynamicsymbols

T = dynamicsymbols._t


def names_of(scene):
    return [q["name"] for q in scene["coordinates"]]


class BySympy:
    """L and the accelerations of a scene, derived from its file by SymPy alone."""

    def __init__(self, scene):
        self.scene = scene
        self.q = [dynamicsymbols(name) for name in names_of(scene)]
        self.rates = [q.diff(T) for q in self.q]
        self.parameters = {p["name"]: sympy.Symbol(p["name"], positive=True) for p in scene.get("parameters", [])}
        self.words = {name: q for name, q in zip(names_of(scene), self.q)}
        self.words |= {name + "_dot": v for name, v in zip(names_of(scene), self.rates)} | self.parameters | {"t": T}
        self.words |= {held["name"]: self.read(held["value"]) for held in scene.get("held_lengths", [])}
        self.points = {p["name"]: self.vector(p["components"]) for p in scene.get("points", [])}
        self.lagrangian = self.read(scene["lagrangian"]) if "lagrangian" in scene else self.kinetic() - self.potential()

    def read(self, text):
        return sympy.sympify(text.replace("^", "**"), locals=self.words, rational=True)

    def vector(self, components):
        return sympy.Matrix([self.read(text) for text in components])

    def place(self, position):
        return self.points[position] if isinstance(position, str) else self.vector(position)

    def kinetic(self):
        total = 0
        for body in self.scene["bodies"]:
            mass = self.read(body["mass"])
            if body["kind"] == "particle":
                v = self.place(body["position"]).diff(T)
                total += mass / 2 * v.dot(v)
            elif body["kind"] == "rod":
                a, b = self.place(body["start"]).diff(T), self.place(body["end"]).diff(T)
                total += mass / 6 * (a.dot(a) + a.dot(b) + b.dot(b))
            elif "orientation" in body:
                v, turn = self.place(body["centre"]).diff(T), self.angular_velocity(body["orientation"])
                moments = [self.read(moment) for moment in self.moments(body)]
                total += mass / 2 * v.dot(v) + sum(moment / 2 * w**2 for moment, w in zip(moments, turn))
            else:
                v, turn = self.place(body["centre"]).diff(T), self.read(body["angle"]).diff(T)
                total += mass / 2 * v.dot(v) + mass * self.read(body["radius"])**2 / 4 * turn**2
        return total

    def angular_velocity(self, orientation):
        """In the axes of the body, by SymPy's frames."""
        space = ReferenceFrame("N")
        frame = space
        for k, (letter, angle) in enumerate(zip(orientation["sequence"], orientation["angles"])):
            frame = frame.orientnew(f"B{k}", "Axis", [self.read(angle), getattr(frame, letter.lower())])
        return frame.ang_vel_in(space).to_matrix(frame)

    @staticmethod
    def moments(body):
        if body["kind"] in ("ring", "disk"):
            about_axis = f"({body['mass']})*({body['radius']})^2" + ("" if body["kind"] == "ring" else "/2")
            return [f"{about_axis}/2", f"{about_axis}/2", about_axis]
        return body["principal_moments"]

    def potential(self):
        total = self.read(self.scene.get("potential", "0"))
        for spring in self.scene.get("springs", []):
            total += self.read(spring["stiffness"]) / 2 * (self.read(spring["length"]) - self.read(spring["rest_length"]))**2
        for body in self.scene["bodies"]:
            if "gravity" in self.scene:
                ends = [body[key] for key in ("position", "centre", "start", "end") if key in body]
                middle = sum((self.place(end) for end in ends), sympy.zeros(len(self.scene["gravity"]), 1)) / len(ends)
                total -= self.read(body["mass"]) * middle.dot(self.vector(self.scene["gravity"]))
        return total

    def method(self):
        constraints = [self.read(c["expression"]) for c in self.scene.get("constraints", [])]
        moving = [c for c in constraints if c.has(*self.rates)]
        still = [c for c in constraints if not c.has(*self.rates)]
        method = LagrangesMethod(self.lagrangian, self.q, hol_coneqs=still, nonhol_coneqs=moving)
        method.form_lagranges_equations()
        return method

    def function(self, expressions):
        plain = {v: sympy.Symbol(n + "_dot") for n, v in zip(names_of(self.scene), self.rates)}
        places = {q: sympy.Symbol(n) for n, q in zip(names_of(self.scene), self.q)}
        arguments = [*places.values(), *plain.values(), *self.parameters.values(), T]
        return sympy.lambdify(arguments, [e.subs(plain).subs(places) for e in expressions], "numpy")

    def accelerations(self, state, parameters):
        method = self.method()
        matrices = self.function([method.mass_matrix_full, method.forcing_full])
        matrix, forcing = matrices(*state, *parameters, 0.0)
        n = len(self.q)
        return numpy.linalg.solve(numpy.array(matrix, float), numpy.array(forcing, float)).ravel()[n:2 * n]

    def balance(self):
        """h, its rate -dL/dt where the time stands in L, and L, which says how large energies are."""
        jacobi = sum(v * self.lagrangian.diff(v) for v in self.rates) - self.lagrangian
        frozen = {v: sympy.Symbol(f"v{i}") for i, v in enumerate(self.rates)}
        still = {q: sympy.Symbol(f"q{i}") for i, q in enumerate(self.q)}
        explicit = self.lagrangian.subs(frozen).subs(still).diff(T)
        back = {value: key for key, value in (frozen | still).items()}
        return self.function([jacobi, -explicit.subs(back), self.lagrangian])
