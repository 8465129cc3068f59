"""Textbook problems of charges in fields, frames that turn, relativity, drag and friction of fluids."""

from short_scene import DOWN, G, lagrangian, particle, scene

DARWIN = scene("charge_in_a_well_and_a_field", "m kg 1; q C 2; B T 1.5; w rad/s 2", "x m 0.1; y m",
               lagrangian="m/2*(x_dot^2 + y_dot^2) + q*B/2*(x*y_dot - y*x_dot) - m*w^2/2*(x^2 + y^2)")

PENNING = scene(
    "trap_of_penning", "m kg 1; q C 1; B T 3; w rad/s 1", "x m 0.1; y m; z m 0.1",
    lagrangian="m/2*(x_dot^2 + y_dot^2 + z_dot^2) + q*B/2*(x*y_dot - y*x_dot) - m*w^2/4*(2*z^2 - x^2 - y^2)")
PENNING_ROOT = "q*B*sqrt(q^2*B^2 - 2*m^2*w^2)"

CROSSED = scene("crossed_fields", "m kg 1; q C 1; B T 2; E V/m 3", "x m; y m",
                lagrangian="m/2*(x_dot^2 + y_dot^2) + q*B*x*y_dot + q*E*y")

TURNTABLE = scene(
    "mass_on_springs_on_a_turntable", "m kg 1; k N/m 10; Omega rad/s 2", "u m 0.1; v m",
    bodies=[particle("m", "u*cos(Omega*t) - v*sin(Omega*t)", "u*sin(Omega*t) + v*cos(Omega*t)")], potential="k/2*(u^2 + v^2)")

DIPOLE = lagrangian("charge_near_a_dipole", "", "r - 1.2 0; z - 0.1 0; phi - 0 0.5",
                    "(r_dot^2 + z_dot^2 + r^2*phi_dot^2)/2 + r^2*phi_dot/(r^2 + z^2)^(3/2)")

BOTTLE = scene("magnetic_bottle", "m kg 1; q C 1; B T 5; L m 2", "r m 0.3 0; phi rad 0 2; z m 0.1 0.1",
               lagrangian="m/2*(r_dot^2 + r^2*phi_dot^2 + z_dot^2) + q*B/2*(1 + z^2/L^2)*r^2*phi_dot")

FAST_SPRING = lagrangian("fast_oscillator", "", "x - 0.5 0", "-sqrt(1 - x_dot^2) - x^2/2")
FAST_FALL = lagrangian("fast_fall", "F - 1", "x - 0 0", "-sqrt(1 - x_dot^2) + F*x")
FAST_KEPLER = lagrangian("fast_kepler", "k - 0.1", "r - 1 0; th - 0 0.3", "-sqrt(1 - r_dot^2 - r^2*th_dot^2) + k/r")
HOLE = lagrangian("schwarzschild", "M - 1", "T - 0 1.2; r - 10 0; phi - 0 0.04",
                  "(-(1 - 2*M/r)*T_dot^2 + r_dot^2/(1 - 2*M/r) + r^2*phi_dot^2)/2")

CALDIROLA = scene("caldirola", "m kg 1; b kg/s 0.3; k N/m 5", "x m 0.1", lagrangian="exp(b*t/m)*(m*x_dot^2/2 - k*x^2/2)")

DRAG = scene("fall_with_drag", f"m kg 1; c kg/m 0.2; {G}", "y m 0 0", bodies=[particle("m", "0", "y")], gravity=DOWN,
             dampers=[{"law": "quadratic", "coefficient": "c", "point": ["0", "y"]}])

JEFFCOTT = scene("rotor_of_jeffcott", "m kg 1; k N/m 100; e m 0.01; w rad/s 5", "x m; y m",
                 bodies=[particle("m", "x + e*cos(w*t)", "y + e*sin(w*t)")], potential="k/2*(x^2 + y^2)")

