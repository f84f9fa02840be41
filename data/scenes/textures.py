"""Textures of the furnished interior, drawn from noise and arithmetic; sRGB, 8 bits."""
import math

from writer import png


def _hash(x, y, seed):
    """0..1 from a lattice point; the constants are odd 32-bit numbers without structure."""
    h = (x * 374761393 + y * 668265263 + seed * 2246822519) & 0xFFFFFFFF
    h = ((h ^ (h >> 13)) * 1274126177) & 0xFFFFFFFF
    return ((h ^ (h >> 16)) & 0xFFFF) / 65535


def noise(x, y, seed, period_x, period_y):
    """Value noise that repeats every `period_*` lattice steps."""
    ix, iy = math.floor(x), math.floor(y)
    fx, fy = x - ix, y - iy
    fx, fy = fx * fx * (3 - 2 * fx), fy * fy * (3 - 2 * fy)
    x0, x1 = ix % period_x, (ix + 1) % period_x
    y0, y1 = iy % period_y, (iy + 1) % period_y
    a = _hash(x0, y0, seed) * (1 - fx) + _hash(x1, y0, seed) * fx
    b = _hash(x0, y1, seed) * (1 - fx) + _hash(x1, y1, seed) * fx
    return a * (1 - fy) + b * fy


def _mix(a, b, t):
    return tuple(x * (1 - t) + y * t for x, y in zip(a, b))


def _image(width, height, channels, texel):
    rows = []
    for y in range(height):
        row = bytearray()
        for x in range(width):
            value = texel(x / width, y / height)
            row += bytes(max(0, min(255, int(c * 255 + 0.5)))
                         for c in (value if channels == 3 else (value,)))
        rows.append(bytes(row))
    return png(width, height, channels, rows)


def _grain(u, v, seed):
    """Fibres along u: 0..1."""
    waves = noise(u * 3, v * 6, seed, 3, 6)
    rings = 0.5 + 0.5 * math.sin(2 * math.pi * (v * 9 + 1.6 * waves))
    fibre = noise(u * 10, v * 160, seed + 1, 10, 160)
    return 0.5 * rings + 0.5 * fibre


def wood():
    light, dark = (0.80, 0.66, 0.50), (0.58, 0.42, 0.28)
    return _image(256, 256, 3, lambda u, v: _mix(light, dark, _grain(u, v, 3)))


BOARDS = 8  # across the floor texture


def _board(u, v):
    """Which board, the position along and across it, and the distance to its nearest gap."""
    row = int(v * BOARDS)
    shift = _hash(row, 0, 11)
    along = (u + shift) * 2
    number = int(along) % 2 + 2 * row
    across = v * BOARDS - row
    gap = min(across, 1 - across) / BOARDS
    end = min(along % 1, 1 - along % 1) / 2
    return number, gap, end


def floor():
    """Oak boards, 2 m of them along u and across v."""
    def texel(u, v):
        number, gap, end = _board(u, v)
        tone = _hash(number, 1, 5)
        color = _mix(_mix((0.74, 0.56, 0.37), (0.58, 0.40, 0.24), tone),
                     (0.42, 0.27, 0.15), 0.55 * _grain(u, (v * 1.7 + tone) % 1, 20 + number))
        return _mix((0.10, 0.06, 0.03), color, 1.0 if gap > 0.002 and end > 0.0015 else 0.25)
    return _image(512, 512, 3, texel)


def floor_roughness():
    """glTF keeps roughness in green: varnish 0.3 to 0.5, gaps rough."""
    def texel(u, v):
        number, gap, end = _board(u, v)
        rough = 0.30 + 0.10 * _hash(number, 2, 5) + 0.12 * noise(u * 12, v * 12, 7, 12, 12)
        return (0.0, rough if gap > 0.002 and end > 0.0015 else 0.9, 0.0)
    return _image(256, 256, 3, texel)


