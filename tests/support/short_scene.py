"""Scenes in a few lines: each parameter and coordinate is a text of words."""


def scene(name, parameters, coordinates, **members):
    """Parameters "name unit default" and coordinates "name unit initial rate", with semicolons between them."""
    return {"name": name,
            "parameters": [dict(zip(("name", "unit", "default"), words)) for words in lines(parameters)],
            "coordinates": [dict(zip(("name", "unit", "initial", "initial_rate"), words)) for words in lines(coordinates)],
            **members}


def lagrangian(name, parameters, coordinates, text, **members):
    """As a textbook prints it: everything is a number."""
    found = scene(name, parameters, coordinates, units="none", lagrangian=text, **members)
    for symbol in found["parameters"] + found["coordinates"]:
        del symbol["unit"]
    return found


def lines(text):
    return [line.split() for line in text.split(";") if line.strip()]


def particle(mass, *position):
    return {"kind": "particle", "mass": mass, "position": list(position)}


def rod(mass, start, end):
    return {"kind": "rod", "mass": mass, "start": start, "end": end}


def turning(kind, mass, radius, centre, angle):
    """A disk, ring, sphere, shell or cylinder in the plane."""
    return {"kind": kind, "mass": mass, "radius": radius, "centre": centre, "angle": angle}


def rigid(mass, inertia, centre, angle):
    return {"kind": "rigid_body", "mass": mass, "inertia": inertia, "centre": centre, "angle": angle}


G = "g m/s^2 9.81"
DOWN = ["0", "-g"]
DOWN_3D = ["0", "0", "-g"]
