"""The command compare: its figures against the same formulas in Python, and its exit statuses."""
import json
import math
import os
import struct
import subprocess
import sys
import tempfile
import zlib

COMMAND = os.environ['LSF_COMMAND']
FOLDER = tempfile.TemporaryDirectory()
WIDTH, HEIGHT = 29, 23


def path(name):
    return os.path.join(FOLDER.name, name)


def write_exr(name, pixels, width=WIDTH, height=HEIGHT):
    """Uncompressed float scanlines, after the file layout on openexr.com."""
    def attribute(key, kind, value):
        return key.encode() + b'\0' + kind.encode() + b'\0' + struct.pack('<I', len(value)) + value
    channels = b''.join(c + b'\0' + struct.pack('<iBxxxii', 2, 0, 1, 1) for c in (b'B', b'G', b'R'))
    window = struct.pack('<iiii', 0, 0, width - 1, height - 1)
    header = b'\x76\x2f\x31\x01' + struct.pack('<I', 2)
    header += attribute('channels', 'chlist', channels + b'\0')
    header += attribute('compression', 'compression', b'\0')
    header += attribute('dataWindow', 'box2i', window)
    header += attribute('displayWindow', 'box2i', window)
    header += attribute('lineOrder', 'lineOrder', b'\0')
    header += attribute('pixelAspectRatio', 'float', struct.pack('<f', 1))
    header += attribute('screenWindowCenter', 'v2f', struct.pack('<ff', 0, 0))
    header += attribute('screenWindowWidth', 'float', struct.pack('<f', 1)) + b'\0'
    row_bytes = 12 * width
    start = len(header) + 8 * height
    offsets = b''.join(struct.pack('<Q', start + y * (8 + row_bytes)) for y in range(height))
    with open(path(name), 'wb') as file:
        file.write(header + offsets)
        for y in range(height):
            file.write(struct.pack('<iI', y, row_bytes))
            for channel in (2, 1, 0):
                file.write(struct.pack(f'<{width}f',
                                       *(pixels[y * width + x][channel] for x in range(width))))


def write_png(name, pixels, width=WIDTH, height=HEIGHT):
    def chunk(kind, data):
        return (struct.pack('>I', len(data)) + kind + data +
                struct.pack('>I', zlib.crc32(kind + data)))
    rows = b''.join(b'\0' + bytes(v for p in pixels[y * width:(y + 1) * width] for v in p)
                    for y in range(height))
    with open(path(name), 'wb') as file:
        file.write(b'\x89PNG\r\n\x1a\n' +
                   chunk(b'IHDR', struct.pack('>IIBBBBB', width, height, 8, 2, 0, 0, 0)) +
                   chunk(b'IDAT', zlib.compress(rows)) + chunk(b'IEND', b''))


def read_png(name):
    """Size and the first pixel of an 8-bit RGB PNG; no row filter changes that pixel."""
    data = open(path(name), 'rb').read()
    assert data[:8] == b'\x89PNG\r\n\x1a\n'
    width, height, depth, colour = struct.unpack('>IIBB', data[16:26])
    assert (depth, colour) == (8, 2)
    at, packed = 8, b''
    while at < len(data):
        length = struct.unpack('>I', data[at:at + 4])[0]
        if data[at + 4:at + 8] == b'IDAT':
            packed += data[at + 8:at + 8 + length]
        at += length + 12
    return width, height, tuple(zlib.decompress(packed)[1:4])


def compare(*arguments, status=0):
    done = subprocess.run([COMMAND, 'compare', *arguments], capture_output=True, text=True,
                          timeout=60)
    assert done.returncode == status, (arguments, done.returncode, done.stdout, done.stderr)
    return done


def figures(*arguments):
    return json.loads(compare(*arguments, '--json', '-').stdout)


def close(a, b, tolerance):
    assert abs(a - b) <= tolerance, (a, b)


# --- the measures, written again ---------------------------------------------------------------

def display(rgb, exposure):
    """Khronos PBR Neutral and sRGB."""
    c = [min(max(v * 2.0 ** exposure, 0.0), 1e6) for v in rgb]
    smallest = min(c)
    veil = smallest - 6.25 * smallest ** 2 if smallest < 0.08 else 0.04
    c = [v - veil for v in c]
    peak = max(c)
    if peak >= 0.76:
        new_peak = 1 - 0.24 ** 2 / (peak + 0.24 - 0.76)
        g = 1 - 1 / (0.15 * (peak - new_peak) + 1)
        c = [v * new_peak / peak * (1 - g) + new_peak * g for v in c]
    return [12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055 for v in c]


