"""Textbook problems of machines, slopes and rolling, with the books' answers."""

from short_scene import DOWN, DOWN_3D, G, particle, rigid, rod, scene, turning

PULLEYS = scene(
    "pulley_within_pulley", f"m1 kg 4; m2 kg 1; m3 kg 2; {G}", "x m; y m", gravity=DOWN,
    bodies=[particle("m1", "0", "-x"), particle("m2", "0", "x - y"), particle("m3", "0", "x + y")])

DOUBLE_WEDGE = scene(
    "double_wedge", f"M kg 3; m1 kg 1; m2 kg 0.7; l m 2; alpha rad 0.5; beta rad 0.6; {G}", "x m; s m 0.3", gravity=DOWN,
    bodies=[particle("M", "x", "0"), particle("m1", "x - s*cos(alpha)", "-s*sin(alpha)"),
            particle("m2", "x + (l - s)*cos(beta)", "-(l - s)*sin(beta)")])

CYLINDER_ON_WEDGE = scene(
    "cylinder_on_wedge", f"M kg 3; m kg 1; r m 0.1; alpha rad 0.5; {G}", "x m; s m", gravity=DOWN,
    bodies=[particle("M", "x", "0"),
            turning("cylinder", "m", "r", ["x + s*cos(alpha)", "-s*sin(alpha)"], "-s/r")])

ROD_IN_BOWL = scene(
    "rod_in_bowl", f"m kg 1; a m 0.3; r m 0.5; {G}", "theta rad 0.1", gravity=DOWN,
    bodies=[rod("m", ["sqrt(r^2 - a^2)*sin(theta) - a*cos(theta)", "-sqrt(r^2 - a^2)*cos(theta) - a*sin(theta)"],
                ["sqrt(r^2 - a^2)*sin(theta) + a*cos(theta)", "-sqrt(r^2 - a^2)*cos(theta) + a*sin(theta)"])])

HALF_MOMENT = "m*r^2*(1/2 - 16/(9*pi^2))"
ROCKING_HALF_CYLINDER = scene(
    "rocking_half_cylinder", f"m kg 1; r m 0.2; {G}", "theta rad 0.2", gravity=DOWN,
    bodies=[rigid("m", HALF_MOMENT, ["r*theta - 4*r/(3*pi)*sin(theta)", "r - 4*r/(3*pi)*cos(theta)"], "-theta")])
HALF_CYLINDER_ON_ICE = scene(
    "half_cylinder_on_ice", f"m kg 1; r m 0.2; {G}", "x m; theta rad 0.2", gravity=DOWN,
    bodies=[rigid("m", HALF_MOMENT, ["x", "r - 4*r/(3*pi)*cos(theta)"], "-theta")])

LOADED_HOOP = scene(
    "loaded_hoop", f"M kg 1; m kg 0.5; r m 0.3; {G}", "theta rad 1", gravity=DOWN,
    bodies=[turning("ring", "M", "r", ["r*theta", "r"], "-theta"),
            particle("m", "r*theta - r*sin(theta)", "r - r*cos(theta)")])

CUBE_ON_CYLINDER = scene(
    "cube_on_cylinder", f"m kg 1; b m 0.1; r m 0.2; {G}", "theta rad 0.1", gravity=DOWN,
    bodies=[{"kind": "box", "mass": "m", "width": "2*b", "height": "2*b", "angle": "-theta",
             "centre": ["(r + b)*sin(theta) - r*theta*cos(theta)", "(r + b)*cos(theta) + r*theta*sin(theta)"]}])

BALL_IN_BOWL = scene(
    "ball_in_bowl", f"m kg 1; R m 0.5; r m 0.1; {G}", "theta rad 0.1", gravity=DOWN,
    bodies=[turning("sphere", "m", "r", ["(R - r)*sin(theta)", "-(R - r)*cos(theta)"], "-(R - r)*theta/r")])

ROPE = scene("rope_over_an_edge", f"m kg 1; l m 2; {G}", "x m 0.1", potential="-m*g*x^2/(2*l)",
             bodies=[particle("m", "x", "0")])

WRAPPING = scene(
    "string_round_a_cylinder", f"m kg 1; l m 1; R m 0.2; {G}", "phi rad 0.3", gravity=DOWN,
    bodies=[particle("m", "R*cos(phi) + (l + R*phi)*sin(phi)", "R*sin(phi) - (l + R*phi)*cos(phi)")])

CAR = scene("pendulum_in_a_car", f"m kg 1; l m 0.5; a m/s^2 3; {G}", "phi rad 0.1", gravity=DOWN,
            bodies=[particle("m", "a*t^2/2 + l*sin(phi)", "-l*cos(phi)")])

SHORTENED = scene("shortened_pendulum", f"m kg 1; l0 m 1; v m/s 0.1; {G}", "phi rad 0.1", gravity=DOWN,
                  bodies=[particle("m", "(l0 - v*t)*sin(phi)", "-(l0 - v*t)*cos(phi)")])

DISK_PENDULUM = scene(
    "disk_on_a_bearing", f"M kg 1; m kg 0.5; l m 0.6; r m 0.1; {G}", "theta rad 0.3; psi rad", gravity=DOWN,
    bodies=[rod("m", ["0", "0"], ["l*sin(theta)", "-l*cos(theta)"]),
            turning("disk", "M", "r", ["l*sin(theta)", "-l*cos(theta)"], "psi")])

PULLEY_WITH_SPRING = scene(
    "pulley_with_spring", f"M kg 2; m kg 1; R m 0.2; k N/m 50; {G}", "theta rad", gravity=DOWN,
    bodies=[turning("disk", "M", "R", ["0", "0"], "theta"), particle("m", "R", "R*theta")],
    springs=[{"stiffness": "k", "length": "R*theta"}])

