"""Messages that lead on: what a stranger writes wrong is explained so that the next try is right."""

import pathlib
import sys
import unittest

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402


class StrangersMistakes(Service):
    def first(self, text="x_dot^2/2 - x^2/2", **members):
        system = lagrangian("scene_of_a_stranger", "k - 1; g - 9.81", "x - 1; y - 1", text, **members)
        return self.refused("equations", {"system": system})["errors"][0]

    def test_an_array_of_objects(self):
        error = self.first(constraints="x - y")
        self.assertEqual(error["detail"], "'constraints' needs an array of objects, [{\"name\": ...}, ...], not a string.")
        error = self.first(constraints=["x - y"])
        self.assertIn("'constraints' needs in each place an object with the fields name, expression", error["detail"])
        error = self.first(bodies="particle")
        self.assertNotIn("[\"particle\"]", error["detail"])

    def test_greek_letters(self):
        for letter, told in (("π", "write pi"), ("ω", "write omega"), ("θ̇", "write theta_dot for the velocity"), ("α", "write alpha")):
            self.assertIn(told, self.first(f"x_dot^2/2 + y_dot^2/2 - cos({letter}*x)")["detail"])
        self.assertIn("the number is pi", self.first("x_dot^2/2 + y_dot^2/2 - cos(Pi*x)")["detail"])

    def test_velocities_written_otherwise(self):
        for name in ("xd", "dx", "vx", "xp", "x_d", "x_t", "xdot"):
            self.assertEqual(self.first(f"{name}^2/2 + y_dot^2/2")["did_you_mean"], "x_dot", name)
        self.assertIn("there are no accelerations here", self.first("x_dot_dot*x + y_dot^2/2")["detail"])

    def test_products_without_a_star(self):
        for word, meant in (("kx", "k*x"), ("kgx", "k*g*x"), ("xy", "x*y")):
            error = self.first(f"x_dot^2/2 + y_dot^2/2 - {word}")
            self.assertEqual(error["did_you_mean"], meant)
            self.assertIn(f"a product is written {meant}", error["detail"])
        self.assertNotIn("product", self.first("x_dot^2/2 + y_dot^2/2 - kq")["detail"])

    def test_functions_of_time(self):
        self.assertIn("write x_dot alone, not x_dot(t)", self.first("x_dot(t)^2/2 + y_dot^2/2")["detail"])
        self.assertIn("there are no accelerations here", self.first("x_ddot*x + y_dot^2/2")["detail"])

    def test_two_energies(self):
        for name in ("T", "V", "kinetic"):
            error = self.first(**{name: "x_dot^2/2"})
            self.assertIn("\"lagrangian\": \"T - V\"", error["detail"])
            self.assertEqual(error["did_you_mean"], "lagrangian")

    def test_the_name_of_a_multiplier(self):
        error = self.first("x_dot^2/2 + y_dot^2/2", constraints=[{"name": "c", "expression": "x - y", "multiplier": "g"}])
        self.assertEqual(error["pointer"], "#/system/constraints/0/multiplier")


if __name__ == "__main__":
    unittest.main()
