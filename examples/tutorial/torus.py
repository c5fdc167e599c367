"""Writes torus.obj: a torus of trapezoids, each cut in two, with points moved along it. Many angles are obtuse."""

from math import cos, pi, sin

AROUND, THROUGH = 48, 20
with open("torus.obj", "w") as file:
    for i in range(AROUND):
        for j in range(THROUGH):
            u = 2 * pi * (i + 0.25 * sin(7 * i + 3 * j)) / AROUND
            v = 2 * pi * (j + 0.25 * cos(5 * i + 2 * j)) / THROUGH
            away = 1 + 0.4 * cos(v)
            file.write(f"v {away * cos(u)} {away * sin(u)} {0.4 * sin(v)}\n")
    for i in range(AROUND):
        for j in range(THROUGH):
            follows, up = (i + 1) % AROUND * THROUGH, (j + 1) % THROUGH
            a, b, c, d = i * THROUGH + j, follows + j, follows + up, i * THROUGH + up
            file.write(f"f {a + 1} {b + 1} {c + 1}\nf {a + 1} {c + 1} {d + 1}\n")
