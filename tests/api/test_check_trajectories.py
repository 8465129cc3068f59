"""/v1/check: trajectories are graded on the student's own instants, in whatever form the table is."""

import json
import math
import unittest

from test_check import Check


class Trajectories(Check):
    EXPECT = {"simulate": {"system": "spring_pendulum", "t_end": 5}, "columns": ["l"]}

    def csv(self, samples=101, **query):
        words = "&".join(f"{name}={value}" for name, value in query.items())
        return self.raw("GET", f"/v1/simulate?system=spring_pendulum&t_end=5&samples={samples}&format=csv&{words}").data.decode()

    def test_on_the_students_own_instants(self):
        columns = self.get_json("/v1/simulate?system=spring_pendulum&t_end=5&samples=37")["trajectory"]
        shifted = {"t": columns["t"], "l": [value + 0.02 for value in columns["l"]]}
        self.assert_verdicts(self.EXPECT, [
            (self.csv(), True), (self.csv(23), True), (self.csv(digits=4), True), (columns, True), (self.csv().replace(",", ";"), True),
            (self.csv(g=9.7), False), (shifted, False), (self.csv().replace("t,l", "t,r"), None), ("t,l\n0,0.55\n", None),
            ("\ufeff" + self.csv(), True), (self.csv().replace("t,l", "t,t"), None), (self.csv().replace("t,l", "time,t"), None),
            (self.csv(5), None), ("", None), ("t,l\n0,x\n", None), ({"t": [0, 1], "l": [0]}, None), (3, None),
            (self.csv().replace("\n0.05,", "\n-0.05,"), None)], rule={"rtol": 1e-3})

    def table(self, header, rows, separator=",", decimal="."):
        lines = [separator.join(f"{x:.9g}".replace(".", decimal) for x in row) for row in rows]
        return "\n".join([header, *lines])

    def test_headings_have_units_and_tables_other_forms(self):
        columns = self.get_json("/v1/simulate?system=spring_pendulum&t_end=4&theta=0.7&samples=61")["trajectory"]
        rows = list(zip(columns["t"], columns["l"], columns["theta"]))
        degrees, centimetres = [(t, l, math.degrees(a)) for t, l, a in rows], [(1000 * t, 100 * l, a) for t, l, a in rows]
        expect = {"simulate": {"system": "spring_pendulum", "t_end": 4, "initial": {"theta": 0.7}}, "columns": ["l", "theta"]}
        self.assert_verdicts(expect, [
            (self.table("t [s],l (m),θ/rad", rows), True), (self.table("t,l,theta [deg]", degrees), True), (self.table("t,l,theta [deg]", rows), False),
            (self.table("t [ms],l [cm],theta", centimetres), True), (self.table("t;l;theta", rows, ";", ","), True), (self.table("# t l theta", rows, " "), True),
            (self.table("% by hand\nt\tl\ttheta", rows, "\t"), True), (self.table("t,l,theta", rows).replace("\n", "\r"), True),
            ([{"t": t, "l": l, "theta": a} for t, l, a in rows], True), (json.dumps({"t": columns["t"], "l": columns["l"], "theta": columns["theta"]}), True),
            (self.table("t,l [kg],theta", rows), None), (self.table("t,l,theta", [(t, l + 0.01, a) for t, l, a in rows]), False),
            ([[1, 2, 3]] * 61, None), ("{", None), ('{"t": [0, 1], "t": [0, 1]}', None)], rule={"rtol": 1e-3})
        for changed, slip in ((degrees, "degrees"), ([(t, -l, -a) for t, l, a in rows], "sign"), ([(t, l, -math.degrees(a)) for t, l, a in rows], None)):
            item, = self.verdicts(expect, [self.table("t,l,theta", changed)], rule={"rtol": 1e-3})
            self.assertEqual(item["diagnosis"] and item["diagnosis"]["slip"], slip)

    def test_the_counterexample_is_the_students_own_row(self):
        item, = self.verdicts(self.EXPECT, [self.csv(g=9.7)], rule={"rtol": 1e-3})
        row = item["counterexample"]
        self.assertEqual(row["column"], "l")
        self.assertIn(f"\n{row['t']},{row['value']}", self.csv(g=9.7))


if __name__ == "__main__":
    unittest.main()