BELT = scene("mass_on_a_belt", f"m kg 1; k N/m 20; mu 1 0.3; v m/s 0.5; {G}", "x m 0 0.5", bodies=[particle("m", "x", "0")],
             springs=[{"stiffness": "k", "length": "x"}], forces=[{"value": "-mu*m*g*sign(x_dot - v)", "along": "x"}])

MOTOR = lagrangian(
    "motor", "J - 0.1; L - 0.5; R - 1; K - 0.2; V - 12; b - 0.01", "q - 0 0; th - 0 0", "L*q_dot^2/2 + J*th_dot^2/2",
    forces=[{"value": "V - R*q_dot - K*th_dot", "along": "q"}, {"value": "K*q_dot - b*th_dot", "along": "th"}])

ROCKET = lagrangian("mass_that_is_lost", "m - 10; b - 0.1; g - 9.81", "y - 0 5", "(m - b*t)*y_dot^2/2 - (m - b*t)*g*y")

QUARTIC = lagrangian("quartic_in_the_velocity", "m - 1; k - 2", "x - 0.3 0.1",
                     "m^2*x_dot^4/12 + m*x_dot^2*(k*x^2/2) - (k*x^2/2)^2")

WEBER = lagrangian("law_of_weber", "k - 1; c - 3", "r - 1 0; phi - 0 1",
                   "(r_dot^2 + r^2*phi_dot^2)/2 + k/r*(1 + r_dot^2/(2*c^2))")

SCREW = lagrangian("field_of_a_screw", "k - 2; a - 3", "r - 0.4; phi - 0.1; z - 0.2",
                   "(r_dot^2 + r^2*phi_dot^2 + z_dot^2)/2 - k*r^2*(2 + cos(phi - a*z))")

PARABOLA = lagrangian("parabola_that_turns", "a - 1; w - 3; g - 9.81", "r - 0.2",
                      "((1 + 4*a^2*r^2)*r_dot^2 + w^2*r^2)/2 - a*g*r^2")

