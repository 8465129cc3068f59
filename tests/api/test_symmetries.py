"""Symmetries that are found: their quantities stay constant along motions, planted ones are among them, and none is
claimed that is not one."""

import json
import math
import os
import random
import subprocess
import sys
import unittest

import mpmath
import numpy

QDOT = os.environ["QDOT_BINARY"]
SCENES = 500
ROUNDING = 1e-9  # of the sizes that enter a quantity: rtol 1e-13, over some hundred steps


def bare(lagrangian, coordinates, **parameters):
    """A Lagrangian as a textbook prints it; coordinates are names, or names with their starts."""
    starts = {q: (0.3 + 0.1 * i, 0.2 - 0.1 * i) for i, q in enumerate(coordinates)} if isinstance(coordinates, (str, list)) else coordinates
    return {"name": "scene", "units": "none", "lagrangian": lagrangian,
            "parameters": [{"name": name, "default": value} for name, value in parameters.items()],
            "coordinates": [{"name": q, "initial": a, "initial_rate": b} for q, (a, b) in starts.items()]}


def bodies(coordinates, positions, gravity=None, **more):
    dimension = len(positions[0])
    scene = {"name": "scene",
             "parameters": [{"name": n, "unit": u, "default": v} for n, u, v in
                            [("m", "kg", "2"), ("k", "N/m", "3"), ("l", "m", "1"), ("g", "m/s^2", "9.81")]],
             "coordinates": [{"name": q, "unit": unit, "initial": 0.4 + 0.1 * i} for i, (q, unit) in enumerate(coordinates.items())],
             "bodies": [{"kind": "particle", "mass": "m", "position": p} for p in positions], **more}
    if gravity:
        scene["gravity"] = ["0"] * (dimension - 1) + ["-g"]
    return scene


def asked(lines):
    """The answers of `qdot batch` to requests, in order."""
    text = "".join(json.dumps({"id": i, **line}) + "\n" for i, line in enumerate(lines))
    run = subprocess.run([QDOT, "batch"], input=text, capture_output=True, text=True, timeout=280)
    return [json.loads(line) for line in run.stdout.splitlines()]


def conserved(scene):
    (line,) = asked([{"equations": {"system": scene}}])
    assert line["status"] == 200, line
    return {one["name"]: one for one in line["answer"]["conserved"]}


FUNCTIONS = {name: getattr(math, name) for name in ("sin", "cos", "tan", "exp", "log", "sqrt", "atan", "pi")}


def value(text, names):
    return eval(text.replace("^", "**"), {"__builtins__": {}}, FUNCTIONS | names)  # noqa: S307  (our own answer)


class Said(unittest.TestCase):
    """What `why` says is constant is the quantity itself, with the momenta of the same answer."""

    LAGRANGIANS = {
        "a*x_dot*x^2 - a*y^2": "xy", "a*(x*y_dot + y*x_dot) - y^2": "xy", "k*x_dot*cos(w*t) + a*x_dot*x^2": "xy",
        "a*x_dot*y_dot*0 + k*(x*y_dot - y*x_dot) - y^2": "xy", "a*x_dot*exp(x) - k*(x - y)^2": "xy",
        "a*(x_dot*y + x*y_dot)*cos(x*y) - k*(x^2 + y^2)": "xy", "a*x*x_dot*t + a*x^2/2 - k*x": "x",
    }

    def test_it_is_the_momentum_of_all_of_the_lagrangian_less_what_total_derivatives_leave(self):
        said = 0
        for part, names in self.LAGRANGIANS.items():
            kinetic = " + ".join(f"m*{q}_dot^2/2" for q in names)
            (line,) = asked([{"equations": {"system": bare(f"{kinetic} + {part}", list(names), m=1.5, a=0.7, k=1.3, w=2.1)}}])
            self.assertEqual(line["status"], 200, line)
            at = {"m": 1.5, "a": 0.7, "k": 1.3, "w": 2.1, "t": 0.37, "x": 0.4, "x_dot": 0.2, "y": -0.6, "y_dot": 1.1}
            at |= {p: value(one, at) for p, one in line["answer"]["momenta"].items()}
            for one in line["answer"]["conserved"]:
                if "is constant" not in one["why"] or "ignorable" in one["why"] or "h = sum" in one["why"]:
                    continue
                formula = one["why"].split(", so ")[1].split(" is constant")[0].split(", ")[-1].rstrip(",")
                at["h"] = value("m*x_dot^2/2 + m*y_dot^2/2", at)
                self.assertAlmostEqual(value(formula, at), value(one["value"], at), 12, (part, one))
                said += 1
        self.assertGreater(said, 8)


