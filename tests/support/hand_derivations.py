"""Accelerations of the practice problems as a hand derivation has them, from the positions of each scene."""

import mpmath


def spring_pendulum(s, F=0):
    return {"l": s.l*s.theta_dot**2 + s.g*mpmath.cos(s.theta) - s.k/s.m*(s.l - s.l0) + F/s.m*mpmath.sin(s.theta),
            "theta": -(2*s.l_dot*s.theta_dot + s.g*mpmath.sin(s.theta) - F/s.m*mpmath.cos(s.theta))/s.l}


def forced_spring_pendulum(s):
    return spring_pendulum(s, s.F)


def rolling_disk_platform(s):
    return {"q": 2*(s.Omega**2*s.q - s.g*mpmath.sin(s.Omega*s.t))/3}


def cart_pendulum(s):
    sin, cos = mpmath.sin(s.theta), mpmath.cos(s.theta)
    x = (s.m*sin*(s.l*s.theta_dot**2 + s.g*cos) - s.k*s.x)/(s.M + s.m*sin**2)
    return {"x": x, "theta": -(s.g*sin + x*cos)/s.l}


def rod_pendulum(s):
    d, gravity = s.theta - s.phi, s.g/s.l
    sin, cos = mpmath.sin(d), mpmath.cos(d)
    theta = (-s.phi_dot**2*sin - gravity*mpmath.sin(s.theta)*3/2
             - cos*(s.theta_dot**2*sin - gravity*mpmath.sin(s.phi)))/(mpmath.mpf(4)/3 - cos**2)
    return {"theta": theta, "phi": -cos*theta + s.theta_dot**2*sin - gravity*mpmath.sin(s.phi)}


def rod_spring_pendulum(s):
    pull, e = s.k*(s.r - s.l0), s.phi - s.theta
    sin, cos = mpmath.sin(e), mpmath.cos(e)
    theta = 3*(pull*sin/(s.m*s.l) - s.g/(2*s.l)*mpmath.sin(s.theta))
    return {"theta": theta,
            "r": (s.r*s.phi_dot**2 - s.l*(theta*sin - s.theta_dot**2*cos) + s.g*mpmath.cos(s.phi) - pull/s.m),
            "phi": -(2*s.r_dot*s.phi_dot + s.l*(theta*cos + s.theta_dot**2*sin) + s.g*mpmath.sin(s.phi))/s.r}


def whirling_pendulum(s):
    return {"theta": mpmath.sin(s.theta)*(s.Omega**2*mpmath.cos(s.theta) - s.g/s.l)}


def orbiting_pendulum(s):
    return {"phi": -s.r/s.l*s.omega0**2*mpmath.sin(s.phi)}


def free_spin_pendulum(s):
    arm = mpmath.mpf(1)/2 + mpmath.sin(s.theta)
    return {"theta": s.psi_dot**2*arm*mpmath.cos(s.theta) - s.g/s.l*mpmath.sin(s.theta),
            "psi": -2*s.psi_dot*s.theta_dot*mpmath.cos(s.theta)/arm}


def compass_walker(s):
    mu, gravity, sin, cos = s.m/s.M, s.g/s.l, mpmath.sin(s.phi), mpmath.cos(s.phi)
    theta = ((1 + mu)*gravity*mpmath.sin(s.theta - s.gamma) - mu*cos*gravity*mpmath.sin(s.theta - s.phi - s.gamma)
             + mu*sin*((1 - cos)*s.theta_dot**2 - 2*s.theta_dot*s.phi_dot + s.phi_dot**2))/(1 + mu*sin**2)
    return {"theta": theta,
            "phi": (1 - cos)*theta + sin*s.theta_dot**2 + gravity*mpmath.sin(s.theta - s.phi - s.gamma)}


def rotating_l_bar(s):
    return {"theta": mpmath.mpf(3)/55*(s.Omega**2*(mpmath.sin(2*s.theta)*53/6 - mpmath.cos(2*s.theta)*3/2)
                                       - s.g/s.l*(15*mpmath.sin(s.theta) - mpmath.cos(s.theta))/2)}


ACCELERATIONS = {function.__name__: function for function in (
    spring_pendulum, forced_spring_pendulum, rolling_disk_platform, cart_pendulum, rod_pendulum, rod_spring_pendulum,
    whirling_pendulum, orbiting_pendulum, free_spin_pendulum, compass_walker, rotating_l_bar)}
