"""Textbook problems of steady motions and tops: what holds them, and how fast they oscillate about it."""

from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, rod, scene


def plane(name, parameters, potential):
    """A particle in the plane, in polar coordinates."""
    return scene(name, f"m kg 1; {parameters}", "r m 1; theta rad 0 0.9", potential=potential,
                 bodies=[particle("m", "r*cos(theta)", "r*sin(theta)")])


def positive(found, *names):
    for symbol in found["parameters"] + found["coordinates"]:
        if symbol["name"] in names:
            symbol["domain"] = "> 0"
    return found


def surface(name, parameters, coordinates, x, height):
    """A particle on a surface of revolution, x from its axis."""
    return scene(name, f"m kg 1; {parameters}; {G}", coordinates, gravity=DOWN_3D,
                 bodies=[particle("m", f"({x})*cos(phi)", f"({x})*sin(phi)", height)])


CONICAL = surface("conical_pendulum", "l m 0.5", "theta rad 0.5; phi rad 0 5", "l*sin(theta)", "-l*cos(theta)")
CONE = surface("cone", "alpha rad 0.5", "r m 0.5; phi rad 0 3", "r", "r/tan(alpha)")
PARABOLOID = surface("paraboloid", "a 1/m 1", "r m 0.5; phi rad 0 3", "r", "a*r^2/2")
TORUS = surface("torus", "R m 2; a m 0.5", "theta rad -1; phi rad 0 1", "R + a*cos(theta)", "a*sin(theta)")
FLAT_TORUS = TORUS | {"gravity": ["0", "0", "0*g"]}

HOLE = scene("mass_through_a_hole", f"m kg 1; M kg 2; {G}", "r m 1; theta rad 0 3", gravity=DOWN_3D,
             bodies=[particle("m", "r*cos(theta)", "r*sin(theta)", "0"), particle("M", "0", "0", "r")])

HOOP = scene("bead_on_a_whirled_hoop", f"m kg 1; r m 0.5; Omega rad/s 9; {G}", "theta rad 0.5", gravity=DOWN_3D,
             bodies=[particle("m", "r*sin(theta)*cos(Omega*t)", "r*sin(theta)*sin(Omega*t)", "-r*cos(theta)")])

HORIZONTAL_HOOP = scene(
    "hoop_about_a_point_of_its_rim", "m kg 1; R m 0.5; w rad/s 4", "phi rad 0.3",
    bodies=[particle("m", "R*cos(w*t) + R*cos(w*t + phi)", "R*sin(w*t) + R*sin(w*t + phi)")])

INCLINED = scene("bead_on_an_inclined_wire", f"m kg 1; alpha rad 0.5; Omega rad/s 3; {G}", "s m 1", gravity=DOWN_3D,
                 bodies=[particle("m", "s*sin(alpha)*cos(Omega*t)", "s*sin(alpha)*sin(Omega*t)", "s*cos(alpha)")])

TOP = scene(
    "heavy_top", f"m kg 0.5; l m 0.1; A kg*m^2 0.006; C kg*m^2 0.001; {G}", "phi rad; theta rad 0.5; psi rad 0 300",
    gravity=DOWN_3D,
    bodies=[{"kind": "rigid_body", "mass": "m", "principal_moments": ["A", "A", "C"],
             "centre": ["l*sin(theta)*sin(phi)", "-l*sin(theta)*cos(phi)", "l*cos(theta)"],
             "orientation": {"sequence": "ZXZ", "angles": ["phi", "theta", "psi"]}}])
DISCRIMINANT = "sqrt(C^2*psi_dot^2 - 4*(A + m*l^2 - C)*cos(theta)*m*g*l)"

FURUTA = scene(
    "pendulum_on_an_arm", f"J kg*m^2 0.02; m kg 0.1; R m 0.2; l m 0.15; {G}", "phi rad; theta rad 0.3", gravity=DOWN_3D,
    bodies=[{"kind": "rigid_body", "mass": "m", "principal_moments": ["J", "J", "J"], "centre": ["0", "0", "0"],
             "orientation": {"sequence": "Z", "angles": ["phi"]}},
            rod("m", ["R*cos(phi)", "R*sin(phi)", "0"],
                ["R*cos(phi) - 2*l*sin(theta)*sin(phi)", "R*sin(phi) + 2*l*sin(theta)*cos(phi)", "-2*l*cos(theta)"])])



def on_cylinder(along):
    """A place of a plank, by its distance from the middle."""
    return [f"R*sin(theta) - (R*theta {along})*cos(theta)", f"R*cos(theta) + (R*theta {along})*sin(theta)"]


PLANK = scene("plank_on_a_cylinder", f"m kg 1; L m 1; R m 0.4; {G}", "theta rad 0.2", gravity=DOWN,
              bodies=[rod("m", on_cylinder("+ L/2"), on_cylinder("- L/2"))])

CIRCUITS = lagrangian("coupled_circuits", "L - 1; M - 0.5; C - 2", "p - 1; q - 0",
                      "L/2*(p_dot^2 + q_dot^2) + M*p_dot*q_dot - (p^2 + q^2)/(2*C)")

