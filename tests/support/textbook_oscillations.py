"""Textbook problems of small oscillations, two to six unknowns, and of what becomes unstable."""

from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, rod, scene, turning


def carts(count, potential, parameters="m kg 1; k N/m 2", mass="m"):
    names = "xyzw"[:count]
    return scene(f"carts_{count}", parameters, "; ".join(f"{name} m" for name in names), potential=potential,
                 bodies=[particle(mass, name, "0") for name in names])


HOOP_AND_BEAD = scene(
    "hoop_and_bead", f"M kg 1; m kg 1; r m 0.3; {G}", "theta rad 0.1; phi rad 0.2", gravity=DOWN,
    bodies=[turning("ring", "M", "r", ["r*sin(theta)", "-r*cos(theta)"], "theta"),
            particle("m", "r*sin(theta) + r*sin(phi)", "-r*cos(theta) - r*cos(phi)")])

THREE_PENDULUMS = lagrangian(
    "three_pendulums", "m - 1; l - 1; k - 2; g - 9.81", "a -; b -; c -",
    "m*l^2/2*(a_dot^2 + b_dot^2 + c_dot^2) + m*g*l*(cos(a) + cos(b) + cos(c)) - k*l^2/2*((a - b)^2 + (b - c)^2)")

THREE_DISKS = lagrangian(
    "three_disks_on_a_shaft", "J - 0.1; I - 0.3; K - 5", "a -; b -; c -",
    "J/2*(a_dot^2 + c_dot^2) + I/2*b_dot^2 - K/2*((a - b)^2 + (b - c)^2)")

UNEQUAL_DISKS = lagrangian(
    "unequal_disks_on_a_shaft", "J - 0.1; I - 0.3; N - 0.2; K - 5", "a -; b -; c -",
    "J/2*a_dot^2 + I/2*b_dot^2 + N/2*c_dot^2 - K/2*((a - b)^2 + (b - c)^2)")
UNEQUAL_ROOT = "sqrt((1/J + 2/I + 1/N)^2/4 - (J + I + N)/(J*I*N))"

UNEQUAL_PENDULUMS = scene(
    "unequal_pendulums", f"m1 kg 1; m2 kg 2; l m 1; k N/m 3; {G}", "a rad; b rad", gravity=DOWN,
    bodies=[particle("m1", "l*sin(a)", "-l*cos(a)"), particle("m2", "l*sin(b)", "-l*cos(b)")],
    potential="k*l^2/2*(sin(a) - sin(b))^2")

CART_AND_TWO_PENDULUMS = scene(
    "cart_and_two_pendulums", f"M kg 2; m kg 1; l m 0.5; {G}", "x m; a rad; b rad", gravity=DOWN,
    bodies=[particle("M", "x", "0"), particle("m", "x + l*sin(a)", "-l*cos(a)"), particle("m", "x + l*sin(b)", "-l*cos(b)")])

RING_OF_FOUR = scene(
    "ring_of_four", "m kg 1; k N/m 3; R m 1", "a rad; b rad; c rad; d rad",
    bodies=[particle("m", f"R*cos({name} + {i}*pi/2)", f"R*sin({name} + {i}*pi/2)") for i, name in enumerate("abcd")],
    potential="k*R^2/2*((b - a)^2 + (c - b)^2 + (d - c)^2 + (a - d)^2)")

TODA = lagrangian("toda_lattice", "", "x - 0.1; y - 0; z - -0.2",
                  "(x_dot^2 + y_dot^2 + z_dot^2)/2 - exp(x - y) - exp(y - z) - exp(z - x) + 3")

DOUBLE_PENDULUM = scene(
    "double_pendulum_of_equal_lengths", f"M kg 1; m kg 2; l m 1; {G}", "a rad; b rad", gravity=DOWN,
    bodies=[particle("M", "l*sin(a)", "-l*cos(a)"), particle("m", "l*sin(a) + l*sin(b)", "-l*cos(a) - l*cos(b)")])

ROD_ON_A_SHAFT = scene(
    "rod_on_a_shaft", f"m kg 1; l m 0.5; Omega rad/s 8; {G}", "theta rad 0.5", gravity=DOWN_3D,
    bodies=[rod("m", ["0", "0", "0"], ["l*sin(theta)*cos(Omega*t)", "l*sin(theta)*sin(Omega*t)", "-l*cos(theta)"])])

INVERTED = scene(
    "inverted_pendulum_between_springs", f"m kg 1; l m 1; a m 0.5; k N/m 50; {G}", "theta rad 0.1", gravity=DOWN,
    bodies=[particle("m", "l*sin(theta)", "l*cos(theta)")], potential="k*a^2*sin(theta)^2")

