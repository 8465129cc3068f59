"""A convex body that rolls on a plane without slipping, by Newton's and Euler's equations in the body's own axes.

u is the vertical in these axes, w the angular velocity, r(u) the place of the centre seen from the contact. The contact
rests, so the centre has v = w x r, and the ground's force F = m (v' + w x v + g u) turns the body about its centre:

    (I + m (r.r 1 - r r^T)) w' = -w x I w - r x m (w x r' + w x (w x r) + g u),   u' = u x w
"""

import mpmath
import numpy
import sympy
from scipy.integrate import solve_ivp

U = sympy.Matrix(sympy.symbols("u1 u2 u3"))


def place_of_support(height):
    """r(u) of a body whose centre is at the height z(u): grad z + (z - u.grad z) u, for |u| = 1."""
    slope = sympy.Matrix([height.diff(x) for x in U])
    return slope + (height - U.dot(slope)) * U


class RollingBody:
    def __init__(self, mass, moments, place, g):
        w, turning = sympy.Matrix(sympy.symbols("w1:4")), U.cross(sympy.Matrix(sympy.symbols("w1:4")))
        inertia = sympy.diag(*moments)
        moving = place.jacobian(U) * turning
        inertia_at_contact = inertia + mass * (place.dot(place) * sympy.eye(3) - place * place.T)
        torque = -w.cross(inertia * w) - place.cross(mass * (w.cross(moving) + w.cross(w.cross(place)) + g * U))
        self.parts = [[*U, *w], (turning, inertia_at_contact, torque)]
        self.in_doubles = sympy.lambdify(*self.parts, "numpy", cse=True)
        self.in_digits = sympy.lambdify(*self.parts, "mpmath", cse=True)
        self.energy = sympy.lambdify(
            [[*U, *w]], (w.dot(inertia * w) + mass * w.cross(place).dot(w.cross(place))) / 2 + mass * g * U.dot(place))

    def rates(self, _, state):
        turning, inertia, torque = self.in_doubles(*state)
        return numpy.concatenate([turning.ravel(), numpy.linalg.solve(inertia, torque.ravel())])

    def motion(self, state, times):
        """The rows (u, w) at these times, to about ten digits."""
        solution = solve_ivp(self.rates, (0, times[-1]), state, "DOP853", t_eval=times, rtol=1e-13, atol=1e-15)
        assert solution.success
        return solution.y.T

    def exponents(self, state):
        """s of all small motions exp(s t) about a steady motion, by differences at many digits."""
        with mpmath.workdps(60):
            at = [mpmath.mpf(x) for x in state]

            def rates(y):
                turning, inertia, torque = self.in_digits(*y)
                return list(turning) + list(mpmath.lu_solve(inertia, torque))

            assert max(abs(x) for x in rates(at)) < mpmath.mpf(10) ** -40, "the motion is not steady"
            step = mpmath.mpf(10) ** -20
            matrix = mpmath.matrix(6)
            for j in range(6):
                ahead, behind = (rates([x + sign * step * (i == j) for i, x in enumerate(at)]) for sign in (1, -1))
                for i in range(6):
                    matrix[i, j] = (ahead[i] - behind[i]) / (2 * step)
            return mpmath.eig(matrix, left=False, right=False)
