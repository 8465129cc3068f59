"""Textbook problems with rolling, blades, reactions and contacts that end."""

from short_scene import DOWN, DOWN_3D, G, particle, rigid, scene, turning

SPOOL = scene(
    "spool", f"m kg 2; R m 0.3; r m 0.1; J kg*m^2 0.05; F N 3; alpha rad 0.4; {G}", "x m; theta rad", gravity=DOWN,
    bodies=[rigid("m", "J", ["x", "R"], "-theta")],
    forces=[{"vector": ["F*cos(alpha)", "F*sin(alpha)"], "point": ["x", "R"]}, {"value": "-F*r", "along": "theta"}],
    constraints=[{"name": "rolling", "expression": "x_dot - R*theta_dot", "multiplier": "friction"}])

LADDER = scene(
    "ladder_at_a_wall", f"m kg 8; l m 2; {G}", "x m l*cos(1.2); y m l*sin(1.2); theta rad 1.2", gravity=DOWN,
    bodies=[rigid("m", "m*l^2/3", ["x", "y"], "theta")],
    constraints=[{"name": "wall", "expression": "x - l*cos(theta)", "multiplier": "W"},
                 {"name": "floor", "expression": "y - l*sin(theta)", "multiplier": "N"}],
    valid_while=[{"name": "wall_force", "unit": "N", "expression": "W", "reason": "leaves_wall",
                  "message": "The ladder leaves the wall."}])

HOOP = scene(
    "hoop_on_a_cylinder", f"m kg 1; R m 0.5; a m 0.1; {G}", "theta rad 0.001; phi rad; r m a+R", gravity=DOWN,
    bodies=[turning("ring", "m", "a", ["r*sin(theta)", "r*cos(theta)"], "-phi")],
    constraints=[{"name": "contact", "expression": "r - a - R", "multiplier": "N"},
                 {"name": "rolling", "expression": "a*phi_dot - (a + R)*theta_dot", "multiplier": "F"}],
    valid_while=[{"name": "normal", "unit": "N", "expression": "N", "reason": "leaves", "message": "It leaves."}])

SPHERE = scene(
    "particle_on_a_sphere", f"m kg 1; R m 0.5; {G}", "theta rad 0.000001", gravity=DOWN,
    held_lengths=[{"name": "rho", "unit": "m", "value": "R"}],
    bodies=[particle("m", "rho*sin(theta)", "rho*cos(theta)")],
    valid_while=[{"name": "normal", "unit": "N", "reaction": {"length": "rho", "sign": 1}, "reason": "leaves",
                  "message": "It leaves."}])

BLADE = scene(
    "blade_on_a_slope", f"m kg 1; J kg*m^2 0.2; alpha rad 0.3; {G}", "x m; y m; phi rad 0 1",
    bodies=[rigid("m", "J", ["x", "y"], "phi")], potential="-m*g*x*sin(alpha)",
    constraints=[{"name": "blade", "expression": "x_dot*sin(phi) - y_dot*cos(phi)"}])

BALL = scene(
    "ball_on_a_turntable", "m kg 0.1; r m 0.05; Omega rad/s 3",
    "x m; y m; a rad; b rad; c rad",
    bodies=[{"kind": "sphere", "name": "ball", "mass": "m", "radius": "r", "centre": ["x", "y", "r"],
             "orientation": {"sequence": "XYZ", "angles": ["a", "b", "c"]}}],
    constraints=[{"name": "along_x", "expression": "x_dot - r*(b_dot*cos(a) - c_dot*cos(b)*sin(a)) + Omega*y"},
                 {"name": "along_y", "expression": "y_dot + r*(a_dot + c_dot*sin(b)) - Omega*x"}])