COLUMN = lagrangian(
    "column_of_two_rods", "l - 1; c - 1; P - 0.2; m - 1", "a - 0; b - 0",
    "m*l^2/2*(a_dot^2 + (a_dot + b_dot)^2) - c/2*a^2 - c/2*(b - a)^2 - P*l*(cos(a) + cos(b))")

ZIEGLER = scene(
    "column_with_a_following_force", "l m 1; c N*m 1; P N 1; m kg 1", "a rad 0; b rad 0",
    bodies=[particle("2*m", "l*cos(a)", "l*sin(a)"), particle("m", "l*cos(a) + l*cos(b)", "l*sin(a) + l*sin(b)")],
    springs=[{"stiffness": "c", "angle": "a"}, {"stiffness": "c", "angle": "b - a"}],
    forces=[{"vector": ["-P*cos(b)", "-P*sin(b)"], "point": ["l*cos(a) + l*cos(b)", "l*sin(a) + l*sin(b)"]}])

BEAD_AND_SPRING = scene(
    "bead_on_a_turning_rod", "m kg 1; k N/m 10; l0 m 0.5; w rad/s 2", "r m 0.6",
    bodies=[particle("m", "r*cos(w*t)", "r*sin(w*t)")], springs=[{"stiffness": "k", "length": "r", "rest_length": "l0"}])

SHEARED = scene(
    "mass_between_two_springs", f"m kg 1; k N/m 20; a m 0.5; b m 0.3", "y m 0.01",
    bodies=[particle("m", "0", "y")],
    springs=[{"stiffness": "k", "rest_length": "b", "between": [["a", "0"], ["0", "y"]]},
             {"stiffness": "k", "rest_length": "b", "between": [["-a", "0"], ["0", "y"]]}])

BIFILAR = scene("bifilar_pendulum", f"m kg 1; L m 1; d m 0.3; h m 0.8; {G}", "phi rad 0.1",
                lagrangian="m*L^2/24*phi_dot^2 + m*g*sqrt(h^2 - 2*d^2*(1 - cos(phi)))")

DUMBBELL = scene(
    "dumbbell_in_a_hoop", f"m1 kg 2; m2 kg 1; R m 1; beta rad 0.6; {G}", "theta rad 0.2", gravity=DOWN,
    bodies=[particle("m1", "R*sin(theta - beta)", "-R*cos(theta - beta)"),
            particle("m2", "R*sin(theta + beta)", "-R*cos(theta + beta)")])

THREE_SPRINGS = scene(
    "mass_between_three_springs", "m kg 1; k N/m 4; a m 1", "x m 0.01; y m", bodies=[particle("m", "x", "y")],
    springs=[{"stiffness": "k", "rest_length": "a", "between": [["x", "y"], [f"a*cos(2*pi*{i}/3)", f"a*sin(2*pi*{i}/3)"]]}
             for i in range(3)])

RINGS = scene(
    "cylinder_in_a_ring_that_rolls", f"M kg 2; m kg 1; R m 0.5; r m 0.2; {G}", "phi rad; theta rad 0.2", gravity=DOWN,
    bodies=[turning("ring", "M", "R", ["R*phi", "R"], "-phi"),
            turning("cylinder", "m", "r", ["R*phi + (R - r)*sin(theta)", "R - (R - r)*cos(theta)"],
                    "-phi*R/r - (R - r)/r*theta")])

HOOP_AND_SPRING = scene(
    "bead_on_a_hoop_with_a_spring", f"m kg 1; R m 0.5; k N/m 50; {G}", "th rad 0.3", gravity=DOWN,
    bodies=[particle("m", "R*sin(th)", "-R*cos(th)")],
    springs=[{"stiffness": "k", "rest_length": "R", "between": [["0", "R"], ["R*sin(th)", "-R*cos(th)"]]}])

