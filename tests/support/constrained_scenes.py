"""Scenes with constraints whose motions are known, most of them in closed form."""


def parameters(**units_and_defaults):
    return [{"name": name, "unit": unit, "default": default} for name, (unit, default) in units_and_defaults.items()]


def coordinates(**units_and_starts):
    """name=(unit, initial, initial_rate)"""
    return [{"name": name, "unit": unit, "initial": start, "initial_rate": rate}
            for name, (unit, start, rate) in units_and_starts.items()]


TENSION = {"name": "tension", "unit": "N", "reason": "string_slack", "message": "The string is slack."}

PENDULUM_BY_CONSTRAINT = {
    "name": "pendulum_by_constraint",
    "parameters": parameters(m=("kg", "0.3"), l=("m", "0.7"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "l*sin(1)", "0"), y=("m", "-l*cos(1)", "0")),
    "points": [{"name": "bob", "components": ["x", "y"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "bob"}],
    "gravity": ["0", "-g"],
    "constraints": [{"name": "string", "expression": "x^2 + y^2 - l^2"}],
    "valid_while": [{**TENSION, "expression": "-2*l*lambda_string"}],
}

PENDULUM_BY_ANGLE = {
    "name": "pendulum_by_angle",
    "parameters": PENDULUM_BY_CONSTRAINT["parameters"],
    "coordinates": coordinates(theta=("rad", "1", "0")),
    "held_lengths": [{"name": "s", "unit": "m", "value": "l"}],
    "points": [{"name": "bob", "components": ["s*sin(theta)", "-s*cos(theta)"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "bob"}],
    "gravity": ["0", "-g"],
    "valid_while": [{**TENSION, "reaction": {"length": "s", "sign": -1}}],
}

ROLLING_DISK = {
    "name": "disk_on_incline",
    "parameters": parameters(m=("kg", "2"), r=("m", "0.1"), alpha=("rad", "0.4"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "0"), theta=("rad", "0", "0")),
    "bodies": [{"kind": "disk", "mass": "m", "radius": "r", "angle": "theta",
                "centre": ["x*cos(alpha) + r*sin(alpha)", "-x*sin(alpha) + r*cos(alpha)"]}],
    "gravity": ["0", "-g"],
    "constraints": [{"name": "rolling", "expression": "x_dot - r*theta_dot", "multiplier": "friction"}],
}

KNIFE_EDGE = {
    "name": "knife_edge",
    "parameters": parameters(m=("kg", "1.5"), J=("kg*m^2", "0.2"), alpha=("rad", "0.3"), w=("rad/s", "2"),
                             g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "0"), y=("m", "0", "0"), phi=("rad", "0", "w")),
    "lagrangian": "m*(x_dot^2 + y_dot^2)/2 + J*phi_dot^2/2 + m*g*x*sin(alpha)",
    "constraints": [{"name": "edge", "expression": "x_dot*sin(phi) - y_dot*cos(phi)"}],
}

SLEIGH = {
    "name": "chaplygin_sleigh",
    "parameters": parameters(m=("kg", "1.2"), J=("kg*m^2", "0.3"), a=("m", "0.4"), w=("rad/s", "1.5")),
    "coordinates": coordinates(x=("m", "0", "0"), y=("m", "0", "0"), theta=("rad", "0", "w")),
    "lagrangian": "m*((x_dot - a*theta_dot*sin(theta))^2 + (y_dot + a*theta_dot*cos(theta))^2)/2 + J*theta_dot^2/2",
    "constraints": [{"name": "blade", "expression": "y_dot*cos(theta) - x_dot*sin(theta)"}],
}

ROTATING_WIRE = {
    "name": "bead_on_rotating_wire",
    "parameters": parameters(m=("kg", "0.5"), Omega=("rad/s", "1.3"), r0=("m", "0.2")),
    "coordinates": coordinates(x=("m", "r0", "0"), y=("m", "0", "r0*Omega")),
    "bodies": [{"kind": "particle", "mass": "m", "position": ["x", "y"]}],
    "constraints": [{"name": "wire", "expression": "x*sin(Omega*t) - y*cos(Omega*t)", "multiplier": "N"}],
}

ATWOOD = {
    "name": "atwood_by_constraint",
    "parameters": parameters(m1=("kg", "3"), m2=("kg", "2"), L=("m", "2"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(y1=("m", "L/2", "0"), y2=("m", "L/2", "0")),
    "bodies": [{"kind": "particle", "mass": "m1", "position": ["0", "-y1"]},
               {"kind": "particle", "mass": "m2", "position": ["L", "-y2"]}],
    "gravity": ["0", "-g"],
    "constraints": [{"name": "rope", "expression": "y1 + y2 - L"}],
}

BLOCK_WITH_FRICTION = {
    "name": "block_on_incline",
    "parameters": parameters(m=("kg", "2"), alpha=("rad", "0.3"), F=("N", "8"), v=("m/s", "1"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "v*cos(alpha)"), y=("m", "0", "-v*sin(alpha)")),
    "points": [{"name": "block", "components": ["x", "y"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "block"}],
    "gravity": ["0", "-g"],
    "forces": [{"vector": ["-F*cos(alpha)*sign(x_dot)", "F*sin(alpha)*sign(x_dot)"], "point": "block"}],
    "constraints": [{"name": "plane", "expression": "x*sin(alpha) + y*cos(alpha)", "multiplier": "N"}],
}

DOUBLE_PENDULUM = {
    "name": "double_pendulum_by_constraints",
    "parameters": parameters(m=("kg", "1"), l=("m", "1"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x1=("m", "l*sin(0.8)", "0"), y1=("m", "-l*cos(0.8)", "0"),
                               x2=("m", "l*(sin(0.8) + sin(0.3))", "0"), y2=("m", "-l*(cos(0.8) + cos(0.3))", "0")),
    "bodies": [{"kind": "particle", "mass": "m", "position": [f"x{i}", f"y{i}"]} for i in (1, 2)],
    "gravity": ["0", "-g"],
    "constraints": [{"name": "upper", "expression": "x1^2 + y1^2 - l^2"},
                    {"name": "lower", "expression": "(x2 - x1)^2 + (y2 - y1)^2 - l^2"}],
}

DOUBLE_PENDULUM_BY_ANGLES = {
    "name": "double_pendulum_by_angles",
    "parameters": DOUBLE_PENDULUM["parameters"],
    "coordinates": coordinates(a=("rad", "0.8", "0"), b=("rad", "0.3", "0")),
    "points": [{"name": "p", "components": ["l*sin(a)", "-l*cos(a)"]},
               {"name": "q", "components": ["l*(sin(a) + sin(b))", "-l*(cos(a) + cos(b))"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": point} for point in "pq"],
    "gravity": ["0", "-g"],
}