PROBLEMS = [
    ("a Lagrangian with the fourth power of the velocity; Goldstein 1.20", QUARTIC, [
        ("accelerations", {"x_ddot": "-k*x/m"}),
        ("conserved", {"h": "(m*x_dot^2/2 + k*x^2/2)^2"})]),
    ("electrodynamics of Weber; Goldstein 1", WEBER, [
        ("accelerations", {"r_ddot": "(r*phi_dot^2 - k/r^2*(1 - r_dot^2/(2*c^2)))/(1 + k/(c^2*r))"}),
        ("conserved", {"p_phi": "r^2*phi_dot"})]),
    ("a field with the symmetry of a screw; Goldstein 2.19", SCREW, [
        ("conserved", {"momentum_phi_z": "z_dot + a*r^2*phi_dot"})]),
    ("a bead on a parabola that turns; Goldstein 1", PARABOLA, [("modes", ["2*a*g - w^2"])]),
    ("a charge in a well and a field; Fock and Darwin", DARWIN, [
        ("accelerations", {"x_ddot": "q*B*y_dot/m - w^2*x", "y_ddot": "-q*B*x_dot/m - w^2*y"}),
        ("modes", ["(sqrt(w^2 + (q*B/(2*m))^2) - q*B/(2*m))^2", "(sqrt(w^2 + (q*B/(2*m))^2) + q*B/(2*m))^2"])]),
    ("a trap of Penning; Brown and Gabrielse", PENNING, [
        ("modes", [f"(q^2*B^2 - m^2*w^2 - {PENNING_ROOT})/(2*m^2)", "w^2", f"(q^2*B^2 - m^2*w^2 + {PENNING_ROOT})/(2*m^2)"])]),
    ("a charge in crossed fields runs along a cycloid; Jackson", CROSSED, [
        ("motion", 3, {"x": "E/B*(3 - sin(q*B/m*3)/(q*B/m))", "y": "E/B*(1 - cos(q*B/m*3))/(q*B/m)"})]),
    ("springs on a turntable; Morin", TURNTABLE, [
        ("accelerations", {"u_ddot": "Omega^2*u + 2*Omega*v_dot - k*u/m"}),
        ("modes", ["(sqrt(k/m) - Omega)^2", "(sqrt(k/m) + Omega)^2"])]),
    ("a charge near a dipole; Stoermer", DIPOLE, [
        ("accelerations", {"r_ddot": "r*phi_dot*(phi_dot + (2*z^2 - r^2)/(r^2 + z^2)^(5/2))",
                           "z_ddot": "-3*r^2*z*phi_dot/(r^2 + z^2)^(5/2)"}),
        ("conserved", {"p_phi": "r^2*(phi_dot + 1/(r^2 + z^2)^(3/2))"})]),
    ("a charge in a magnetic bottle; Jackson", BOTTLE, [
        ("accelerations", {"z_ddot": "q*B*r^2*z*phi_dot/(m*L^2)", "r_ddot": "r*phi_dot*(phi_dot + q*B/m*(1 + z^2/L^2))"})]),
    ("a relativistic oscillator; Goldstein", FAST_SPRING, [
        ("accelerations", {"x_ddot": "-x*(1 - x_dot^2)^(3/2)"}), ("conserved", {"h": "1/sqrt(1 - x_dot^2) + x^2/2"}),
        ("modes", ["1"])]),
    ("a constant force; Landau and Lifshitz, Fields", FAST_FALL, [
        ("accelerations", {"x_ddot": "F*(1 - x_dot^2)^(3/2)"}), ("motion", 3, {"x": "sqrt(10) - 1", "x_dot": "3/sqrt(10)"})]),
    ("a relativistic planet; Landau and Lifshitz, Fields", FAST_KEPLER, [
        ("accelerations", {"th_ddot": "r_dot*th_dot*(k*sqrt(1 - r_dot^2 - r^2*th_dot^2)/r - 2)/r"}),
        ("conserved", {"h": "1/sqrt(1 - r_dot^2 - r^2*th_dot^2) - k/r", "p_th": "r^2*th_dot/sqrt(1 - r_dot^2 - r^2*th_dot^2)"})]),
    ("a planet about a black hole; Hartle, Gravity", HOLE, [
        ("accelerations", {"r_ddot": "-M/r^2*(1 - 2*M/r)*T_dot^2 + M*r_dot^2/(r^2*(1 - 2*M/r)) + (r - 2*M)*phi_dot^2"}),
        ("conserved", {"p_T": "-(1 - 2*M/r)*T_dot", "p_phi": "r^2*phi_dot"})]),
    ("damping by a Lagrangian; Caldirola and Kanai", CALDIROLA, [("accelerations", {"x_ddot": "-(k*x + b*x_dot)/m"})]),
    ("a fall with drag; Taylor", DRAG, [
        ("accelerations", {"y_ddot": "-g - c*y_dot*abs(y_dot)/m"}),
        ("motion", 3, {"y": "-m/c*log(cosh(3*sqrt(g*c/m)))", "y_dot": "-sqrt(m*g/c)*sinh(3*sqrt(g*c/m))/cosh(3*sqrt(g*c/m))"})]),
    ("an unbalanced rotor; Jeffcott", JEFFCOTT, [
        ("accelerations", {"x_ddot": "e*w^2*cos(w*t) - k*x/m"}),
        ("motion", 2, {"x": "e*w^2/(k/m - w^2)*(cos(2*w) - cos(2*sqrt(k/m)))"})]),
    ("a mass on a belt slips where the spring is stronger; Andronov", BELT, [("equilibrium", {"x": "mu*m*g/k"})]),
    ("a motor comes to its speed; Modelica's examples", MOTOR, [
        ("conserved", {"momentum_q": "L*q_dot + R*q + K*th - V*t"}),
        ("accelerations", {"q_ddot": "(V - R*q_dot - K*th_dot)/L", "th_ddot": "(K*q_dot - b*th_dot)/J"})]),
    ("a mass that is lost on the way", ROCKET, [("accelerations", {"y_ddot": "b*y_dot/(m - b*t) - g"})]),
]