class Named(unittest.TestCase):
    def check(self, scene, expected):
        found = conserved(scene)
        self.assertEqual({name: found[name]["value"] for name in expected if name in found}, expected, found)
        return found

    def test_a_knife_edge_keeps_the_momentum_along_its_blade_wherever_that_points(self):
        knife = bare("m*(x_dot^2 + y_dot^2)/2 + k*th_dot^2/2", {"x": (0, 1), "y": (0, 0), "th": (0, 0.3)}, m=1, k=2)
        knife["constraints"] = [{"name": "edge", "expression": "x_dot*sin(th) - y_dot*cos(th)"}]
        self.check(knife, {"momentum_x_y": "m*(x_dot*cos(th) + y_dot*sin(th))"})
        (line,) = asked([{"energy": {"system": knife}}])
        told = {one["name"]: one["value"] for one in line["answer"]["conserved"]}
        self.assertEqual(told["momentum_x_y"], 1)

    def test_a_uniform_force_of_the_time_leaves_a_momentum(self):
        """d/dt of the quantity along x'' = g(t)/m, by differences of 40 digits; in L and beside it, as a course writes a push."""
        functions = {f: getattr(mpmath, f) for f in ("sin", "cos", "exp", "log", "sqrt", "cosh", "sinh", "atan")}
        for force, names in (("sin(w*t)", 2), ("cos(w*t + 1)", 2), ("exp(-w*t)", 2), ("t^2", 2), ("t", 2), ("1/(1 + t)", 2), ("sqrt(2 + w*t)", 1),
                             ("t*exp(-w*t)", 2), ("t^3*exp(-t/w)", 2), ("t*sin(w*t)", 2), ("sin(w*t)^2", 2), ("sin(w*t)^3", 2), ("sin(w*t)*cos(2*t)", 2),
                             ("exp(-t)*sin(w*t)", 2), ("t*exp(-w*t)*cos(2*t)^2", 2), ("(1 + cos(w*t))^2", 2), ("log(1 + t)", 2), ("cosh(w*t)", 2),
                             ("1/(1 + t^2)", 2), ("1/(1 + (t/w)^2)", 2), ("1 - exp(-t/w)", 2), ("atan(w*t)", 1)):
            push = [{"value": f"k*({force})", "along": "x"}]
            for found in (conserved(bare(f"m*x_dot^2/2 + k*x*({force})", "x", m=2, k=3, w="1.3")),
                          conserved(bare("m*x_dot^2/2", "x", m=2, k=3, w="1.3") | {"forces": push})):
                self.assertEqual([name for name in ("momentum_x", "boost_x") if name in found], ["momentum_x", "boost_x"][:names], force)
                constants = {"m": 2, "k": 3, "w": mpmath.mpf("1.3"), **functions}
                x = mpmath.odefun(lambda t, y: [y[1], 3*value(force, constants | {"t": t})/2], 0, [mpmath.mpf("0.4"), mpmath.mpf("0.2")])
                for name in ("momentum_x", "boost_x")[:names]:
                    along = [value(found[name]["value"], constants | {"t": t, "x": x(t)[0], "x_dot": x(t)[1]})
                             for t in (mpmath.mpf(0), mpmath.mpf("0.7"), mpmath.mpf("1.9"))]
                    for other in along[1:]:
                        self.assertLess(abs(other - along[0]), 1e-11, (name, found[name]))
        both = bare("m*(x_dot^2 + y_dot^2)/2 - k*(x - y)^2 + k*(x + y)*sin(t)", "xy", m=2, k=3)
        self.assertEqual(conserved(both)["momentum_x_y"]["value"], "m*(x_dot + y_dot) + 2*k*cos(t)")
        pushed = bare("m*(x_dot^2 + y_dot^2)/2 - k*(x - y)^2", "xy", m=2, k=3) | {"forces": [{"value": "k*sin(t)^2", "along": "x"}]}
        self.assertEqual(conserved(pushed)["momentum_x_y"]["value"], "m*(x_dot + y_dot) + 1/4*k*(sin(2*t) - 2*t)")
        for driven in (bare("m*x_dot^2/2 - k*x^2 + a*x*sin(w*t)", "x", m=2, k=3, a=1, w=1.3),
                       bare("m*x_dot^2/2 - k*x^2", "x", m=2, k=3) | {"forces": [{"value": "sin(t)", "along": "x"}]},
                       bare("m*x_dot^2/2", "x", m=2, k=3) | {"forces": [{"value": "k*x*sin(t)", "along": "x"}]},
                       bare("m*x_dot^2/2", "x", m=2, k=3) | {"forces": [{"value": "k*exp(-t^2)", "along": "x"}]}):
            self.assertEqual(conserved(driven), {})

    def test_the_field_of_a_helix_keeps_a_screw_by_its_pitch(self):
        """Landau, Lifshitz, Mechanics, section 9, problem 3: M_z + P_z*h/(2*pi)."""
        self.check(bare("m*(r_dot^2 + r^2*ph_dot^2 + z_dot^2)/2 - a*r^2*cos(ph - 2*pi*z/h)", {"r": (1, 0), "ph": (0, 1), "z": (0, 0)}, m=1, h=2, a=1),
                   {"momentum_ph_z": "m*(h*z_dot + 2*pi*r^2*ph_dot)"})

    def test_a_central_force_keeps_angular_momentum_in_the_plane_and_in_space(self):
        self.check(bare("m/2*(x_dot^2 + y_dot^2) + k/sqrt(x^2 + y^2)", "xy", m=2, k=3),
                   {"angular_momentum_x_y": "m*(x*y_dot - y*x_dot)"})
        found = self.check(bare("m/2*(x_dot^2 + y_dot^2 + z_dot^2) + k/sqrt(x^2 + y^2 + z^2)", "xyz", m=2, k=3),
                           {"angular_momentum_x_y": "m*(x*y_dot - y*x_dot)", "angular_momentum_x_z": "m*(x*z_dot - z*x_dot)",
                            "angular_momentum_y_z": "m*(y*z_dot - z*y_dot)"})
        self.assertEqual(len(found), 4)  # and h

    def test_two_bodies_keep_momentum_centre_of_mass_and_angular_momentum(self):
        scene = bare("m1/2*(x1_dot^2 + y1_dot^2) + m2/2*(x2_dot^2 + y2_dot^2) + m1*m2/sqrt((x1 - x2)^2 + (y1 - y2)^2)",
                     ["x1", "y1", "x2", "y2"], m1=2, m2=3)
        found = self.check(scene, {"momentum_x1_x2": "m1*x1_dot + m2*x2_dot", "momentum_y1_y2": "m1*y1_dot + m2*y2_dot",
                           "boost_x1_x2": "t*(m1*x1_dot + m2*x2_dot) - m1*x1 - m2*x2",
                           "boost_y1_y2": "t*(m1*y1_dot + m2*y2_dot) - m1*y1 - m2*y2",
                           "angular_momentum_x1_y1_x2_y2": "m1*x1*y1_dot - m1*y1*x1_dot + m2*x2*y2_dot - m2*y2*x2_dot"})
        self.assertEqual(len(found), 6)  # and h; not the cross product of the total momentum and the centre of mass

    def test_bodies_that_fall_keep_what_they_have_about_their_centre(self):
        spring = {"stiffness": "k", "between": [["x", "y", "z"], ["u", "v", "w"]]}
        found = conserved(bodies({q: "m" for q in "xyzuvw"}, [["x", "y", "z"], ["u", "v", "w"]], gravity=["0", "0", "-g"], springs=[spring]))
        self.assertEqual([name for name in found if name.startswith(("angular", "symmetry"))],
                         ["angular_momentum_z", "angular_momentum_x_z_u_w", "angular_momentum_y_z_v_w"])

    def test_a_magnetic_field_needs_a_gauge(self):
        for lagrangian in ("q*B/2*(x*y_dot - y*x_dot)", "q*B*x*y_dot"):
            found = self.check(bare("m/2*(x_dot^2 + y_dot^2 + z_dot^2) + " + lagrangian, "xyz", m=2, q=1, B=3),
                               {"angular_momentum_x_y": "m*(x*y_dot - y*x_dot) + 1/2*q*B*(x^2 + y^2)",
                                "momentum_x": "m*x_dot - q*B*y"})
            self.assertIn("only by the time derivative of", found["momentum_x"]["why"])

    def test_a_screw_and_a_turning_potential(self):
        self.check(bare("(x_dot^2 + y_dot^2 + z_dot^2)/2 - cos(z/h - atan(y/x))", "xyz", h=2),
                   {"screw_x_y_z": "h*z_dot + x*y_dot - y*x_dot"})
        found = conserved(bare("(x_dot^2 + y_dot^2)/2 + 1/sqrt((x - a*cos(w*t))^2 + (y - a*sin(w*t))^2)", "xy", a=1, w=2))
        self.assertEqual(found["h_x_y"]["why"], "The small change dx = -w*y, dy = w*x and dt = 1 changes nothing, "
                                                "so w*y*p_x - w*x*p_y + h is constant.")
        self.assertEqual(list(found), ["h_x_y"])

    def test_an_integral_over_the_time_says_at_which_rates_it_is_none(self):
        for force, domain, end in (("sin(w*t)", "", "is constant where w is not zero."), ("sin(w*t)", "> 0", "is constant."), ("sin(3*t)", "", "is constant."),
                                   ("sin(w*t)*cos(2*t)", "> 0", "is constant where neither 2 + w nor w - 2 is zero.")):
            scene = bare(f"m*x_dot^2/2 + k*x*{force}/m", "x", m=2, k=3, w=1)
            if domain:
                scene["parameters"][2]["domain"] = domain
            self.assertTrue(conserved(scene)["momentum_x"]["why"].endswith(end), (force, conserved(scene)["momentum_x"]))

    def test_a_centre_elsewhere_is_in_the_parameters(self):
        self.check(bare("(x_dot^2 + y_dot^2)/2 - k*sqrt((x - a)^2 + (y - b)^2)", "xy", a=1, b=2, k=3),
                   {"angular_momentum_x_y": "x_dot*(b - y) + y_dot*(x - a)"})

    def test_bodies_in_space_have_axes(self):
        spring = [{"stiffness": "k", "length": "sqrt(x^2 + y^2 + z^2)", "rest_length": "l"}]
        hanging = bodies({"x": "m", "y": "m", "z": "m"}, [["x", "y", "z"]], gravity=True, springs=spring)
        found = self.check(hanging, {"angular_momentum_z": "m*(x*y_dot - y*x_dot)"})
        self.assertEqual(found["angular_momentum_z"]["why"],
                         "Turning the whole system about the z axis changes nothing, so the angular momentum about the z axis, "
                         "x*p_y - y*p_x, is constant.")
        self.assertNotIn("angular_momentum_x", found)
        (line,) = asked([{"energy": {"system": hanging, "parameters": {"g": 0}}}])
        names = [one["name"] for one in line["answer"]["conserved"]]
        self.assertEqual(sorted(names), ["angular_momentum_x", "angular_momentum_y", "angular_momentum_z", "energy"])
        self.assertEqual({one["unit"] for one in line["answer"]["conserved"][1:]}, {"kg*m^2/s"})

    def test_a_spring_pendulum_in_x_and_y_keeps_nothing_under_gravity(self):
        spring = [{"stiffness": "k", "length": "sqrt(x^2 + y^2)", "rest_length": "l"}]
        pendulum = bodies({"x": "m", "y": "m"}, [["x", "y"]], gravity=True, springs=spring)
        self.assertEqual(list(conserved(pendulum)), ["energy"])
        self.assertEqual(list(conserved({**pendulum, "gravity": ["0", "0"]})), ["energy", "angular_momentum"])

    def test_angles_that_turn_together(self):
        double = bodies({"a": "rad", "b": "rad"}, [["l*sin(a)", "-l*cos(a)"], ["l*(sin(a) + sin(b))", "-l*(cos(a) + cos(b))"]])
        found = conserved(double)
        self.assertEqual(list(found), ["energy", "angular_momentum"])
        self.assertIn("p_a + p_b", found["angular_momentum"]["why"])

    def test_forces_count_and_so_do_constraints(self):
        plane = bodies({"x": "m", "y": "m"}, [["x", "y"]])
        force = [{"vector": ["k*l", "0"], "point": ["x", "y"]}]
        self.assertNotIn("angular_momentum", conserved({**plane, "forces": force}))
        self.assertEqual(conserved({**plane, "forces": force})["momentum_x"]["value"], "m*x_dot - k*l*t")
        self.assertIn("angular_momentum", conserved({**plane, "constraints": [{"name": "rod", "expression": "x^2 + y^2 - l^2"}]}))
        self.assertNotIn("angular_momentum", conserved({**plane, "constraints": [{"name": "rod", "expression": "x^2 + 2*y^2 - l^2"}]}))
        friction = conserved({**plane, "dissipation": "k/2*1*(x_dot^2 + y_dot^2)*sqrt(l/g)"})
        self.assertNotIn("angular_momentum", friction)

    def test_what_rolls_is_turned_when_it_is_moved(self):
        """Rolling cart and block: what is constant is not their momentum, 3/2 M counts the turning disk."""
        wheel = {"kind": "disk", "mass": "m", "centre": ["x", "l"], "radius": "l", "angle": "-x/l"}
        cart = bodies({"x": "m", "y": "m"}, [["y", "l"]], springs=[{"stiffness": "k", "length": "y - x", "rest_length": "l"}])
        rolling = conserved({**cart, "bodies": [wheel, *cart["bodies"]]})
        self.assertEqual(rolling["momentum_x_y"]["why"], "Adding the same to x and y changes nothing, so p_x + p_y is constant.")
        self.assertFalse(any("whole system" in one["why"] for one in rolling.values()), rolling)
        sliding = conserved({**cart, "bodies": [{**wheel, "angle": "0"}, *cart["bodies"]]})
        self.assertIn("Moving the whole system along x", sliding["momentum_x"]["why"])
        around = conserved({**bodies({"x": "m", "y": "m", "a": "rad"}, [["x", "y"]]),
                            "bodies": [{**wheel, "centre": ["x", "y"], "angle": "a"}], "potential": "k*(x^2 + y^2)"})
        self.assertEqual(around["angular_momentum_x_y"]["why"], "The rotation dx = -y and dy = x changes nothing, so x*p_y - y*p_x is constant.")

    def test_the_practice_sheet_keeps_what_it_kept(self):
        (line,) = asked([{"equations": {"system": "whirling_pendulum"}}])
        self.assertEqual([one["name"] for one in line["answer"]["conserved"]], ["h"])
        (line,) = asked([{"energy": {"system": "rod_pendulum", "parameters": {"g": 0}}}])
        self.assertEqual([one["name"] for one in line["answer"]["conserved"]], ["energy", "angular_momentum"])

    def test_a_scene_that_is_too_large_says_so(self):
        names = [f"x{i}" for i in range(12)]
        terms = [f"({i} + sin({a})*cos(2*{b}) + {a}*{b})^2" for i, a in enumerate(names) for b in names[:6]]
        scene = bare(" + ".join(f"{q}_dot^2" for q in names) + " - (" + " + ".join(terms) + ")^2", names)
        (line,) = asked([{"equations": {"system": scene}}])
        self.assertIn(line["status"], (200, 422))


