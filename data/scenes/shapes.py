"""Triangles for the default scenes: boxes, cushions, surfaces of revolution, sheets.

A Mesh holds one primitive; shapes are added to it in metres, y up, front faces counter-clockwise.
"""
import math


def vec_sub(a, b):
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def normalize(a):
    length = math.sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2])
    return (a[0] / length, a[1] / length, a[2] / length) if length > 0 else (0.0, 1.0, 0.0)


class Placement:
    """A rotation about y, then a translation: where a shape goes inside its mesh."""

    def __init__(self, x=0.0, y=0.0, z=0.0, turn=0.0, tilt_x=0.0, tilt_z=0.0):
        """Degrees; tilts come first."""
        self.offset = (x, y, z)
        cy, sy = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        cx, sx = math.cos(math.radians(tilt_x)), math.sin(math.radians(tilt_x))
        cz, sz = math.cos(math.radians(tilt_z)), math.sin(math.radians(tilt_z))
        about_x = ((1, 0, 0), (0, cx, -sx), (0, sx, cx))
        about_z = ((cz, -sz, 0), (sz, cz, 0), (0, 0, 1))
        about_y = ((cy, 0, sy), (0, 1, 0), (-sy, 0, cy))
        self.rows = _product(about_y, _product(about_x, about_z))

    def direction(self, v):
        return tuple(r[0] * v[0] + r[1] * v[1] + r[2] * v[2] for r in self.rows)

    def point(self, p):
        d = self.direction(p)
        return (d[0] + self.offset[0], d[1] + self.offset[1], d[2] + self.offset[2])


def _product(a, b):
    return tuple(tuple(sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3))
                 for i in range(3))


HERE = Placement()


