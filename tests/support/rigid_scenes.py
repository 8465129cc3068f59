"""Scenes of rigid bodies, springs, dampers and torques whose motions are known."""

from constrained_scenes import coordinates, parameters


def free_body(orientation, moments=("1", "2", "3"), names="abc", **more):
    """A body about its fixed centre."""
    return {
        "name": "free_body",
        "parameters": parameters(m=("kg", "1"), I1=("kg*m^2", moments[0]), I2=("kg*m^2", moments[1]), I3=("kg*m^2", moments[2])),
        "coordinates": coordinates(**{name: ("rad", "0.4", "0") for name in names}),
        "bodies": [{"kind": "rigid_body", "name": "body", "mass": "m", "principal_moments": ["I1", "I2", "I3"],
                    "centre": [0, 0, 0], "orientation": orientation}],
    } | more


def heavy_top(moments, sequence="ZXZ", names=("phi", "theta", "psi"), centre=None):
    """A body whose centre is l up its axis 3 from a fixed point."""
    return {
        "name": "heavy_top",
        "parameters": parameters(m=("kg", "0.5"), l=("m", "0.1"), A=("kg*m^2", "0.002"), B=("kg*m^2", "0.0025"),
                                 C=("kg*m^2", "0.001"), g=("m/s^2", "9.81")),
        "coordinates": coordinates(**{name: ("rad", "0.5", "0") for name in names}),
        "points": [{"name": "pivot", "components": [0, 0, 0]},
                   {"name": "centre", "components": centre or ["l*sin(theta)*sin(phi)", "-l*sin(theta)*cos(phi)", "l*cos(theta)"]}],
        "bodies": [{"kind": "rigid_body", "name": "top", "mass": "m", "principal_moments": list(moments), "centre": "centre",
                    "orientation": {"sequence": sequence, "angles": list(names)}}],
        "gravity": [0, 0, "-g"],
        "lines": [["pivot", "centre"]],
    }


SYMMETRIC_TOP = heavy_top(("A", "A", "C"))

# Upright where both angles are 0, which is no singular place of these coordinates.
SLEEPING_TOP = heavy_top(("A", "A", "C"), "XYZ", ("a", "b", "psi"),
                         ["l*sin(b)", "-l*sin(a)*cos(b)", "l*cos(a)*cos(b)"])


def pendulum(body, **sizes):
    """In the plane, hung at the distance d from its centre."""
    return {
        "name": "physical_pendulum",
        "parameters": parameters(m=("kg", "0.7"), d=("m", "0.3"), g=("m/s^2", "9.81"), **{k: ("m", v) for k, v in sizes.items()}),
        "coordinates": coordinates(theta=("rad", "0.1", "0")),
        "bodies": [{**body, "mass": "m", "centre": ["d*sin(theta)", "-d*cos(theta)"], "angle": "theta"}],
        "gravity": [0, "-g"],
    }


def about_axis(body, axis, **sizes):
    """In space, turning about a fixed axis through its centre against a torsion spring."""
    return {
        "name": "torsion_pendulum",
        "parameters": parameters(m=("kg", "0.7"), kappa=("N*m", "0.2"), **{k: ("m", v) for k, v in sizes.items()}),
        "coordinates": coordinates(theta=("rad", "0.1", "0")),
        "bodies": [{**body, "mass": "m", "centre": [0, 0, 0],
                    "orientation": {"rotations": [{"axis": axis, "angle": "theta"}]}}],
        "springs": [{"stiffness": "kappa", "angle": "theta"}],
    }


TWO_MASSES = {
    "name": "two_masses_in_space",
    "parameters": parameters(m1=("kg", "0.4"), m2=("kg", "0.9"), k=("N/m", "12"), l0=("m", "0.5"), c=("N*s/m", "0")),
    "coordinates": coordinates(x1=("m", "0", "0"), x2=("m", "0.7", "0")),
    "points": [{"name": "P1", "components": ["x1*3/5", "x1*4/5"]}, {"name": "P2", "components": ["x2*3/5", "x2*4/5"]}],
    "bodies": [{"kind": "particle", "mass": f"m{i}", "position": f"P{i}"} for i in (1, 2)],
    "springs": [{"stiffness": "k", "between": ["P1", "P2"], "rest_length": "l0"}],
    "dampers": [{"coefficient": "c", "between": ["P1", "P2"]}],
}

THROWN = {
    "name": "thrown",
    "parameters": parameters(m=("kg", "0.2"), c=("kg/m", "0.03"), g=("m/s^2", "9.81")),
    "coordinates": coordinates(x=("m", "0", "7"), y=("m", "0", "9")),
    "points": [{"name": "ball", "components": ["x", "y"]}],
    "bodies": [{"kind": "particle", "mass": "m", "position": "ball"}],
    "dampers": [{"coefficient": "c", "law": "quadratic", "point": "ball"}],
    "gravity": [0, "-g"],
}