def twisted(lagrangian, names, draw):
    """x = R u + d with rational entries: the Lagrangian in u, and R and d."""
    n = len(names)
    while True:
        matrix = [[draw.randint(-3, 3) / draw.choice([1, 2, 4]) for _ in names] for _ in names]
        if abs(numpy.linalg.det(numpy.array(matrix))) > 0.5:
            break
    shift = [draw.randint(-2, 2) / 2 for _ in names]
    for i, name in sorted(enumerate(names), key=lambda pair: -len(pair[1])):
        rate = " + ".join(f"({matrix[i][j]})*u{j}_dot" for j in range(n))
        place = " + ".join(f"({matrix[i][j]})*u{j}" for j in range(n)) + f" + ({shift[i]})"
        lagrangian = lagrangian.replace(f"{name}_dot", f"({rate})").replace(name, f"({place})")
    return lagrangian, numpy.array(matrix), numpy.array(shift)


class Planted:
    """A Lagrangian in x with what it is known to keep, in coordinates u."""

    def __init__(self, seed):
        draw = random.Random(seed)
        self.values = {"A": draw.randint(1, 5), "K": draw.randint(1, 5) / 2}
        name, lagrangian, self.names, self.kept = draw.choice(KINDS)
        self.kind = name
        text, self.matrix, self.shift = twisted(lagrangian, self.names, draw)
        inverse = numpy.linalg.inv(self.matrix)
        start = [draw.uniform(0.6, 1.2) * (1 + i % 2) for i, _ in enumerate(self.names)]
        rates = [draw.uniform(-0.5, 0.5) for _ in self.names]
        u, u_dot = inverse @ (numpy.array(start) - self.shift), inverse @ numpy.array(rates)
        starts = {f"u{i}": (float(a), float(b)) for i, (a, b) in enumerate(zip(u, u_dot))}
        self.scene = bare(text, starts, **self.values)

    def planted(self, state, t):
        x = self.matrix @ numpy.array([state[f"u{i}"] for i, _ in enumerate(self.names)]) + self.shift
        v = self.matrix @ numpy.array([state[f"u{i}_dot"] for i, _ in enumerate(self.names)])
        return [kept(x, v, t, **self.values) for kept in self.kept]

    def random_state(self, draw):
        return {f"u{i}{rate}": draw.uniform(0.5, 1.5) for i, _ in enumerate(self.names) for rate in ("", "_dot")}


