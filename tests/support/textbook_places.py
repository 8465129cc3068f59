"""Textbook problems whose place of rest takes some algebra, and problems in x and y, held by constraints."""

from short_scene import DOWN, DOWN_3D, G, lagrangian, particle, rigid, rod, scene, turning

PENDULUM = scene(
    "pendulum_in_x_and_y", f"m kg 1; l m 2; {G}", "x m 0.1; y m -1.9", gravity=DOWN, bodies=[particle("m", "x", "y")],
    constraints=[{"name": "string", "expression": "x^2 + y^2 - l^2"}])

DOUBLE_PENDULUM = scene(
    "double_pendulum_in_x_and_y", f"m kg 1; l m 1; {G}", "a m; b m -l; x m; y m -2*l", gravity=DOWN,
    bodies=[particle("m", "a", "b"), particle("m", "x", "y")],
    constraints=[{"name": "upper", "expression": "a^2 + b^2 - l^2"},
                 {"name": "lower", "expression": "(x - a)^2 + (y - b)^2 - l^2"}])

WIRE = scene("bead_on_a_wire", f"m kg 1; a 1/m 2; {G}", "x m; y m", gravity=DOWN, bodies=[particle("m", "x", "y")],
             constraints=[{"name": "wire", "expression": "y - a*x^2"}])

BOWL = scene(
    "particle_in_an_ellipsoid", f"m kg 1; a m 1; b m 2; c m 1.5; {G}", "x m; y m; z m -c", gravity=DOWN_3D,
    bodies=[particle("m", "x", "y", "z")], constraints=[{"name": "bowl", "expression": "x^2/a^2 + y^2/b^2 + z^2/c^2 - 1"}])

BALL = scene(
    "ball_that_rolls_in_a_bowl", f"m kg 1; R m 1; a m 0.2; {G}", "theta rad; phi rad", gravity=DOWN,
    bodies=[turning("sphere", "m", "a", ["(R - a)*sin(theta)", "-(R - a)*cos(theta)"], "phi")],
    constraints=[{"name": "rolling", "expression": "a*phi_dot + (R - a)*theta_dot"}])

CRANE = scene(
    "beam_below_a_trolley", f"M kg 2; m kg 1; k N/m 30; l m 1; {G}", "s m; x m 0; y m -l/2; theta rad", gravity=DOWN,
    bodies=[particle("M", "s", "0"), rigid("m", "m*l^2/12", ["x", "y"], "theta")], springs=[{"stiffness": "k", "length": "s"}],
    constraints=[{"name": "hinge_x", "expression": "x - s - l/2*sin(theta)"},
                 {"name": "hinge_y", "expression": "y + l/2*cos(theta)"}])
CRANE_ROOT = "sqrt((6*(M + m)*g + 4*l*k)^2 - 24*k*g*l*(4*M + m))"

ROPE = scene(
    "two_masses_on_a_rope_and_a_spring", f"m kg 1; M kg 2; k N/m 8; L m 3; {G}", "x m 1; y m 2; z m", gravity=DOWN,
    bodies=[particle("m", "0", "-x"), particle("M", "1", "-y"), particle("m", "z", "5*L")],
    springs=[{"stiffness": "k", "length": "x"}],
    constraints=[{"name": "rope", "expression": "x + y - L"}, {"name": "slider", "expression": "z - x"}])

FOUR_BARS = scene(
    "parallelogram_of_rods", f"m kg 1; l m 1; d m 1; {G}", "a rad; b rad; c rad", gravity=DOWN,
    bodies=[rod("m", ["0", "0"], ["l*sin(a)", "-l*cos(a)"]), rod("m", ["d", "0"], ["d + l*sin(b)", "-l*cos(b)"]),
            rod("m", ["l*sin(a)", "-l*cos(a)"], ["l*sin(a) + d*cos(c)", "-l*cos(a) + d*sin(c)"])],
    constraints=[{"name": "level", "expression": "l*sin(a) + d*cos(c) - d - l*sin(b)"},
                 {"name": "height", "expression": "l*cos(b) + d*sin(c) - l*cos(a)"}])

HANGING = scene(
    "two_masses_below_each_other", f"m kg 1; k N/m 30; l m 0.3; {G}", "x m 0.4; y m 0.8", gravity=DOWN,
    bodies=[particle("m", "0", "-x"), particle("m", "0", "-y")],
    springs=[{"stiffness": "k", "length": "x", "rest_length": "l"}, {"stiffness": "k", "length": "y - x", "rest_length": "l"}])

SPRING = scene(
    "spring_pendulum_in_x_and_y", f"m kg 1; k N/m 40; l0 m 0.5; {G}", "x m; y m -0.7", gravity=DOWN,
    bodies=[particle("m", "x", "y")], springs=[{"stiffness": "k", "between": [["0", "0"], ["x", "y"]], "rest_length": "l0"}])

ATOMS = scene("two_atoms", "m kg 1; E J 1; s m 1", "r m 1.1", bodies=[particle("m", "r", "0")],
              potential="4*E*((s/r)^12 - (s/r)^6)")

MOLECULE = scene("molecule_of_morse", "m kg 1; D J 1; a 1/m 2; b m 1", "r m 1.2", bodies=[particle("m", "r", "0")],
                 potential="D*(1 - exp(-a*(r - b)))^2")

MODEL = lagrangian("double_well", "a - 2; b - 3", "x - 1", "x_dot^2/2 + a*x^2/2 - b*x^4/4")

SPINNING_SPHERE = scene(
    "pendulum_of_a_spinning_sphere", f"m kg 1; r m 0.1; l m 0.5; {G}", "phi rad; theta rad 2.5; psi rad 0 30",
    gravity=DOWN_3D,
    bodies=[{"kind": "sphere", "mass": "m", "radius": "r",
             "centre": ["l*sin(theta)*sin(phi)", "-l*sin(theta)*cos(phi)", "l*cos(theta)"],
             "orientation": {"sequence": "ZXZ", "angles": ["phi", "theta", "psi"]}}])

