"""SciPy on the motions that the program `work_precision` has written to a folder: one line a point, as that program.

    python3 scipy_methods.py FOLDER QDOT

The right-hand sides are the derived equations of `QDOT equations`, with numbers for the parameters, as Python
functions of floats. Point by point, 5 turns where one takes less than 0.03 s, 3 up to 0.1 s, else one.
"""

import json
import pathlib
import statistics
import subprocess
import sys
import time
import warnings

import numpy
import scipy.integrate
import sympy

SAMPLES = 1001
TOLERANCES = {"scipy_rk45": (1e-3, 1e-5, 1e-7, 1e-9), "scipy_dop853": (1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13),
              "scipy_lsoda": (1e-3, 1e-5, 1e-7, 1e-9, 1e-11), "scipy_radau": (1e-3, 1e-5, 1e-7),
              "scipy_odeint": (1e-3, 1e-5, 1e-7, 1e-9, 1e-11)}
TOO_LONG = {"scipy_dop853": 4.0, "scipy_odeint": 1.0}  # s; a method's tighter tolerances are left out after that
TOO_LONG_ELSE = 0.3
LEAST_RTOL = 2.3e-14  # SciPy's own
GIVE_UP = 1e3  # an error this large is no answer


def derivative(qdot, motion):
    """f(t, y) of one motion."""
    run = subprocess.run([qdot, "equations", "system=" + motion["system"], "form=sympy"], capture_output=True, check=True)
    answer = json.loads(run.stdout)
    accelerations = answer["accelerations"]
    names = [name.removesuffix("_ddot") for name in accelerations]
    t = sympy.Symbol("t")
    symbols = {name: sympy.Symbol(name) for name in
               names + [name + "_dot" for name in names] + list(motion["parameters"]) + ["F", "t"]}
    values = {symbols[name]: value for name, value in motion["parameters"].items()}
    if motion["inputs"]:
        values[symbols["F"]] = sympy.sympify(motion["inputs"][0], locals={"t": t})
    solved = [sympy.sympify(text, locals=symbols).subs(values) for text in accelerations.values()]
    state = [symbols[name] for name in names] + [symbols[name + "_dot"] for name in names]
    return sympy.lambdify((t, state), state[len(names):] + solved, "math", cse=True)


def solver(method, f, motion, grid):
    """A function of the tolerance that returns the rows and the evaluations."""
    initial, t_end = motion["initial"], motion["t_end"]
    if method == "scipy_odeint":
        def solve(tolerance):
            rows, info = scipy.integrate.odeint(f, initial, grid, tfirst=True, rtol=max(tolerance, LEAST_RTOL),
                                                atol=tolerance, mxstep=100000, full_output=True)
            return rows, int(info["nfe"][-1])
    else:
        name = {"scipy_rk45": "RK45", "scipy_dop853": "DOP853", "scipy_lsoda": "LSODA", "scipy_radau": "Radau"}[method]

        def solve(tolerance):
            run = scipy.integrate.solve_ivp(f, (0, t_end), initial, name, grid, rtol=max(tolerance, LEAST_RTOL),
                                            atol=tolerance)
            return run.y.T, run.nfev
    return solve


def timed(solve, tolerance):
    start = time.thread_time()
    rows, evaluations = solve(tolerance)
    return time.thread_time() - start, rows, evaluations


def main():
    folder, qdot = pathlib.Path(sys.argv[1]), sys.argv[2]
    warnings.simplefilter("ignore")
    for motion in json.loads((folder / "motions.json").read_text()):
        f = derivative(qdot, motion)
        grid = numpy.array([motion["t_end"]*i/(SAMPLES - 1) for i in range(SAMPLES)])
        reference = numpy.fromfile(folder / (motion["name"] + ".reference")).reshape(SAMPLES, -1)
        for method, tolerances in TOLERANCES.items():
            solve = solver(method, f, motion, grid)
            for tolerance in tolerances:
                seconds, rows, evaluations = timed(solve, tolerance)
                times = [seconds]
                for _ in range(4 if seconds < 0.03 else 2 if seconds < 0.1 else 0):
                    times.append(timed(solve, tolerance)[0])
                if rows.shape == reference.shape:
                    error = float(abs(rows - reference).max())
                    if error < GIVE_UP:
                        print(f"{motion['name']},{method},python,{tolerance:.0e},{error:.3g},"
                              f"{1e6*statistics.median(times):.5g},{evaluations},0,{len(times)}", flush=True)
                if seconds > TOO_LONG.get(method, TOO_LONG_ELSE):
                    break


if __name__ == "__main__":
    main()