def turn(i, j, mass=lambda A, K: A):
    return lambda x, v, t, A, K: mass(A, K) * (x[i] * v[j] - x[j] * v[i])


# Names are X0 to X3, so that none is part of a function's or parameter's name; masses are A, or 1.
KINDS = [
    ("central in the plane", "A/2*(X0_dot^2 + X1_dot^2) - K*sqrt(X0^2 + X1^2)", ["X0", "X1"], [turn(0, 1)]),
    ("central in space", "A/2*(X0_dot^2 + X1_dot^2 + X2_dot^2) - K*sqrt(X0^2 + X1^2 + X2^2)", ["X0", "X1", "X2"],
     [turn(0, 1), turn(0, 2), turn(1, 2)]),
    ("about an axis", "A/2*(X0_dot^2 + X1_dot^2 + X2_dot^2) - K*sin(X2)*(X0^2 + X1^2)", ["X0", "X1", "X2"], [turn(0, 1)]),
    ("two on a line", "A/2*X0_dot^2 + X1_dot^2/2 - K*cos(X0 - X1)", ["X0", "X1"],
     [lambda x, v, t, A, K: A * v[0] + v[1], lambda x, v, t, A, K: t * (A * v[0] + v[1]) - A * x[0] - x[1]]),
    ("magnetic", "A/2*(X0_dot^2 + X1_dot^2) + K*X0*X1_dot", ["X0", "X1"],
     [lambda x, v, t, A, K: A * v[0] - K * x[1], lambda x, v, t, A, K: A * v[1] + K * x[0],
      lambda x, v, t, A, K: A * (x[0] * v[1] - x[1] * v[0]) + K / 2 * (x[0]**2 + x[1]**2)]),
    ("screw", "A/2*(X0_dot^2 + X1_dot^2 + X2_dot^2) - sin(X2/K - atan(X1/X0))", ["X0", "X1", "X2"],
     [lambda x, v, t, A, K: A * (x[0] * v[1] - x[1] * v[0] + K * v[2])]),
    ("turning", "A/2*(X0_dot^2 + X1_dot^2) - sin(X0*cos(K*t) + X1*sin(K*t))", ["X0", "X1"],
     [lambda x, v, t, A, K: A / 2 * (v[0]**2 + v[1]**2) + math.sin(x[0] * math.cos(K * t) + x[1] * math.sin(K * t))
      - K * A * (x[0] * v[1] - x[1] * v[0])]),
    ("falling", "A/2*(X0_dot^2 + X1_dot^2) - A*K*X1 - sin(X0)", ["X0", "X1"], [lambda x, v, t, A, K: v[1] + K * t]),
    ("nothing", "A/2*(X0_dot^2 + X1_dot^2) - X0^2 - K*X1^2 - X0^2*X1", ["X0", "X1"], []),
    ("nothing, in space", "A/2*(X0_dot^2 + X1_dot^2 + X2_dot^2) - X0^2*X1 - K*cos(X1*X2) - X2^2", ["X0", "X1", "X2"], []),
    ("nothing, with velocities", "A/2*X0_dot^2 + X1_dot^2/2 + X0*X0_dot*X1_dot/9 - X0^2 - sin(X1)", ["X0", "X1"], []),
    ("nothing, in time", "A/2*(X0_dot^2 + X1_dot^2) - X0*X1*cos(K*t) - sin(X0)", ["X0", "X1"], []),
]


