"""The formulas of rates that coincide and of more coordinates than two: triangles and rings of equal masses, the factors of
a determinant, and places that only the scene's start tells; numbers against SymPy's exact eigenvalues."""

import pathlib
import sys
import unittest

import sympy

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian, particle, scene  # noqa: E402

CORNERS = [("x1", "y1", "0", "0"), ("x2", "y2", "l", "0"), ("x3", "y3", "l/2", "sqrt(3)*l/2")]


def side(a, b):
    return {"stiffness": "k", "rest_length": "l", "length": f"sqrt(({a[0]} - {b[0]})^2 + ({a[1]} - {b[1]})^2)"}


def triangle():
    places = "; ".join(f"{x} m {x0}; {y} m {y0}" for x, y, x0, y0 in CORNERS)
    return scene("triangle", "m kg 2; k N/m 3; l m 1.3", places, bodies=[particle("m", x, y) for x, y, _, _ in CORNERS],
                 springs=[side(CORNERS[i], CORNERS[j]) for i, j in ((0, 1), (1, 2), (0, 2))])


def several(potential, parameters="m - 1; k - 4; c - 3"):
    return lagrangian("several", parameters, "x -; y -; z -", f"m*(x_dot^2 + y_dot^2 + z_dot^2)/2 - {potential}")


class MultipleRates(Service):
    def texts(self, asked, **request):
        return [mode["exact"]["text"] if "exact" in mode else None
                for mode in self.ask("modes", {"system": asked, **request})["modes"]]

    def test_a_triangle_of_equal_masses_and_springs(self):
        answer = self.ask("modes", {"system": triangle()})
        self.assertEqual([mode["exact"]["text"] for mode in answer["modes"] if "exact" in mode],
                         ["3*k/(2*m)", "3*k/(2*m)", "3*k/m"])
        self.assertEqual({name: one["text"] for name, one in answer["equilibrium"]["exact"].items()},
                         {"x2": "l", "x3": "1/2*l", "y3": "1/2*sqrt(3)*l"})
        other = self.texts(triangle(), parameters={"m": 0.37, "k": 11.3, "l": 0.291})
        self.assertEqual(other[3:], ["3*k/(2*m)", "3*k/(2*m)", "3*k/m"])

    def test_a_spring_that_ties_all_leaves_two_alike(self):
        self.assertEqual(self.texts(several("c*(x^2 + y^2 + z^2)/2 - k*(x + 2*y + 3*z)^2/2")), ["c/m", "c/m", "(14*k + c)/m"])

    def test_a_mode_that_a_spring_does_not_touch(self):
        self.assertEqual(self.texts(several("c*(x^2 + y^2 + z^2)/2 - k*(x + 2*y)^2/2 - k*(x + 2*y + z)^2/2"))[0], "c/m")

    def test_shapes_solve_the_equations(self):
        answer = self.ask("modes", {"system": several("c*(x^2 + y^2 + z^2)/2 - k*(x + 2*y)^2/2 - k*(x + 2*y + z)^2/2")})
        k, c, m = sympy.symbols("k c m")
        matrix = c * sympy.eye(3) + k * sympy.Matrix([[2, 4, 1], [4, 8, 2], [1, 2, 1]])
        self.assertEqual(len(answer["modes"]), 3)
        for mode in answer["modes"]:
            shape = sympy.Matrix([sympy.sympify(mode["exact"]["shape"][name]["text"].replace("^", "**")) for name in "xyz"])
            square = sympy.sympify(mode["exact"]["text"].replace("^", "**"))
            self.assertEqual(sympy.simplify(matrix * shape - m * square * shape), sympy.zeros(3, 1))

    def test_ions_in_a_trap_mirror_each_other(self):
        """James, Appl. Phys. B 66 (1998): omega^2 = 1, 3 and 29/5 times that of the trap."""
        for count, squares in ((2, ["w^2", "3*w^2"]), (3, ["w^2", "3*w^2", "29/5*w^2"])):
            names = [f"x{i + 1}" for i in range(count)]
            kinetic = " + ".join(f"{name}_dot^2" for name in names)
            repulsion = " - ".join(f"K/({b} - {a})" for i, a in enumerate(names) for b in names[i + 1:])
            ions = lagrangian("ions", "m - 1; w - 2; K - 3", "; ".join(f"{x} - {i - (count - 1)/2}" for i, x in enumerate(names)),
                              f"m*({kinetic})/2 - m*w^2*({kinetic.replace('_dot', '')})/2 - {repulsion}")
            answer = self.ask("modes", {"system": ions})
            self.assertEqual([mode["exact"]["text"] for mode in answer["modes"]], squares)
            values = {"K": 3, "m": 1, "w": 2}
            for name in (names[0], names[-1]):
                text = answer["equilibrium"]["exact"][name]["text"].replace("^", "**")
                self.assertAlmostEqual(eval(text, dict(values)), answer["equilibrium"]["state"][name], 12)

    def test_five_masses_between_walls(self):
        names = [f"q{i}" for i in range(5)]
        potential = " + ".join(["q0^2", "q4^2"] + [f"({b} - {a})^2" for a, b in zip(names, names[1:])])
        chain = lagrangian("chain", "m - 2; k - 3", "; ".join(f"{q} -" for q in names),
                           f"m*({' + '.join(f'{q}_dot^2' for q in names)})/2 - k*({potential})/2")
        self.assertEqual(self.texts(chain), ["(2 - sqrt(3))*k/m", "k/m", "2*k/m", "3*k/m", "(2 + sqrt(3))*k/m"])

    def test_a_pendulum_under_a_constant_torque(self):
        pulled = scene("pulled", "m kg 1; l m 0.5; tau N*m 2; g m/s^2 9.81", "th rad 0.1", gravity=["0", "-g"],
                       bodies=[particle("m", "l*sin(th)", "-l*cos(th)")], forces=[{"value": "tau", "along": "th"}])
        low = self.ask("modes", {"system": pulled})
        self.assertEqual(low["equilibrium"]["exact"]["th"]["text"], "asin(tau/(m*l*g))")
        self.assertEqual(low["modes"][0]["exact"]["text"], "g*sqrt(1 - tau^2/(m^2*l^2*g^2))/l")
        high = self.ask("modes", {"system": pulled, "equilibrium": {"th": 2.7}})
        self.assertEqual(high["modes"][0]["exact"]["of"], "rate^2")
        self.assertEqual(high["modes"][0]["exact"]["text"], low["modes"][0]["exact"]["text"])


if __name__ == "__main__":
    unittest.main()