WHEEL = lagrangian(
    "wheel_on_a_long_axle", "A - 1; C - 0.3; w - 40; G - 2", "theta - 1; phi -",
    "A/2*(theta_dot^2 + sin(theta)^2*phi_dot^2) + C/2*(w + phi_dot*cos(theta))^2 - G*cos(theta)")

UNEQUAL = scene(
    "double_pendulum_of_unequal_parts", f"m kg 1; M kg 2; a m 1; b m 0.5; {G}", "theta rad; phi rad", gravity=DOWN,
    bodies=[particle("m", "a*sin(theta)", "-a*cos(theta)"),
            particle("M", "a*sin(theta) + b*sin(phi)", "-a*cos(theta) - b*cos(phi)")])
UNEQUAL_ROOT = "sqrt((m + M)*((m + M)*(a + b)^2 - 4*m*a*b))"

DUFFING = lagrangian("oscillator_of_duffing", "a - 1; b - 1", "x - 0 1", "x_dot^2/2 - a*x^2/2 - b*x^4/4")
TILTED = lagrangian("tilted_pendulum", "m - 1; g - 9.81; l - 1; c - 0.3", "th - 0 0",
                    "m*l^2*th_dot^2/2 + m*g*l*cos(th - c)")
PLANET = lagrangian("planet", "k - 1", "r - 1 0; phi - 0 1.2", "(r_dot^2 + r^2*phi_dot^2)/2 + k/r")
CENTRE = lagrangian("spring_about_a_centre", "k - 1", "r - 1 0; phi - 0 0.5", "(r_dot^2 + r^2*phi_dot^2)/2 - k*r^2/2")

PROBLEMS = [
    ("a pendulum in x and y; SymPy's nonminimal pendulum", PENDULUM, [("modes", ["g/l"])]),
    ("a double pendulum in x and y; Drake's and Modelica's", DOUBLE_PENDULUM, [
        ("modes", ["(2 - sqrt(2))*g/l", "(2 + sqrt(2))*g/l"])]),
    ("a bead on a parabola by its wire; Goldstein", WIRE, [("modes", ["2*a*g"])]),
    ("a particle in an ellipsoid; Whittaker, Analytical Dynamics", BOWL, [("modes", ["g*c/b^2", "g*c/a^2"])]),
    ("a ball rolls in a bowl, by its constraint; Meriam", BALL, [("modes", ["5*g/(7*(R - a))"])]),
    ("a beam below a trolley, hinged by constraints; Meirovitch", CRANE, [
        ("modes", [f"(6*(M + m)*g + 4*l*k - {CRANE_ROOT})/(2*l*(4*M + m))",
                   f"(6*(M + m)*g + 4*l*k + {CRANE_ROOT})/(2*l*(4*M + m))"])]),
    ("two masses on a rope and a spring; one constraint has no force", ROPE, [("modes", ["k/(2*m + M)"])]),
    ("a parallelogram of rods; Drake's four bar linkage", FOUR_BARS, [("modes", ["6*g/(5*l)"])]),
    ("two masses hang below each other; French, Vibrations and Waves", HANGING, [
        ("modes", ["(3 - sqrt(5))*k/(2*m)", "(3 + sqrt(5))*k/(2*m)"])]),
    ("a spring pendulum in x and y; heyoka's elastic pendulum", SPRING, [("modes", ["k*g/(m*g + k*l0)", "k/m"])]),
    ("two atoms; Lennard-Jones", ATOMS, [("modes", ["36*2^(2/3)*E/(m*s^2)"])]),
    ("a molecule; Morse", MOLECULE, [("modes", ["2*D*a^2/m"])]),
    ("a double well; Jose and Saletan", MODEL, [("modes", ["2*a"])]),
    ("steady precession of a sphere on a rod", SPINNING_SPHERE, [
        ("holds", "phi_dot", {"theta": 2.5},
         "(r^2*psi_dot - sqrt(r^4*psi_dot^2 - 25*l^3*g*cos(theta)))/(5*l^2*cos(theta))", None)]),
    ("steady precession of a wheel whose spin is kept; Goldstein", WHEEL, [
        ("holds", "phi_dot", {"theta": 1}, "(C*w - sqrt(C^2*w^2 - 4*(A - C)*G*cos(theta)))/(2*(A - C)*cos(theta))", None)]),
    ("a double pendulum of unequal parts; Landau and Lifshitz", UNEQUAL, [
        ("modes", [f"g*((m + M)*(a + b) - {UNEQUAL_ROOT})/(2*m*a*b)", f"g*((m + M)*(a + b) + {UNEQUAL_ROOT})/(2*m*a*b)"])]),
    ("the amplitude of an oscillator; Duffing", DUFFING, [("amplitude", {"x_max": "sqrt((sqrt(a^2 + 2*b) - a)/b)"})]),
    ("a plane pendulum on an incline, pushed from where it hangs", TILTED, [
        ("amplitude", {"th_max": "2*c", "th_min": "0"}),
        ("amplitude", {"th_max": "c + acos(cos(c) - l/(8*g))", "th_min": "c - acos(cos(c) - l/(8*g))"},
         {"initial": {"th": 0, "th_dot": "0.5"}})]),
    ("the far end of an orbit; Taylor", PLANET, [("amplitude", {"r_max": "18/(25*k - 18)", "r_min": "1"})]),
    ("the near end of an orbit about a spring; Morin", CENTRE, [("amplitude", {"r_max": "1", "r_min": "1/(2*sqrt(k))"})]),
]
