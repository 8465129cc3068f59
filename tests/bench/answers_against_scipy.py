"""CPU time of modes, turning points, equilibria and gaits beside SciPy on the same questions, in one run.

Usage: QDOT_BINARY=build/release/qdot python3 tests/bench/answers_against_scipy.py
SciPy is given the derived matrices and equations as compiled NumPy functions; qdot starts from a request, reads it,
answers it and writes JSON, over HTTP, with its errors.
"""

import json
import math
import os
import pathlib
import sys
import time

import numpy
import scipy.integrate
import scipy.linalg
import scipy.optimize

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tests" / "server"))
os.environ.setdefault("QDOT_BINARY", str(ROOT / "build" / "release" / "qdot"))
from running_qdot import RunningQdot  # noqa: E402

REPEATED = 200


def solve_time(server, endpoint, request):
    """Median of what Server-Timing says of solving, in us."""
    times = []
    for _ in range(REPEATED):
        response = server.request("POST", f"/v1/{endpoint}", json.dumps(request), {"Content-Type": "application/json"})
        assert response.status == 200, response.data[:300]
        parts = dict(part.split(";dur=") for part in response.getheader("Server-Timing").split(", "))
        times.append(1e3*float(parts["solve"]))
    return sorted(times)[REPEATED//2]


def scipy_time(function, repeated=REPEATED):
    times = []
    for _ in range(repeated):
        start = time.process_time()
        function()
        times.append(1e6*(time.process_time() - start))
    return sorted(times)[repeated//2]


def scipy_modes():
    mass = numpy.array([[3*0.2, 0.2*0.4], [0.2*0.4, 0.2*0.16]])
    stiffness = numpy.array([[9.81, 0], [0, 0.2*9.81*0.4]])
    return scipy.linalg.eigh(stiffness, mass)


def scipy_turning_point():
    f = lambda x: 1/8/(0.5 + math.sin(x))**2 - math.cos(x) + 0.5  # noqa: E731
    return scipy.optimize.brentq(f, 0.5, 1.5, xtol=1e-15)


def scipy_equilibria():
    w2, g = 36.0, 9.81/0.2
    f = lambda x: w2*(53/6*math.sin(2*x) - 1.5*math.cos(2*x)) - g*(15*math.sin(x) - math.cos(x))/2  # noqa: E731
    grid = numpy.linspace(-math.pi, math.pi, 100)
    values = [f(x) for x in grid]
    return [scipy.optimize.brentq(f, a, b, xtol=1e-15)
            for a, b, u, v in zip(grid, grid[1:], values, values[1:]) if u*v < 0]


def scipy_gait():
    gamma = 0.009

    def rates(_, y):
        theta, phi, w, v = y
        a = math.sin(theta - gamma)
        return [w, v, a, a + math.sin(phi)*(w*w - math.cos(theta - gamma))]

    def strike(_, y):
        return y[1] - 2*y[0] if y[0] < -0.05 else -1.0
    strike.terminal, strike.direction = True, 1

    def defect(u):
        theta, w = u
        run = scipy.integrate.solve_ivp(rates, (0, 6), [theta, 2*theta, w, (1 - math.cos(2*theta))*w], "DOP853",
                                        events=strike, rtol=1e-12, atol=1e-13)
        end = run.y[:, -1]
        return [-end[0] - theta, math.cos(2*end[0])*end[2] - w]
    return scipy.optimize.fsolve(defect, [0.2003, -0.1998], xtol=1e-12)


QUESTIONS = [("modes", {"system": "cart_pendulum"}, scipy_modes, REPEATED),
             ("turning_points", {"system": "free_spin_pendulum"}, scipy_turning_point, REPEATED),
             ("equilibria", {"system": "rotating_l_bar"}, scipy_equilibria, REPEATED),
             ("gait", {"system": "compass_walker"}, scipy_gait, 5)]


def main():
    print("question        qdot, solve [us]   SciPy [us]   SciPy/qdot")
    with RunningQdot("--threads", "1") as server:
        for endpoint, request, function, repeated in QUESTIONS:
            ours, theirs = solve_time(server, endpoint, request), scipy_time(function, repeated)
            print(f"{endpoint:16}{ours:12.0f}{theirs:16.0f}{theirs/ours:12.1f}")


if __name__ == "__main__":
    main()