PROBLEMS = [
    ("a hoop on a nail, and a bead on the hoop; Taylor, Classical Mechanics", HOOP_AND_BEAD, [
        ("modes", ["g/(2*r)", "g*(M + m)/(M*r)"])]),
    ("three carts between two walls; Morin, Classical Mechanics", carts(3, "k/2*(x^2 + (y - x)^2 + (z - y)^2 + z^2)"), [
        ("modes", ["(2 - sqrt(2))*k/m", "2*k/m", "(2 + sqrt(2))*k/m"])]),
    ("four carts between two walls", carts(4, "k/2*(x^2 + (y - x)^2 + (z - y)^2 + (w - z)^2 + w^2)"), [
        ("modes", ["(3 - sqrt(5))*k/(2*m)", "(5 - sqrt(5))*k/(2*m)", "(3 + sqrt(5))*k/(2*m)", "(5 + sqrt(5))*k/(2*m)"])]),
    ("three carts in a row, free; Marion and Thornton", carts(3, "k/2*((y - x)^2 + (z - y)^2)"), [
        ("modes", ["0", "k/m", "3*k/m"])]),
    ("two carts on a wall; Taylor", carts(2, "k/2*(x^2 + (y - x)^2)"), [
        ("modes", ["(3 - sqrt(5))*k/(2*m)", "(3 + sqrt(5))*k/(2*m)"])]),
    ("three pendulums with two springs; Goldstein", THREE_PENDULUMS, [
        ("modes", ["g/l", "k/m + g/l", "3*k/m + g/l"])]),
    ("two disks and a flywheel between them; Meirovitch", THREE_DISKS, [
        ("modes", ["0", "K/J", "K*(2/I + 1/J)"])]),
    ("three unequal disks on a shaft; den Hartog, Mechanical Vibrations", UNEQUAL_DISKS, [
        ("modes", ["0", f"K*((1/J + 2/I + 1/N)/2 - {UNEQUAL_ROOT})", f"K*((1/J + 2/I + 1/N)/2 + {UNEQUAL_ROOT})"])]),
    ("two pendulums of unequal masses; Taylor", UNEQUAL_PENDULUMS, [
        ("modes", ["g/l", "g/l + k/m1 + k/m2"])]),
    ("two pendulums on a cart", CART_AND_TWO_PENDULUMS, [("modes", ["0", "g/l", "g*(M + 2*m)/(M*l)"])]),
    ("four masses on a ring; Jose and Saletan", RING_OF_FOUR, [("modes", ["0", "2*k/m", "2*k/m", "4*k/m"])]),
    ("the periodic lattice of Toda", TODA, [
        ("conserved", {"momentum_x_y_z": "x_dot + y_dot + z_dot",
                       "h": "(x_dot^2 + y_dot^2 + z_dot^2)/2 + exp(x - y) + exp(y - z) + exp(z - x) - 3"})]),
    ("a double pendulum of equal lengths; Landau and Lifshitz", DOUBLE_PENDULUM, [
        ("modes", ["g/(M*l)*(M + m - sqrt((M + m)*m))", "g/(M*l)*(M + m + sqrt((M + m)*m))"])]),
    ("a rod on a turning shaft; Meirovitch", ROD_ON_A_SHAFT, [
        ("accelerations", {"theta_ddot": "sin(theta)*(Omega^2*cos(theta) - 3*g/(2*l))"}),
        ("critical", "Omega", 0.5, 12, ["sqrt(3*g/(2*l))"]),
        ("modes", ["Omega^2 - 9*g^2/(4*l^2*Omega^2)"])]),
    ("a pendulum that springs hold upright", INVERTED, [
        ("critical", "k", 1, 60, ["m*g*l/(2*a^2)"]),
        ("modes", ["2*a^2*k/(m*l^2) - g/l"], {"equilibrium": {"theta": 0}})]),
    ("a column of two rods buckles; Timoshenko", COLUMN, [
        ("critical", "P", 0.1, 4, ["(3 - sqrt(5))*c/(2*l)", "(3 + sqrt(5))*c/(2*l)"])]),
    ("a column under a force that follows it; Ziegler", ZIEGLER, [
        ("modes", ["(7*c - 2*l*P - sqrt(41*c^2 + 4*l*P*(l*P - 7*c)))/(4*l^2*m)",
                   "(7*c - 2*l*P + sqrt(41*c^2 + 4*l*P*(l*P - 7*c)))/(4*l^2*m)"])]),
    ("a bead and a spring on a turning rod; Irodov", BEAD_AND_SPRING, [
        ("accelerations", {"r_ddot": "w^2*r - k*(r - l0)/m"}),
        ("equilibrium", {"r": "k*l0/(k - m*w^2)"}),
        ("modes", ["k/m - w^2"])]),
    ("a mass across two stretched springs; French, Vibrations and Waves", SHEARED, [
        ("modes", ["2*k*(a - b)/(m*a)"])]),
    ("a rod on two strings; Pain, Vibrations and Waves", BIFILAR, [("modes", ["12*g*d^2/(L^2*h)"])]),
    ("a dumbbell in a hoop; Greenwood, Principles of Dynamics", DUMBBELL, [
        ("modes", ["g*sqrt(m1^2 + m2^2 + 2*m1*m2*cos(2*beta))/(R*(m1 + m2))"])]),
    ("a mass between three springs; French", THREE_SPRINGS, [("modes", ["3*k/(2*m)", "3*k/(2*m)"])]),
    ("a cylinder in a ring that rolls; Meirovitch", RINGS, [("modes", ["0", "g*(4*M + 3*m)/(6*M*(R - r))"])]),
    ("a bead that a spring draws to the top of its hoop", HOOP_AND_SPRING, [
        ("modes", ["-(k/(2*m) - g/R)"], {"equilibrium": {"th": 0}})]),
]
