"""One SVG for each motion: error against CPU time, both logarithmic. python3 plots.py FOLDER."""

import math
import pathlib
import sys

import points

WIDTH, HEIGHT = 760, 460
LEFT, RIGHT, TOP, BOTTOM = 70, 540, 40, 400  # of the axes
COLOURS = {"taylor": "#c00000", "erk": "#e07000", "adams": "#b8a000", "bdf": "#808000", "gauss": "#7030a0",
           "taylor_by_hand": "#000000", "boost_dopri5": "#004080", "boost_fehlberg78": "#0070c0",
           "boost_bulirsch_stoer": "#60b0e0", "gsl_rk8pd": "#006040", "gsl_rkf45": "#00a060", "gsl_msadams": "#70d0a0",
           "scipy_rk45": "#404040", "scipy_dop853": "#606060", "scipy_lsoda": "#808080", "scipy_radau": "#a0a0a0",
           "scipy_odeint": "#c0c0c0"}


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def power(exponent):
    return f'10<tspan dy="-5" font-size="9">{exponent}</tspan>'


def drawn_series(series):
    """Equations by hand where there are some: they are the harder peers."""
    return {method: points for (method, equations), points in series.items()
            if equations != "tape" or (method, "hand") not in series}


def plot(motion, series):
    chosen = {m: points.front(p) for m, p in drawn_series(series).items() if m in COLOURS}
    everything = [p for found in chosen.values() for p in found]
    x0, x1 = decades([us for _, us in everything])
    y0, y1 = decades([max(error, 1e-15) for error, _ in everything])

    def x(us):
        return LEFT + (RIGHT - LEFT)*(math.log10(us) - x0)/(x1 - x0)

    def y(error):
        return TOP + (BOTTOM - TOP)*(y1 - math.log10(max(error, 1e-15)))/(y1 - y0)

    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
           'font-size="12">', f'<rect width="{WIDTH}" height="{HEIGHT}" fill="#ffffff"/>',
           f'<text x="{LEFT}" y="24" font-size="15">{motion.replace("_", " ")}</text>']
    for k in range(x0, x1 + 1):
        out.append(f'<path d="M{x(10**k):.1f} {TOP}V{BOTTOM}" stroke="#e0e0e0"/>'
                   f'<text x="{x(10**k):.1f}" y="{BOTTOM + 20}" text-anchor="middle">{power(k)}</text>')
    for k in range(y0, y1 + 1):
        out.append(f'<path d="M{LEFT} {y(10.0**k):.1f}H{RIGHT}" stroke="#e0e0e0"/>')
        if k % 3 == 0:
            out.append(f'<text x="{LEFT - 8}" y="{y(10.0**k) + 4:.1f}" text-anchor="end">{power(k)}</text>')
    out.append(f'<text x="{(LEFT + RIGHT)/2:.0f}" y="{BOTTOM + 44}" text-anchor="middle">CPU time, us</text>'
               f'<text x="18" y="{(TOP + BOTTOM)/2:.0f}" text-anchor="middle" '
               f'transform="rotate(-90 18 {(TOP + BOTTOM)/2:.0f})">largest error, SI</text>')
    for place, (method, found) in enumerate((m, chosen[m]) for m in COLOURS if m in chosen):
        colour, is_own = COLOURS[method], method in points.OWN
        line = "M" + "L".join(f"{x(us):.1f} {y(error):.1f}" for error, us in found)
        dashes = ' stroke-dasharray="4 3"' if method.startswith("scipy") else ""
        style = f'fill="none" stroke="{colour}" stroke-width="{2.5 if is_own else 1.2}"{dashes}'
        out.append(f'<path d="{line}" {style}/>')
        out += [f'<circle cx="{x(us):.1f}" cy="{y(error):.1f}" r="2.5" fill="{colour}"/>' for error, us in found]
        height = TOP + 8 + 20*place
        out.append(f'<path d="M{RIGHT + 18} {height}h24" {style}/>'
                   f'<text x="{RIGHT + 50}" y="{height + 4}">{method.replace("_", " ")}</text>')
    return "\n".join(out + ["</svg>", ""])


def main():
    folder = pathlib.Path(sys.argv[1])
    for motion, series in points.read(folder).items():
        (folder / f"{motion}.svg").write_text(plot(motion, series), encoding="ascii")


if __name__ == "__main__":
    main()