PROBLEMS = [
    ("a conical pendulum; Landau and Lifshitz", CONICAL, [
        ("holds", "phi_dot", {"theta": "60deg"}, "sqrt(g/(l*cos(theta)))", "g*(1 + 3*cos(theta)^2)/(l*cos(theta))")]),
    ("a particle in a cone; Goldstein", CONE, [
        ("holds", "phi_dot", {"r": 1}, "sqrt(g/(r*tan(alpha)))", "3*g*sin(alpha)*cos(alpha)/r")]),
    ("a particle in a bowl, a paraboloid; Marion and Thornton", PARABOLOID, [
        ("accelerations", {"phi_ddot": "-2*r_dot*phi_dot/r",
                           "r_ddot": "r*(phi_dot^2 - a*g - a^2*r_dot^2)/(1 + a^2*r^2)"}),
        ("holds", "phi_dot", {"r": 1}, "sqrt(a*g)", "4*a*g/(1 + a^2*r^2)")]),
    ("a particle in a torus", TORUS, [
        ("holds", "phi_dot", {"theta": -1}, "sqrt(-g*cos(theta)/((R + a*cos(theta))*sin(theta)))",
         "-g/(a*sin(theta)) - 3*g*sin(theta)*cos(theta)/(R + a*cos(theta))")]),
    ("a geodesic of the torus; do Carmo", FLAT_TORUS, [
        ("accelerations", {"theta_ddot": "-phi_dot^2*sin(theta)*(R + a*cos(theta))/a"}),
        ("conserved", {"p_phi": "m*(R + a*cos(theta))^2*phi_dot"})]),
    ("a mass that hangs through a hole; Goldstein", HOLE, [
        ("holds", "theta_dot", {"r": 1}, "sqrt(M*g/(m*r))", "3*M*g/((m + M)*r)"),
        ("accelerations", {"r_ddot": "(m*r*theta_dot^2 - M*g)/(m + M)"})]),
    ("Kepler's problem with an inverse square more; Goldstein", plane("more_than_kepler", "k N*m^2 1; h N*m^3 0.05",
                                                                     "-k/r - h/(2*r^2)"), [
        ("holds", "theta_dot", {"r": 1}, "sqrt((k*r + h)/m)/r^2", "k/(m*r^3)")]),
    ("Yukawa's potential; Goldstein", plane("yukawa", "k J*m 1; a m 2", "-k/r*exp(-r/a)"), [
        ("holds", "theta_dot", {"r": 1}, "sqrt(k*exp(-r/a)*(1 + r/a)/(m*r^3))",
         "k*exp(-r/a)*(1 + r/a - r^2/a^2)/(m*r^3)")]),
    ("a spring about a centre", plane("spring_about_a_centre", "k N/m 3", "k*r^2/2"), [
        ("holds", "theta_dot", {"r": 1}, "sqrt(k/m)", "4*k/m")]),
    ("a power of the distance; Landau and Lifshitz", positive(plane("power_law", "k J 1; n 1 3; a m 1", "k*(r/a)^n/n"), "r", "a"), [
        ("holds", "theta_dot", {"r": 1}, "sqrt(k*exp(n*log(r/a))/m)/r", "k*(n + 2)*exp(n*log(r/a))/(m*r^2)")]),
    ("a bead on a whirled hoop; Taylor", HOOP, [
        ("holds", "Omega", {"theta": "30deg"}, "sqrt(g/(r*cos(theta)))", "g*sin(theta)^2/(r*cos(theta))")]),
    ("a hoop that turns about a point of its rim; Hand and Finch", HORIZONTAL_HOOP, [
        ("accelerations", {"phi_ddot": "-w^2*sin(phi)"}), ("modes", ["w^2"])]),
    ("a bead on an inclined wire that turns; Goldstein", INCLINED, [
        ("accelerations", {"s_ddot": "Omega^2*s*sin(alpha)^2 - g*cos(alpha)"}),
        ("equilibrium", {"s": "g*cos(alpha)/(Omega^2*sin(alpha)^2)"}),
        ("modes", ["-Omega^2*sin(alpha)^2"])]),
    ("slow and fast precession of a top; Goldstein", TOP, [
        ("holds", "phi_dot", {"theta": 0.5}, f"(C*psi_dot - {DISCRIMINANT})/(2*(A + m*l^2 - C)*cos(theta))", None)]),
    ("a pendulum on an arm that turns; Furuta", FURUTA, [
        ("conserved", {"p_phi": "(J + m*R^2 + 4/3*m*l^2*sin(theta)^2)*phi_dot + m*R*l*theta_dot*cos(theta)"}),
        ("modes", ["0", "3*g*(J + m*R^2)/(l*(4*J + m*R^2))"])]),
    ("a plank rocks on a cylinder; Morin", PLANK, [("modes", ["12*R*g/L^2"])]),
    ("two circuits with a common flux; Goldstein", CIRCUITS, [("modes", ["1/(C*(L + M))", "1/(C*(L - M))"])]),
]
