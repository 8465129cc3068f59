"""What happens where a function has a multiple root: (x - c)^m multiplied out, which doubles do not tell from 0 near c."""

import pathlib
import sys
import unittest
from fractions import Fraction

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from service import Service  # noqa: E402
from short_scene import lagrangian  # noqa: E402


def decimal(number):
    """All digits of a number that has finitely many."""
    places = 0
    while (10**places) % number.denominator:
        places += 1
    digits = str(abs(number.numerator) * 10**places // number.denominator).rjust(places + 1, "0")
    text = digits[: len(digits) - places] + "." + digits[len(digits) - places :] if places else digits
    return ("-" if number < 0 else "") + text


def power(place, exponent):
    """(x - place)^exponent as a sum of powers."""
    return product([place] * exponent)


def product(places):
    """Of all x - place, as a sum of powers."""
    coefficients = [Fraction(1)]
    for place in places:
        shifted = [Fraction(0), *coefficients]
        coefficients = [a - place * b for a, b in zip(shifted, [*coefficients, Fraction(0)])]
    return " + ".join(f"({decimal(c)})*x^{k}" for k, c in enumerate(coefficients))


class Flight:
    """x = start - speed t, which comes to `place`."""

    def __init__(self, start, speed, place, exponent, end):
        self.start, self.speed, self.place, self.end = Fraction(start), Fraction(speed), Fraction(place), Fraction(end)
        self.function = power(self.place, exponent)
        self.time = (self.start - self.place) / self.speed

    def request(self, options=None, **members):
        scene = lagrangian("flight", "", f"x - {decimal(self.start)} {decimal(-self.speed)}", "x_dot^2/2", **members)
        del scene["parameters"]
        return {"system": scene, "t_end": float(self.end), "samples": 2, **(options or {})}

    def after(self, factor, acceleration=Fraction(0)):
        """Position and velocity at the end, where the speed has become `factor` of it, with a force from there on."""
        left, velocity = self.end - self.time, -factor * self.speed
        return (
            self.place + velocity * left + acceleration * left**2 / 2,
            velocity + acceleration * left,
        )


class MultipleRoots(Service):
    def assert_ends_at(self, answer, known):
        self.assertEqual(answer["status"], "complete")
        for name, value in zip(("x", "x_dot"), known):
            off = abs(Fraction(answer["trajectory"][name][-1]) - value)
            self.assertLessEqual(off, answer["accuracy"]["max_abs_error"][name], name)

    def test_a_wall_turns_the_motion_by_a_slope_that_doubles_do_not_tell(self):
        walls = (
            ("1.15", "1.1", "0.028", 3, "1.2683", "1", {"accuracy": "fast"}),
            ("0.684", "0.413", "-0.0264", 3, "2.3857", "0.5", {}),
            ("1.09", "0.872", "0.306", 5, "1.2672", "0.5", {}),
            ("1.5", "1.97", "-0.22769", 7, "1.1667", "1", {}),
            ("0.806", "2", "0.334", 7, "0.3977", "0.5", {}),
            ("0.338", "1.56", "0.3379999999991164", 5, "0.3339", "0.2", {}),
            ("0.312", "1.45", "0.31199999999954", 5, "0.6967", "1", {}),
            ("0.406", "0.9", "0.4059999997850800896", 7, "0.1972", "0.2", {"accuracy": "fast"}),
            ("1.35", "0.528", "1.3499999999972382891", 5, "0.3619", "0.2", {}),
        )
        for start, speed, place, exponent, end, restitution, options in walls:
            with self.subTest(place=place, exponent=exponent):
                flight = Flight(start, speed, place, exponent, end)
                event = {"name": "wall", "expression": flight.function, "direction": "falling"}
                impact = {"event": "wall", "restitution": restitution}
                answer = self.ask("simulate", flight.request(options, events=[event], impacts=[impact]))
                self.assert_ends_at(answer, flight.after(-Fraction(restitution)))

    def test_a_wall_whose_function_has_no_slope_is_refused_for_that(self):
        flight = Flight("0.5", "1", "0.5", 3, "1")
        event = {"name": "wall", "expression": flight.function, "direction": "falling"}
        request = flight.request(events=[event], impacts=[{"event": "wall", "restitution": "0.5"}])
        problem = self.refused("simulate", request)
        self.assertIn("no slope that can be told from 0", problem["errors"][0]["detail"])

    def test_a_condition_that_is_zero_at_the_start_and_falls_stops_the_motion(self):
        for exponent in (3, 5, 7):
            for place in ("0.808", "0.80799999999", "0.8079"):
                for options in ({}, {"method": "erk"}, {"method": "bdf"}, {"method": "gauss", "h": 0.02}):
                    with self.subTest(exponent=exponent, place=place, **options):
                        flight = Flight("0.808", "1.46", place, exponent, "0.4448")
                        condition = {"name": "e", "expression": flight.function, "reason": "touch", "message": "m"}
                        stop = self.ask("simulate", flight.request(options, valid_while=[condition]))["stop"]
                        self.assertEqual(stop["reason"], "touch")
                        if stop.get("error") is not None:
                            self.assertLessEqual(abs(Fraction(stop["t"]) - flight.time), stop["error"])

    def test_a_condition_that_is_zero_at_the_start_and_rises_holds(self):
        for exponent in (1, 3, 5, 7):
            with self.subTest(exponent=exponent):
                flight = Flight("0.808", "-1.46", "0.808", exponent, "0.4448")
                condition = {"name": "e", "expression": flight.function, "reason": "touch", "message": "m"}
                answer = self.ask("simulate", flight.request(valid_while=[condition]))
                self.assertEqual(answer["status"], "complete")

    def test_a_condition_that_is_zero_at_the_start_but_for_rounding_holds_where_it_rises(self):
        for text, speed, status in (("0.3 - 3*x", 1, "complete"), ("3*x - 0.3", -1, "complete"),
                                    ("0.3 - 3*x", -1, "stopped"), ("3*x - 0.3", 1, "stopped")):
            with self.subTest(text, speed=speed):
                condition = {"name": "e", "expression": text, "reason": "touch", "message": "m"}
                answer = self.ask("simulate", Flight("0.1", speed, "0.1", 1, "1").request(valid_while=[condition]))
                self.assertEqual(answer["status"], status)

    def test_a_kink_is_passed_where_its_argument_is_zero(self):
        kinks = (
            ("0.679", "1.59", "-0.16529", 7, "1.216", "0.49", {}),
            ("0.745", "0.992", "-0.178", 5, "1.1339", "0.39", {"accuracy": "fast"}),
            ("0.646", "1.87", "0.64599999968771", 3, "0.7136", "-0.077", {"max_error": 1e-10}),
            ("0.545", "0.491", "0.544499", 5, "0.29742", "-0.49", {"accuracy": "fast"}),
            ("0.948", "1.53", "0.9479920287", 5, "0.41121", "-0.3", {"method": "erk"}),
            ("1.39", "1.62", "1.389999999847396", 3, "1", "-0.41", {"accuracy": "fast"}),
            ("1.06", "1.4", "1.0599999999970661", 3, "0.7605", "-0.2", {}),
            ("0.956", "1.27", "0.955999987", 5, "0.6265", "-0.31", {}),
            ("0.912", "1.85", "0.91199858583993522", 5, "0.4342", "-0.4", {"accuracy": "accurate"}),
            ("0.556", "1.4", "0.556", 5, "0.6864", "-0.4", {}),
        )
        for start, speed, place, exponent, end, force, options in kinks:
            with self.subTest(place=place, exponent=exponent):
                flight = Flight(start, speed, place, exponent, end)
                force_on = {"name": "f", "value": f"({force})*(1 - sign({flight.function}))", "along": "x"}
                answer = self.ask("simulate", flight.request(options, forces=[force_on]))
                self.assert_ends_at(answer, flight.after(Fraction(1), 2 * Fraction(force)))

    def test_two_kinks_that_rounding_does_not_tell_apart_are_in_the_errors(self):
        """Between them a force acts for a millionth of a second."""
        cases = (
            ("0.395", "1.98", ("0.394876997306", 1), ("0.394876127306", 3), "0.6912", "-0.22", {}),
            ("0.863", "1.61", ("0.862999994993", 3), ("0.862999134993", 1), "0.5904", "-0.49", {"max_error": 1e-10}),
            ("1.2", "1.61", ("0.9", 3), ("0.89999923", 1), "0.5904", "-0.49", {"accuracy": "accurate"}),
            ("0.7", "1.2", ("0.3", 1), ("0.2999988", 3), "0.7", "0.3", {}),
        )
        for start, speed, (first, m), (second, n), end, force, options in cases:
            with self.subTest(first=first, second=second):
                start, speed, end, force = (Fraction(text) for text in (start, speed, end, force))
                first, second = Fraction(first), Fraction(second)
                argument = product([first] * m + [second] * n)
                force_on = {"name": "f", "value": f"({decimal(force)})*(1 - sign({argument}))", "along": "x"}
                request = Flight(start, speed, first, 1, end).request(options, forces=[force_on])
                answer = self.ask("simulate", request)
                time, between = (start - first) / speed, (first - second) / speed
                change = 2 * force * between
                known = {"x": start - speed * end + change * (end - time - between / 2), "x_dot": change - speed}
                for name, value in known.items():
                    off = abs(Fraction(answer["trajectory"][name][-1]) - value)
                    self.assertLessEqual(off, answer["accuracy"]["max_abs_error"][name] + 1e-11, name)


if __name__ == "__main__":
    unittest.main()