class Mesh:
    """Vertices and triangles of one material."""

    def __init__(self):
        self.positions, self.normals, self.uvs, self.colors = [], [], [], []
        self.indices = []

    def add(self, positions, normals, uvs, triangles, at=HERE, color=None):
        base = len(self.positions)
        self.positions += [at.point(p) for p in positions]
        self.normals += [normalize(at.direction(n)) for n in normals]
        self.uvs += uvs
        if color is not None:
            self.colors += [color] * len(positions)
        for triangle in triangles:
            self.indices += [base + i for i in triangle]

    # --- flat ------------------------------------------------------------------------------------

    def quad(self, a, b, c, d, uv=((0, 0), (1, 0), (1, 1), (0, 1)), at=HERE, color=None):
        """Corners counter-clockwise from the front."""
        n = normalize(cross(vec_sub(b, a), vec_sub(d, a)))
        self.add([a, b, c, d], [n] * 4, list(uv), [(0, 1, 2), (0, 2, 3)], at, color)

    def box(self, size, at=HERE, texel=1.0, grain=0, color=None):
        """Centred; texture coordinates are metres / texel, u along the axis `grain`."""
        half = [s / 2 for s in size]
        for axis in range(3):
            u_axis, v_axis = (axis + 1) % 3, (axis + 2) % 3
            for sign in (1, -1):
                corners = []
                for su, sv in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                    p = [0.0, 0.0, 0.0]
                    p[axis] = sign * half[axis]
                    p[u_axis] = su * half[u_axis]
                    p[v_axis] = sv * half[v_axis]
                    corners.append(tuple(p))
                along = grain if grain != axis else u_axis
                across = 3 - axis - along
                uv = [(p[along] / texel, p[across] / texel) for p in corners]
                if sign < 0:
                    corners.reverse()
                    uv.reverse()
                self.quad(*corners, uv=uv, at=at, color=color)

    # --- curved ----------------------------------------------------------------------------------

    def grid(self, columns, rows, point, at=HERE, color=None, uv_scale=(1.0, 1.0)):
        """point(u, v) -> position for u, v in 0..1; normals are the surface's own. The front is
        where v turns counter-clockwise from u."""
        positions = [point(i / columns, j / rows)
                     for j in range(rows + 1) for i in range(columns + 1)]
        uvs = [(i / columns * uv_scale[0], j / rows * uv_scale[1])
               for j in range(rows + 1) for i in range(columns + 1)]
        triangles = []
        for j in range(rows):
            for i in range(columns):
                a = j * (columns + 1) + i
                triangles += [(a, a + 1, a + columns + 2), (a, a + columns + 2, a + columns + 1)]
        self.smooth(positions, uvs, triangles, at, color)

    def smooth(self, positions, uvs, triangles, at=HERE, color=None):
        """Adds triangles with area-weighted normals, shared by vertices at equal positions."""
        sums, kept = {}, []
        keys = [tuple(round(c, 6) for c in p) for p in positions]
        for a, b, c in triangles:
            n = cross(vec_sub(positions[b], positions[a]), vec_sub(positions[c], positions[a]))
            if n[0] * n[0] + n[1] * n[1] + n[2] * n[2] < 1e-20:
                continue  # a pole of the surface
            kept.append((a, b, c))
            for corner in (a, b, c):
                s = sums.get(keys[corner], (0.0, 0.0, 0.0))
                sums[keys[corner]] = (s[0] + n[0], s[1] + n[1], s[2] + n[2])
        normals = [normalize(sums.get(key, (0.0, 1.0, 0.0))) for key in keys]
        self.add(positions, normals, uvs, kept, at, color)

    def lathe(self, profile, segments=48, at=HERE, crease=35.0, color=None):
        """Turns (radius, height) points about y. Walk the outside upwards; edges that turn by more
        than `crease` degrees stay sharp."""
        runs, run = [], [profile[0]]
        for i in range(1, len(profile)):
            run.append(profile[i])
            if i + 1 < len(profile):
                before = math.atan2(profile[i][1] - profile[i - 1][1],
                                    profile[i][0] - profile[i - 1][0])
                after = math.atan2(profile[i + 1][1] - profile[i][1],
                                   profile[i + 1][0] - profile[i][0])
                turn = abs((after - before + math.pi) % (2 * math.pi) - math.pi)
                if math.degrees(turn) > crease:
                    runs.append(run)
                    run = [profile[i]]
        runs.append(run)
        for run in runs:
            rows = len(run) - 1

            def point(u, v, run=run, rows=rows):
                r, y = run[round(v * rows)]
                # The last column closes on the first exactly.
                angle = 2 * math.pi * (round(u * segments) % segments) / segments
                return (r * math.cos(angle), y, -r * math.sin(angle))

            self.grid(segments, rows, point, at, color)

    def cylinder(self, radius, height, segments=24, at=HERE, top_radius=None, color=None):
        """Closed, from y = 0 to `height`."""
        top = radius if top_radius is None else top_radius
        self.lathe([(0, 0), (radius, 0), (top, height), (0, height)], segments, at, color=color)

    def sphere(self, radius, segments=32, at=HERE, color=None):
        rows = segments // 2
        self.lathe([(radius * math.sin(math.pi * j / rows), -radius * math.cos(math.pi * j / rows))
                    for j in range(rows + 1)], segments, at, crease=180.0, color=color)

    def cushion(self, size, radius, at=HERE, bulge=0.0, round_steps=4, core_steps=4, texel=0.5,
                color=None):
        """A box with rounded edges whose faces swell by `bulge` in the middle."""
        half = [s / 2 for s in size]

        def stations(axis):
            core = half[axis] - radius
            arc = [radius * math.tan(math.radians(45 * i / round_steps))
                   for i in range(round_steps + 1)]
            middle = [core * (2 * i / core_steps - 1) for i in range(1, core_steps)]
            return [-core - a for a in reversed(arc)] + middle + [core + a for a in arc]

        for axis in range(3):
            u_axis, v_axis = (axis + 1) % 3, (axis + 2) % 3
            us, vs = stations(u_axis), stations(v_axis)
            for sign in (1, -1):
                positions, uvs = [], []
                for v in vs:
                    for u in us:
                        p = [0.0, 0.0, 0.0]
                        p[axis], p[u_axis], p[v_axis] = sign * half[axis], u, v
                        core = [max(-(half[k] - radius), min(half[k] - radius, p[k]))
                                for k in range(3)]
                        n = normalize(vec_sub(p, core))
                        fullness = (1 - (u / half[u_axis]) ** 2) * (1 - (v / half[v_axis]) ** 2)
                        positions.append(tuple(
                            core[k] + radius * n[k]
                            + (sign * bulge * fullness if k == axis else 0.0) for k in range(3)))
                        uvs.append((u / texel, v / texel))
                columns = len(us)
                triangles = []
                for j in range(len(vs) - 1):
                    for i in range(columns - 1):
                        a = j * columns + i
                        quad = (a, a + 1, a + columns + 1, a + columns)
                        if sign < 0:
                            quad = quad[::-1]
                        triangles += [(quad[0], quad[1], quad[2]), (quad[0], quad[2], quad[3])]
                self.smooth(positions, uvs, triangles, at, color)

    def tube(self, path, radius, segments=12, at=HERE, color=None):
        """A round rod along a path of points that does not run along z throughout."""
        frames = []
        for i, p in enumerate(path):
            tangent = normalize(vec_sub(path[min(i + 1, len(path) - 1)], path[max(i - 1, 0)]))
            side = normalize(cross(tangent, (0.0, 0.0, 1.0)))
            frames.append((p, side, cross(tangent, side)))
        rows = len(path) - 1

        def point(u, v):
            p, side, up = frames[round(v * rows)]
            angle = 2 * math.pi * (round(u * segments) % segments) / segments
            c, s = radius * math.cos(angle), radius * math.sin(angle)
            return tuple(p[k] + c * side[k] + s * up[k] for k in range(3))

        self.grid(segments, rows, point, at, color)