def drift(text, trajectory, parameters):
    """How far a quantity changes over the rows, over the sizes of the terms that it is a sum of."""
    values, size = [], 1e-30
    for row in range(len(trajectory["t"])):
        names = {name: column[row] for name, column in trajectory.items()} | parameters
        values.append(value(text, names))
        size = max(size, abs(values[-1]), max(abs(x) for x in names.values())**2)
    return (max(values) - min(values)) / size


class Random(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.planted = [Planted(seed) for seed in range(SCENES)]
        equations = asked([{"equations": {"system": one.scene}} for one in cls.planted])
        motions = asked([{"simulate": {"system": one.scene, "t_end": 0.5, "samples": 5, "rtol": 1e-13, "atol": 1e-14,
                                       "verify": False, "include": []}} for one in cls.planted])
        cls.answers = [(line["answer"]["conserved"], motion["answer"]["trajectory"]) for line, motion in zip(equations, motions)]

    def test_what_is_claimed_stays_constant_along_motions(self):
        claimed = 0
        for one, (conserved, trajectory) in zip(self.planted, self.answers):
            for quantity in conserved:
                claimed += 1
                self.assertLess(drift(quantity["value"], trajectory, one.values), ROUNDING, (one.kind, one.scene, quantity))
        self.assertGreater(claimed, SCENES)

    def test_what_was_planted_is_found(self):
        """A planted quantity is a sum of those found, and a number."""
        for one, (conserved, _) in zip(self.planted, self.answers):
            draw = random.Random(1)
            rows, right = [], []
            for _ in range(3 * (len(conserved) + 2) + 6):
                state, t = one.random_state(draw), draw.uniform(-1, 1)
                names = state | one.values | {"t": t}
                try:
                    rows.append([value(quantity["value"], names) for quantity in conserved] + [1.0])
                    right.append(one.planted(state, t))
                except (ValueError, ZeroDivisionError):
                    continue
            if not one.kept:
                continue
            rows, right = numpy.array(rows), numpy.array(right)
            scale = numpy.abs(rows).max(axis=0) + 1e-300
            solution = numpy.linalg.lstsq(rows / scale, right, rcond=1e-13)[0]
            left_out = numpy.abs(rows / scale @ solution - right).max(axis=0) / (numpy.abs(right).max(axis=0) + 1e-300)
            self.assertLess(left_out.max(), 1e-7, (one.kind, one.scene, conserved))

    def test_nothing_is_found_where_nothing_was_planted(self):
        for one, (conserved, _) in zip(self.planted, self.answers):
            if one.kind.startswith("nothing"):
                self.assertLessEqual({quantity["name"] for quantity in conserved}, {"h"}, one.scene)

    def test_a_quantity_that_is_not_constant_would_be_seen(self):
        one, (_, trajectory) = next(pair for pair in zip(self.planted, self.answers) if pair[0].kind == "central in the plane")
        self.assertGreater(drift("u0_dot", trajectory, one.values), 1e-3)


if __name__ == "__main__":
    sys.exit(unittest.main())
