#include "measure/flip.h"

#include "measure/convolve.h"

#include <math.h>
#include <stdlib.h>

/* The constants are those of the paper's sections 4.1 to 4.3. */

/* Contrast sensitivity: Gaussians a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees, that add up. */
typedef struct sensitivity {
    int terms;
    double a[2], b[2];
} sensitivity;

static const sensitivity achromatic = {1, {1.0}, {0.0047}};
static const sensitivity red_green = {1, {1.0}, {0.0053}};
static const sensitivity blue_yellow = {2, {34.1, 13.5}, {0.04, 0.025}};

#define WIDEST 0.04           /* the largest b, which all kernels are cut off for */
#define FEATURE_WIDTH 0.082   /* degrees */
#define COLOUR_EXPONENT 0.7f  /* q_c */
#define FEATURE_EXPONENT 0.5f /* q_f */
#define KNEE_AT 0.4f          /* p_c, in parts of the largest difference */
#define KNEE_TO 0.95f         /* p_t */

/* What a picture comes to: colours in L*a*b* after Hunt, and the strengths of its features. */
enum { LIGHTNESS, GREEN_RED, BLUE_YELLOW, EDGE, POINT, PARTS };

/* Planes that it takes to get there: Y, Cx, Cz, and rows convolved. */
enum { LUMA, CHROMA_X, CHROMA_Z, ROWS, SLOPES, SCRATCH };

typedef struct workspace {
    lsf_plane_size size;
    size_t pixels;
    float *memory, *padded;
    float *scratch[SCRATCH];
    float *parts[2][PARTS]; /* of the test, of the reference */
} workspace;

typedef struct colour {
    float x, y, z;
} colour;

static bool make_workspace(workspace *space, uint32_t width, uint32_t height)
{
    enum { PLANES = SCRATCH + 2 * PARTS };
    *space = (workspace){.size = {width, height}, .pixels = (size_t)width * height};
    uint64_t padded = (uint64_t)width + 2 * LSF_KERNEL_RADIUS;
    space->memory = lsf_alloc((uint64_t)space->pixels * PLANES + padded, sizeof(float));
    if (!space->memory)
        return false;
    float *plane = space->memory;
    for (int i = 0; i < SCRATCH; i++, plane += space->pixels)
        space->scratch[i] = plane;
    for (int i = 0; i < 2 * PARTS; i++, plane += space->pixels)
        space->parts[i / PARTS][i % PARTS] = plane;
    space->padded = plane;
    return true;
}

/* X, Y, Z in parts of the white point, with sRGB's primaries and D65 (IEC 61966-2-1), in as many
 * digits as the authors' published figures were made with. */
static colour xyz_of_rgb(colour c)
{
    return (colour){0.433895389f * c.x + 0.376242373f * c.y + 0.189862239f * c.z,
                    0.212636822f * c.x + 0.715182982f * c.y + 0.072180196f * c.z,
                    0.017752423f * c.x + 0.109465629f * c.y + 0.872781948f * c.z};
}

static colour rgb_of_xyz(colour c)
{
    return (colour){3.080341988f * c.x - 1.537398969f * c.y - 0.542943019f * c.z,
                    -0.921178396f * c.x + 1.875929984f * c.y + 0.045248412f * c.z,
                    0.052881293f * c.x - 0.204011206f * c.y + 1.151129913f * c.z};
}

static float shown(float value)
{
    return value > 0.0f ? fminf(value, 1.0f) : 0.0f;
}

/* The function of CIELAB (CIE 15), with its straight piece near black. */
static float lab_curve(float t)
{
    const float delta = 6.0f / 29.0f;
    return t > delta * delta * delta ? cbrtf(t) : t / (3.0f * delta * delta) + 4.0f / 29.0f;
}