def weave_normal():
    """Tangent-space normals of a basket weave, 16 threads a side."""
    def height(u, v):
        x, y = u * 16, v * 16
        over = (int(x) + int(y)) % 2 == 0
        t = (y if over else x) % 1
        s = (x if over else y) % 1
        return math.sin(math.pi * t) * (0.6 + 0.4 * math.sin(math.pi * s))

    def texel(u, v):
        step = 1 / 512
        dx = (height((u + step) % 1, v) - height((u - step) % 1, v)) * 0.9
        dy = (height(u, (v - step) % 1) - height(u, (v + step) % 1)) * 0.9
        length = math.sqrt(dx * dx + dy * dy + 1)
        return (0.5 - 0.5 * dx / length, 0.5 - 0.5 * dy / length, 0.5 + 0.5 / length)
    return _image(128, 128, 3, texel)


def rug():
    """A border, a field of lozenges and a medallion."""
    ivory, wine = (0.86, 0.80, 0.68), (0.47, 0.12, 0.12)
    night, gold = (0.13, 0.18, 0.30), (0.78, 0.58, 0.26)

    def texel(u, v):
        edge = min(u * 1.5, (1 - u) * 1.5, v, 1 - v)
        if edge < 0.025:
            color = ivory
        elif edge < 0.045:
            color = night
        elif edge < 0.13:
            wave = abs(((u * 1.5 + v) * 12) % 1 - 0.5) + abs(((u * 1.5 - v) * 12) % 1 - 0.5)
            color = gold if wave < 0.4 else ivory if wave < 0.52 else night
        elif edge < 0.15:
            color = ivory
        else:
            x, y = (u - 0.5) * 1.5, v - 0.5
            medallion = abs(x) * 0.8 + abs(y) + 0.015 * math.cos(40 * math.atan2(y, x) / 2)
            lozenge = abs((x * 10) % 1 - 0.5) + abs((y * 10 + 0.5) % 1 - 0.5)
            if medallion < 0.09:
                color = gold
            elif medallion < 0.15:
                color = night
            elif medallion < 0.165:
                color = ivory
            elif medallion < 0.27:
                color = _mix(wine, night, 0.5)
            elif medallion < 0.285:
                color = gold
            else:
                color = gold if lozenge < 0.16 else night if lozenge < 0.26 else wine
        pile = 0.88 + 0.24 * noise(u * 192, v * 128, 31, 192, 128)
        return tuple(c * pile for c in color)
    return _image(384, 256, 3, texel)


def painting():
    """Hills before an evening sky."""
    def texel(u, v):
        sky = _mix((0.20, 0.33, 0.52), (0.97, 0.70, 0.42), min(1.0, v * 1.7))
        sun = math.hypot((u - 0.66) * 1.35, v - 0.42)
        color = (1.0, 0.90, 0.66) if sun < 0.075 else _mix(
            (1.0, 0.80, 0.52), sky, min(1.0, 0.25 + sun * 2.2))
        hills = ((0.55, 0.10, 2.1, 0.3, (0.55, 0.47, 0.55)),
                 (0.64, 0.09, 3.3, 1.7, (0.36, 0.36, 0.48)),
                 (0.75, 0.08, 2.4, 4.2, (0.20, 0.30, 0.32)),
                 (0.87, 0.06, 4.1, 2.6, (0.12, 0.20, 0.17)))
        for base, height, waves, phase, tone in hills:
            ridge = base - height * (0.6 * math.sin(waves * math.pi * u + phase)
                                     + 0.4 * noise(u * 9, phase, 41, 9, 9))
            if v > ridge:
                color = _mix(tone, (0.90, 0.62, 0.42), max(0.0, 0.22 - (v - ridge)))
        stroke = 0.93 + 0.14 * noise(u * 40, v * 110, 51, 40, 110)
        return tuple(c * stroke for c in color)
    return _image(320, 240, 3, texel)