ELEVATOR = scene("pendulum_in_an_elevator", f"m kg 1; l m 0.5; a m/s^2 2; {G}", "phi rad 0.3", gravity=DOWN,
                 bodies=[particle("m", "l*sin(phi)", "a*t^2/2 - l*cos(phi)")])

HELIX = scene("bead_on_a_helix", f"m kg 1; R m 0.3; c m 0.1; {G}", "th rad", gravity=DOWN_3D,
              bodies=[particle("m", "R*cos(th)", "R*sin(th)", "-c*th")])

PROBLEMS = [
    ("a pulley within a pulley; Landau and Lifshitz, Mechanics", PULLEYS, [
        ("accelerations", {"x_ddot": "g*(m1*(m2 + m3) - 4*m2*m3)/(m1*(m2 + m3) + 4*m2*m3)",
                           "y_ddot": "2*m1*(m2 - m3)*g/(m1*(m2 + m3) + 4*m2*m3)"})]),
    ("two masses over the top of a wedge that slides; Greiner", DOUBLE_WEDGE, [
        ("accelerations", {"s_ddot": "(M + m1 + m2)*g*(m1*sin(alpha) - m2*sin(beta))/((M + m1 + m2)*(m1 + m2)"
                                     " - (m1*cos(alpha) + m2*cos(beta))^2)"}),
        ("conserved", {"p_x": "(M + m1 + m2)*x_dot - (m1*cos(alpha) + m2*cos(beta))*s_dot"})]),
    ("a cylinder rolls down a wedge that slides", CYLINDER_ON_WEDGE, [
        ("accelerations", {"s_ddot": "2*(M + m)*g*sin(alpha)/(3*(M + m) - 2*m*cos(alpha)^2)",
                           "x_ddot": "-m*g*sin(2*alpha)/(3*(M + m) - 2*m*cos(alpha)^2)"})]),
    ("a rod slides in a smooth bowl", ROD_IN_BOWL, [
        ("accelerations", {"theta_ddot": "-3*g*sqrt(r^2 - a^2)*sin(theta)/(3*r^2 - 2*a^2)"}),
        ("modes", ["3*g*sqrt(r^2 - a^2)/(3*r^2 - 2*a^2)"])]),
    ("half a cylinder rocks on a rough plane; Landau and Lifshitz", ROCKING_HALF_CYLINDER, [
        ("modes", ["8*g/((9*pi - 16)*r)"])]),
    ("half a cylinder rocks on ice", HALF_CYLINDER_ON_ICE, [("modes", ["0", "24*pi*g/((9*pi^2 - 32)*r)"])]),
    ("a hoop with a mass on its rim rolls", LOADED_HOOP, [
        ("accelerations", {"theta_ddot": "-m*sin(theta)*(r*theta_dot^2 + g)/(2*r*(M + m*(1 - cos(theta))))"}),
        ("modes", ["m*g/(2*M*r)"]),
        ("turning", {"theta_max": "1", "theta_min": "-1"})]),
    ("a cube balances on a cylinder until it is as large; Taylor, Classical Mechanics", CUBE_ON_CYLINDER, [
        ("critical", "b", 0.05, 0.4, ["r"]),
        ("modes", ["3*g*(r - b)/(5*b^2)"])]),
    ("a ball rolls in a bowl", BALL_IN_BOWL, [
        ("accelerations", {"theta_ddot": "-5*g*sin(theta)/(7*(R - r))"}),
        ("modes", ["5*g/(7*(R - r))"])]),
    ("a rope slides over an edge", ROPE, [
        ("accelerations", {"x_ddot": "g*x/l"}),
        ("modes", ["-g/l"]),
        ("motion", 1, {"x": "cosh(sqrt(g/l))/10"})]),
    ("a string winds round a cylinder", WRAPPING, [
        ("accelerations", {"phi_ddot": "-(R*phi_dot^2 + g*sin(phi))/(l + R*phi)"}),
        ("modes", ["g/l"])]),
    ("a pendulum in a car that accelerates; Taylor", CAR, [
        ("accelerations", {"phi_ddot": "-(g*sin(phi) + a*cos(phi))/l"}),
        ("amplitude", {"phi_max": "0", "phi_min": "-2*atan(a/g)"}, {"initial": {"phi": 0}}),
        ("modes", ["sqrt(g^2 + a^2)/l"])]),
    ("a pendulum whose string is drawn in", SHORTENED, [
        ("accelerations", {"phi_ddot": "(2*v*phi_dot - g*sin(phi))/(l0 - v*t)"})]),
    ("a pendulum with a disk on a bearing", DISK_PENDULUM, [
        ("accelerations", {"theta_ddot": "-g*(M + m/2)*sin(theta)/(l*(M + m/3))"}),
        ("modes", ["0", "3*g*(2*M + m)/(2*l*(3*M + m))"])]),
    ("a mass on a pulley with a spring", PULLEY_WITH_SPRING, [
        ("equilibrium", {"theta": "-m*g/(k*R)"}),
        ("modes", ["2*k/(M + 2*m)"])]),
    ("a pendulum in an elevator; Morin", ELEVATOR, [
        ("accelerations", {"phi_ddot": "-(g + a)*sin(phi)/l"}), ("modes", ["(g + a)/l"]),
        ("conserved", {"h": "m*l^2*phi_dot^2/2 - m*l*(g + a)*cos(phi)"}),
        ("turning", {"phi_max": "3/10", "phi_min": "-3/10"})]),
    ("a bead on a helix; Marion and Thornton", HELIX, [
        ("accelerations", {"th_ddot": "c*g/(R^2 + c^2)"}),
        ("motion", 2, {"th": "2*c*g/(R^2 + c^2)", "th_dot": "2*c*g/(R^2 + c^2)"})]),
]