/* L*a*b*, with less chroma where it is dark: Hunt's effect. */
static colour hunt_lab(colour rgb)
{
    colour xyz = xyz_of_rgb(rgb);
    float x = lab_curve(xyz.x), y = lab_curve(xyz.y), z = lab_curve(xyz.z);
    float lightness = 116.0f * y - 16.0f;
    return (colour){lightness, 0.01f * lightness * 500.0f * (x - y),
                    0.01f * lightness * 200.0f * (y - z)};
}

/* HyAB: Abasi, Amani Tehran and Fairchild, "Distance metrics for very large color differences",
 * Color Research & Application 45(2), 2020. */
static float difference(colour a, colour b)
{
    return fabsf(a.x - b.x) + sqrtf((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

/* A term of a sensitivity as a kernel along one axis; along both it comes to `share`. */
static lsf_kernel make_gaussian(double share, double b, int radius)
{
    lsf_kernel kernel = {.radius = radius};
    double weights[2 * LSF_KERNEL_RADIUS + 1], sum = 0.0;
    for (int k = -radius; k <= radius; k++) {
        double degrees = k / (double)LSF_FLIP_PIXELS_PER_DEGREE;
        sum += weights[k + radius] = exp(-M_PI * M_PI * degrees * degrees / b);
    }
    for (int k = 0; k <= 2 * radius; k++)
        kernel.weights[k] = (float)(sqrt(share) * weights[k] / sum);
    return kernel;
}

/* The whole weight of a term's samples in the plane. */
static double term_weight(const sensitivity *s, int term, int radius)
{
    double sum = 0.0;
    for (int k = -radius; k <= radius; k++) {
        double degrees = k / (double)LSF_FLIP_PIXELS_PER_DEGREE;
        sum += exp(-M_PI * M_PI * degrees * degrees / s->b[term]);
    }
    return s->a[term] * sqrt(M_PI / s->b[term]) * sum * sum;
}

/* Filters a plane as the eye does; `out` is another one. */
static void see(workspace *space, const sensitivity *s, const float *in, float *out)
{
    int radius =
        (int)ceil(3.0 * sqrt(WIDEST / (2.0 * M_PI * M_PI)) * (double)LSF_FLIP_PIXELS_PER_DEGREE);
    double whole = 0.0;
    for (int i = 0; i < s->terms; i++)
        whole += term_weight(s, i, radius);
    for (int i = 0; i < s->terms; i++) {
        lsf_kernel kernel = make_gaussian(term_weight(s, i, radius) / whole, s->b[i], radius);
        lsf_convolve_rows(space->size, &kernel, in, space->scratch[ROWS], space->padded);
        lsf_convolve_columns(space->size, &kernel, space->scratch[ROWS], out, i > 0);
    }
}

/* Gaussian derivatives of order 0 to 2. Their positive weights sum to 1, and the negative ones to
 * -1. */
static void make_detectors(lsf_kernel detectors[3])
{
    double sigma = 0.5 * FEATURE_WIDTH * (double)LSF_FLIP_PIXELS_PER_DEGREE;
    int radius = (int)ceil(3.0 * sigma);
    for (int order = 0; order < 3; order++) {
        double weights[2 * LSF_KERNEL_RADIUS + 1], positive = 0.0, negative = 0.0;
        for (int k = -radius; k <= radius; k++) {
            double x = k / sigma, bell = exp(-0.5 * x * x);
            double weight = order == 0 ? bell : order == 1 ? -x * bell : (x * x - 1.0) * bell;
            weights[k + radius] = weight;
            positive += fmax(weight, 0.0);
            negative += fmax(-weight, 0.0);
        }
        detectors[order] = (lsf_kernel){.radius = radius, .balanced = order > 0};
        for (int k = 0; k <= 2 * radius; k++)
            detectors[order].weights[k] =
                (float)(weights[k] / (weights[k] > 0.0 ? positive : fmax(negative, 1e-30)));
    }
}

/* The strength of edges (order 1) or points (order 2): how large the two derivatives are. */
static void detect(workspace *space, const lsf_kernel detectors[3], int order, float *strength)
{
    float *rows = space->scratch[ROWS], *slopes = space->scratch[SLOPES];
    const float *luma = space->scratch[LUMA];
    lsf_convolve_rows(space->size, &detectors[order], luma, rows, space->padded);
    lsf_convolve_columns(space->size, &detectors[0], rows, strength, false);
    lsf_convolve_rows(space->size, &detectors[0], luma, rows, space->padded);
    lsf_convolve_columns(space->size, &detectors[order], rows, slopes, false);
    for (size_t i = 0; i < space->pixels; i++)
        strength[i] = sqrtf(strength[i] * strength[i] + slopes[i] * slopes[i]);
}

/* All that is compared of one picture. */
static void take_apart(workspace *space, const float *rgb, float *const parts[PARTS])
{
    float *const *scratch = space->scratch;
    /* Y, Cx, Cz: L*a*b* without its curve, but for scale and offset, which the filters keep. */
    for (size_t i = 0; i < space->pixels; i++) {
        colour xyz = xyz_of_rgb((colour){rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
        scratch[LUMA][i] = xyz.y;
        scratch[CHROMA_X][i] = xyz.x - xyz.y;
        scratch[CHROMA_Z][i] = xyz.y - xyz.z;
    }
    see(space, &achromatic, scratch[LUMA], parts[LIGHTNESS]);
    see(space, &red_green, scratch[CHROMA_X], parts[GREEN_RED]);
    see(space, &blue_yellow, scratch[CHROMA_Z], parts[BLUE_YELLOW]);
    for (size_t i = 0; i < space->pixels; i++) {
        float y = parts[LIGHTNESS][i];
        colour seen = rgb_of_xyz((colour){y + parts[GREEN_RED][i], y, y - parts[BLUE_YELLOW][i]});
        colour lab = hunt_lab((colour){shown(seen.x), shown(seen.y), shown(seen.z)});
        parts[LIGHTNESS][i] = lab.x;
        parts[GREEN_RED][i] = lab.y;
        parts[BLUE_YELLOW][i] = lab.z;
    }
    lsf_kernel detectors[3];
    make_detectors(detectors);
    detect(space, detectors, 1, parts[EDGE]);
    detect(space, detectors, 2, parts[POINT]);
}

/* Differences of colour, compressed to 0..1: those up to the knee take most of the range. */
static float compress(float error, float largest)
{
    float knee = KNEE_AT * largest;
    return error < knee ? KNEE_TO / knee * error
                        : KNEE_TO + (error - knee) / (largest - knee) * (1.0f - KNEE_TO);
}

static void compare_parts(const workspace *space, float *map)
{
    float *const *test = space->parts[0], *const *reference = space->parts[1];
    /* The farthest two colours of a display. */
    float largest =
        powf(difference(hunt_lab((colour){0, 1, 0}), hunt_lab((colour){0, 0, 1})), COLOUR_EXPONENT);
    for (size_t i = 0; i < space->pixels; i++) {
        colour a = {test[LIGHTNESS][i], test[GREEN_RED][i], test[BLUE_YELLOW][i]};
        colour b = {reference[LIGHTNESS][i], reference[GREEN_RED][i], reference[BLUE_YELLOW][i]};
        float colours = compress(powf(difference(a, b), COLOUR_EXPONENT), largest);
        float features = fmaxf(fabsf(test[EDGE][i] - reference[EDGE][i]),
                               fabsf(test[POINT][i] - reference[POINT][i]));
        map[i] = powf(colours, 1.0f - powf(features * (float)M_SQRT1_2, FEATURE_EXPONENT));
    }
}

bool lsf_flip(const lsf_flip_pair *pair, float *map)
{
    workspace space;
    if (!make_workspace(&space, pair->width, pair->height))
        return false;
    take_apart(&space, pair->test, space.parts[0]);
    take_apart(&space, pair->reference, space.parts[1]);
    compare_parts(&space, map);
    free(space.memory);
    return true;
}