DISC = scene(
    "rolling_disc", f"m kg 1; r m 0.3; w rad/s 5; {G}", "x m 0 -r*w; y m; psi rad; lean rad 0.2; phi rad 0 w",
    gravity=DOWN_3D,
    bodies=[{"kind": "disk", "mass": "m", "radius": "r",
             "centre": ["x + r*sin(lean)*sin(psi)", "y - r*sin(lean)*cos(psi)", "r*cos(lean)"],
             "orientation": {"rotations": [{"axis": ["0", "0", "1"], "angle": "psi"}, {"axis": ["1", "0", "0"], "angle": "lean"},
                                           {"axis": ["1", "0", "0"], "angle": "pi/2"}, {"axis": ["0", "0", "1"], "angle": "phi"}]}}],
    constraints=[{"name": "along", "expression": "x_dot + r*phi_dot*cos(psi)"},
                 {"name": "across", "expression": "y_dot + r*phi_dot*sin(psi)"}])

ROBOT = scene(
    "robot_on_two_wheels", "m kg 2; J kg*m^2 0.1; I kg*m^2 0.001; d m 0.2; r m 0.05; p N*m 0.02; q N*m 0.01",
    "x m; y m; th rad; a rad; b rad",
    lagrangian="m/2*(x_dot^2 + y_dot^2) + J/2*th_dot^2 + I/2*(a_dot^2 + b_dot^2)",
    constraints=[{"name": "lateral", "expression": "y_dot*cos(th) - x_dot*sin(th)"},
                 {"name": "right", "expression": "x_dot*cos(th) + y_dot*sin(th) + d*th_dot - r*a_dot"},
                 {"name": "left", "expression": "x_dot*cos(th) + y_dot*sin(th) - d*th_dot - r*b_dot"}],
    forces=[{"value": "p", "along": "a"}, {"value": "q", "along": "b"}])

PENDULUM = scene(
    "pendulum_by_a_constraint", f"m kg 1; l m 2; {G}", "x m 0; y m -l", gravity=DOWN, bodies=[particle("m", "x", "y")],
    constraints=[{"name": "string", "expression": "(x^2 + y^2 - l^2)/(2*l)", "multiplier": "N"}])

ATWOOD = scene(
    "machine_of_atwood_by_a_constraint", f"m1 kg 1; m2 kg 2; I kg*m^2 0.1; R m 0.2; {G}", "x m; y m; theta rad",
    gravity=DOWN,
    bodies=[particle("m1", "0", "-x"), particle("m2", "0", "-y"), rigid("m1", "I", ["0", "0"], "theta")],
    constraints=[{"name": "left", "expression": "x - R*theta", "multiplier": "A"},
                 {"name": "right", "expression": "y + R*theta", "multiplier": "B"}])

BOWLING = scene(
    "bowling_ball", f"m kg 6; r m 0.1; mu 1 0.2; v m/s 7; {G}", "x m 0 v; theta rad",
    bodies=[turning("sphere", "m", "r", ["x", "r"], "-theta")],
    forces=[{"value": "-mu*m*g*sign(x_dot - r*theta_dot)", "along": "x - r*theta"}])

BILLIARDS = scene(
    "unequal_balls", "m kg 1; M kg 2; d m 0.1; v m/s 1", "x m 0 v; y m 1", bodies=[particle("m", "x", "0"), particle("M", "y", "0")],
    events=[{"name": "hit", "expression": "y - x - d", "direction": "falling"}], impacts=[{"event": "hit", "restitution": "1"}])

COURT = scene(
    "ball_between_floor_and_wall", f"m kg 1; e 1 0.8; b m 2; {G}", "x m 0 1; y m 1", gravity=DOWN,
    bodies=[particle("m", "x", "y")],
    events=[{"name": "floor", "expression": "y", "direction": "falling"}, {"name": "wall", "expression": "b - x", "direction": "falling"}],
    impacts=[{"event": "floor", "restitution": "e"}, {"event": "wall", "restitution": "1"}])

FALL = "sqrt(2/g)"  # when the ball first meets the floor, a metre below