def luma(rgb):
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]


def ssim(x, y):
    kernel = [math.exp(-k * k / 4.5) for k in range(-5, 6)]
    weights = [[a * b / sum(kernel) ** 2 for a in kernel] for b in kernel]
    values = []
    for cy in range(5, HEIGHT - 5):
        for cx in range(5, WIDTH - 5):
            window = [(weights[j][i], x[(cy + j - 5) * WIDTH + cx + i - 5],
                       y[(cy + j - 5) * WIDTH + cx + i - 5]) for j in range(11) for i in range(11)]
            mx = sum(w * a for w, a, _ in window)
            my = sum(w * b for w, _, b in window)
            vx = sum(w * (a - mx) ** 2 for w, a, _ in window)
            vy = sum(w * (b - my) ** 2 for w, _, b in window)
            cov = sum(w * (a - mx) * (b - my) for w, a, b in window)
            values.append((2 * mx * my + 1e-4) * (2 * cov + 9e-4) /
                          ((mx ** 2 + my ** 2 + 1e-4) * (vx + vy + 9e-4)))
    return sum(values) / len(values)


def single(value):
    return struct.unpack('<f', struct.pack('<f', value))[0]


def make_pictures():
    seed = 1
    test, half_a, half_b = [], [], []
    for i in range(WIDTH * HEIGHT):
        base = [0.4 + 0.3 * math.sin(0.5 * (i % WIDTH) + c) * math.cos(0.3 * (i // WIDTH))
                for c in range(3)]
        for pixels in (test, half_a, half_b):
            pixel = []
            for value in base:
                seed = (seed * 6364136223846793005 + 1442695040888963407) % 2 ** 64
                pixel.append(single(value * (0.8 + 0.5 * (seed >> 11) / 2 ** 53)))
            pixels.append(pixel)
    return test, half_a, half_b


def check_against(result, test, half_a, half_b, exposure):
    count = 3 * len(test)
    reference = [[(p + q) / 2 for p, q in zip(a, b)] for a, b in zip(half_a, half_b)]
    flat = [(x, a, b, r) for xs, as_, bs, rs in zip(test, half_a, half_b, reference)
            for x, a, b, r in zip(xs, as_, bs, rs)]
    mean = sum(r for *_, r in flat) / count
    close(result['rmse'], math.sqrt(sum((x - a) * (x - b) for x, a, b, _ in flat) / count), 1e-8)
    close(result['rmse_relative'], result['rmse'] / mean, 1e-8)
    close(result['relmse_epsilon'], 0.01 * mean ** 2, 1e-9)
    close(result['relmse'], sum((x - a) * (x - b) / (r * r + 0.01 * mean ** 2)
                                for x, a, b, r in flat) / count, 1e-8)
    for c in range(3):
        r = sum(p[c] for p in reference)
        close(result['bias'][c], (sum(p[c] for p in test) - r) / r, 1e-8)
    shown = [display(p, exposure) for p in test]
    shown_reference = [display(p, exposure) for p in reference]
    squares = sum((p - q) ** 2 for ps, qs in zip(shown, shown_reference) for p, q in zip(ps, qs))
    close(result['psnr'], -10 * math.log10(squares / count), 1e-4)
    close(result['ssim'], ssim([luma(p) for p in shown], [luma(p) for p in shown_reference]), 1e-5)


def flip_pictures(kind):
    """64 x 48 pixels of 8 bits, test and reference."""
    test, reference = [], []
    for i in range(64 * 48):
        x, y = i % 64, i // 64
        if kind == 'step':
            dark, bright = (60, 60, 60), (200, 180, 90)
            pair = dark if x < 30 else bright, dark if x < 32 else bright
        elif kind == 'point':
            pair = (255, 40, 0) if (x, y) == (20, 20) else (90, 90, 90), (90, 90, 90)
        elif kind == 'constant':
            pair = (120, 130, 110), (100, 140, 150)
        else:
            pair = tuple([(x * 3 + (y * 5 + x * 7) * k % 61) % 256 for k in ks]
                         for ks in ((1, 2, 3), (1, 4, 9)))
        test.append(pair[0])
        reference.append(pair[1])
    return test, reference


def radiance(pixels):
    """A range of 10 EV from 8 bits."""
    return [[single(2.0 ** (v / 25.6 - 6)) for v in p] for p in pixels]


# Means that the authors' own tool, version 1.6, gives for these pictures: LDR and HDR. Where they
# are even, it finds features of some 1e-9 by rounding, whose root brings their mean off by 6e-5;
# test_flip.c has the closed form for them.
FLIP_OF_AUTHORS = {'step': (0.091337, 0.124637), 'point': (0.001807, 0.001424),
                   'constant': (0.355210, 0.364516), 'texture': (0.083436, 0.131866)}


def check_flip():
    for kind, (ldr, hdr) in FLIP_OF_AUTHORS.items():
        test, reference = flip_pictures(kind)
        for name, pixels in (('test', test), ('reference', reference)):
            write_png(name + '.png', pixels, 64, 48)
            write_exr(name + '.exr', radiance(pixels), 64, 48)
        found = figures(path('test.png'), path('reference.png'), '--flip', '--tonemap', 'none')
        tolerance = 1e-4 if kind == 'constant' else 1.1e-6
        close(found['flip'], ldr, tolerance)
        found = figures(path('test.exr'), path('reference.exr'), '--flip')
        close(found['flip_hdr'], hdr, tolerance)


def main():
    test, half_a, half_b = make_pictures()
    write_exr('x.exr', test)
    write_exr('a.exr', half_a)
    write_exr('b.exr', half_b)
    x, a, b = path('x.exr'), path('a.exr'), path('b.exr')

    check_against(figures(x, a, '--exposure', '1'), test, half_a, half_a, 1)
    check_against(figures(x, a, b), test, half_a, half_b, 0)
    assert figures(x, a, b)['noise_corrected'] and not figures(x, a)['noise_corrected']
    close(figures(x, a, '--epsilon', '0.01')['relmse_epsilon'], 0.01, 1e-9)
    check_flip()
    assert figures(x, a)['flip'] is None
    same = figures(x, x, '--flip')
    assert same['flip'] == 0 and same['flip_hdr'] == 0
    assert same['rmse'] == 0 and same['ssim'] == 1 and same['psnr'] is None

    text = compare(x, a).stdout
    for word in ('bias', 'RMSE', 'relMSE', 'epsilon', 'SSIM', 'PSNR'):
        assert word in text, (word, text)
    assert compare(x, a, '-q').stdout == ''

    compare(x, x, '--threshold', 'rmse=0', '--threshold', 'psnr=1000', '--threshold', 'ssim=1')
    rmse = figures(x, a)['rmse']
    compare(x, a, '--threshold', f'rmse={rmse * 1.01}')
    failed = compare(x, a, '--threshold', 'ssim=0.1', '--threshold', f'rmse={rmse * 0.99}',
                     status=5)
    assert 'rmse' in failed.stderr and 'VIOLATED' in failed.stdout
    compare(x, a, '--threshold', 'ssim=0.9999', status=5)
    compare(x, a, '--threshold', 'flip=0.0001', status=5)
    compare(x, a, '--threshold', 'flip_hdr=1', '--threshold', 'flip=1')
    assert json.loads(compare(x, a, '--json', '-', '--threshold', 'bias=0', status=5).stdout)[
        'passed'] is False
    compare(x, a, '--threshold', 'colour=1', status=2)
    compare(x, status=2)
    compare(x, path('missing.exr'), status=3)

    write_exr('small.exr', half_a, WIDTH, HEIGHT - 1)
    assert 'same size' in compare(x, path('small.exr'), status=3).stderr

    # Debian 12's idiff passes such a picture, even one that is NaN throughout.
    broken = [list(p) for p in half_a]
    broken[7][1] = math.nan
    broken[9][0] = math.inf
    write_exr('nan.exr', broken)
    assert '2 pixels' in compare(path('nan.exr'), a, status=5).stderr
    assert '2 of the reference' in compare(a, path('nan.exr'), status=5).stderr
    write_exr('all_nan.exr', [[math.nan] * 3] * len(test))
    assert f'{len(test)} pixels' in compare(path('all_nan.exr'), a, status=5).stderr
    write_exr('mask.exr', [[1.0 if i in (7, 9) else 0.0] * 3 for i in range(len(test))])
    masked = figures(path('nan.exr'), a, '--mask', path('mask.exr'))
    assert masked['rmse'] == 0 and masked['pixels'] == len(test) - 2

    compare(x, a, '--difference', path('d.png'), '--difference-gain', '2')
    width, height, codes = read_png('d.png')
    expected = display([2 * abs(p - q) for p, q in zip(test[0], half_a[0])], 0)
    assert (width, height) == (WIDTH, HEIGHT)
    for code, value in zip(codes, expected):
        close(code, 255 * value, 0.51)
    return 0


sys.exit(main())