PROBLEMS = [
    ("a spool that is pulled; Irodov", SPOOL, [
        ("accelerations", {"x_ddot": "F*R*(R*cos(alpha) - r)/(J + m*R^2)",
                           "friction": "-F*(J*cos(alpha) + m*R*r)/(J + m*R^2)"})]),
    ("a ladder slides down a wall, and leaves it at two thirds of its height; Morin", LADDER, [
        ("accelerations", {"theta_ddot": "-3*g*cos(theta)/(4*l)",
                           "W": "m*cos(theta)*(3/4*g*sin(theta) - l*theta_dot^2)"}),
        ("ends", "leaves_wall", "theta", "asin(2/3*sin(6/5))")]),
    ("a hoop rolls off a cylinder at 60 degrees; Goldstein", HOOP, [
        ("accelerations", {"r_ddot": "0", "N": "m*(g*cos(theta) - r*theta_dot^2)"}),
        ("ends", "leaves", "theta", "acos(cos(1/1000)/2)")]),
    ("a particle leaves a sphere at a third of its radius; Goldstein", SPHERE, [
        ("ends", "leaves", "theta", "acos(2/3*cos(1/1000000))")]),
    ("a blade on a slope runs along a cycloid; Neimark and Fufaev", BLADE, [
        ("accelerations", {"lambda_blade": "-m*(phi_dot*(x_dot*cos(phi) + y_dot*sin(phi)) + g*sin(alpha)*sin(phi))"}),
        ("motion", 2, {"x": "g*sin(alpha)*sin(2)^2/2", "y": "g*sin(alpha)/2*(2 - sin(4)/2)", "phi": "2"})]),
    ("a ball on a turntable circles at two sevenths of its rate; Pars, Analytical Dynamics", BALL, [
        ("accelerations", {"x_ddot": "-2/7*Omega*y_dot", "y_ddot": "2/7*Omega*x_dot",
                           "lambda_along_x": "-2/7*m*Omega*y_dot"})]),
    ("a disc rolls and leans; SymPy's rolling disc", DISC, [
        ("accelerations", {"psi_ddot": "2*lean_dot*phi_dot/cos(lean)",
                           "lean_ddot": "(4*g*sin(lean)/r - 6*psi_dot*phi_dot*cos(lean) + 5*psi_dot^2*sin(lean)*cos(lean))/5",
                           "phi_ddot": "5/3*psi_dot*lean_dot*cos(lean) + 2*lean_dot*phi_dot*tan(lean)"})]),
    ("a robot on two wheels; Bloch", ROBOT, [
        ("accelerations", {"th_ddot": "d*r*(p - q)/(J*r^2 + 2*I*d^2)",
                           "lambda_lateral": "m*th_dot*(x_dot*cos(th) + y_dot*sin(th))"})]),
    ("a pendulum and the force in its string; SymPy's nonminimal pendulum", PENDULUM, [
        ("accelerations", {"N": "(m*g*y - m*(x_dot^2 + y_dot^2))*l/(x^2 + y^2)"})]),
    ("both forces in the string of Atwood's machine; Taylor", ATWOOD, [
        ("accelerations", {"x_ddot": "g*(m1 - m2)/(m1 + m2 + I/R^2)", "A": "-m1*g*(2*m2 + I/R^2)/(m1 + m2 + I/R^2)",
                           "B": "-m2*g*(2*m1 + I/R^2)/(m1 + m2 + I/R^2)"})]),
    ("a ball slides, and rolls with five sevenths of its speed; Sommerfeld", BOWLING, [
        ("motion", 3, {"x_dot": "5/7*v", "x": "12*v^2/(49*mu*g) + 5/7*v*(3 - 2*v/(7*mu*g))"})]),
    ("balls of unequal masses meet; Landau and Lifshitz", BILLIARDS, [
        ("motion", 2, {"x_dot": "v*(m - M)/(m + M)", "y_dot": "2*m*v/(m + M)", "x": "0.9 + 1.1*v*(m - M)/(m + M)"})]),
    ("a ball between a floor and a wall", COURT, [
        ("motion", 2.5, {"x": "2*b - 5/2", "y_dot": f"g*{FALL}*e^4 - g*(5/2 - {FALL}*(1 + 2*e + 2*e^2 + 2*e^3))"})]),
]
