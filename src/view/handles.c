/* Handles of the selected node: three arrows that move it, three rings that rotate it about
 * them, and a square that scales it. */
#include "view/app.h"

#include <math.h>
#include <string.h>

/* Lengths in heights of the picture. */
#define ARROW 0.16
#define RING 0.12
#define SQUARE 0.11     /* from the anchor to the square, to the right and up */
#define NEAR_HANDLE 7.0 /* pixels on a screen of usual density */
enum { ARROWS = 0, RINGS = 3, SCALE = 6, HANDLES = 7, SEGMENTS = 48 };

double lsf_viewer_aspect(const lsf_viewer *viewer)
{
    return (double)viewer->area.width / (double)viewer->area.height;
}

/* --- their positions --- */

/* A point of the scene in the window. */
static bool to_window(const lsf_viewer *viewer, const double point[3], double xy[2])
{
    if (!lsf_viewer_camera_project(&viewer->camera, point, lsf_viewer_aspect(viewer), xy))
        return false;
    xy[0] = (double)viewer->area.x + 0.5 * (xy[0] + 1.0) * (double)viewer->area.width;
    xy[1] = (double)viewer->area.y + 0.5 * (1.0 - xy[1]) * (double)viewer->area.height;
    return true;
}

/* The length in the scene of a height of the picture, at the anchor, so that handles have the
 * same size wherever they are. */
static double height_there(const lsf_viewer *viewer)
{
    double axes[3][3], ahead = 0.0;
    const lsf_viewer_camera *camera = &viewer->camera;
    if (camera->shown_height > 0.0f)
        return (double)camera->shown_height;
    lsf_viewer_camera_axes(camera, axes);
    for (int i = 0; i < 3; i++)
        ahead += (viewer->anchor[i] - (double)camera->position[i]) * axes[2][i];
    return 2.0 * ahead * tan(0.5 * (double)camera->shown_fov_y * M_PI / 180.0);
}

/* Both ends of an arrow in the window. */
static bool arrow(const lsf_viewer *viewer, int axis, double from[2], double to[2])
{
    double tip[3];
    memcpy(tip, viewer->anchor, sizeof tip);
    tip[axis] += ARROW * height_there(viewer);
    return to_window(viewer, viewer->anchor, from) && to_window(viewer, tip, to);
}

/* A place on the ring about an axis, `angle` from the next axis towards the one after. */
static bool on_ring(const lsf_viewer *viewer, int axis, double angle, double xy[2])
{
    double point[3], radius = RING * height_there(viewer);
    memcpy(point, viewer->anchor, sizeof point);
    point[(axis + 1) % 3] += radius * cos(angle);
    point[(axis + 2) % 3] += radius * sin(angle);
    return to_window(viewer, point, xy);
}

static bool square(const lsf_viewer *viewer, double xy[2])
{
    double aside = SQUARE * (double)viewer->area.height;
    if (!to_window(viewer, viewer->anchor, xy))
        return false;
    xy[0] += aside;
    xy[1] -= aside;
    return true;
}

/* --- the one under the cursor --- */

/* From the cursor to a line between two places; `low` and `high`: the part of the line that counts.
 */
static double to_line(const lsf_viewer *viewer, const double a[2], const double b[2], double low,
                      double high)
{
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = fmax(dx * dx + dy * dy, 1e-9);
    double along = ((viewer->input->x - a[0]) * dx + (viewer->input->y - a[1]) * dy) / length2;
    along = fmax(low, fmin(high, along));
    return hypot(viewer->input->x - a[0] - along * dx, viewer->input->y - a[1] - along * dy);
}

static double to_arrow(const lsf_viewer *viewer, int axis)
{
    double a[2], b[2];
    return arrow(viewer, axis, a, b) ? to_line(viewer, a, b, 0.15, 1.1) : INFINITY;
}

/* And where on the ring that is. */
static double to_ring(const lsf_viewer *viewer, int axis, double *angle)
{
    double a[2], b[2], nearest = INFINITY;
    for (int i = 0; i < SEGMENTS; i++) {
        double from = 2.0 * M_PI * i / SEGMENTS, step = 2.0 * M_PI / SEGMENTS;
        if (!on_ring(viewer, axis, from, a) || !on_ring(viewer, axis, from + step, b))
            return INFINITY;
        double distance = to_line(viewer, a, b, 0.0, 1.0);
        if (distance >= nearest)
            continue;
        nearest = distance;
        *angle = from + 0.5 * step;
    }
    return nearest;
}

static double to_square(const lsf_viewer *viewer)
{
    double xy[2];
    return square(viewer, xy) ? hypot(viewer->input->x - xy[0], viewer->input->y - xy[1])
                              : INFINITY;
}

int lsf_viewer_handle_under_cursor(const lsf_viewer *viewer, double *angle)
{
    double nearest = NEAR_HANDLE * (double)viewer->input->scale;
    int found = -1;
    for (int handle = 0; viewer->node != LSF_NONE && handle < HANDLES; handle++) {
        double there = 0.0;
        double distance = handle < RINGS   ? to_arrow(viewer, handle)
                          : handle < SCALE ? to_ring(viewer, handle - RINGS, &there)
                                           : to_square(viewer);
        if (distance >= nearest)
            continue;
        nearest = distance;
        found = handle;
        *angle = there;
    }
    return found;
}

/* --- dragging --- */

static void move(lsf_viewer *viewer, int axis)
{
    double a[2], b[2], by[3] = {0};
    if (!arrow(viewer, axis, a, b))
        return;
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    if (length2 < 1.0) /* it points at the viewer */
        return;
    by[axis] =
        ARROW * height_there(viewer) * (viewer->input->dx * dx + viewer->input->dy * dy) / length2;
    lsf_viewer_move_node(viewer, viewer->node, by);
}

/* Rotates by as much as the held point of the ring moves along it. */
static void rotate(lsf_viewer *viewer, int axis)
{
    double a[2], b[2], step = 1e-3;
    if (!on_ring(viewer, axis, viewer->ring_angle - step, a) ||
        !on_ring(viewer, axis, viewer->ring_angle + step, b))
        return;
    double dx = (b[0] - a[0]) / (2.0 * step), dy = (b[1] - a[1]) / (2.0 * step);
    double length2 = dx * dx + dy * dy, radius = RING * (double)viewer->area.height;
    length2 = fmax(length2, 0.04 * radius * radius); /* where the ring is seen on edge */
    double angle = (viewer->input->dx * dx + viewer->input->dy * dy) / length2;
    double c = cos(angle), s = sin(angle), linear[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    int u = (axis + 1) % 3, v = (axis + 2) % 3;
    linear[3 * u + u] = linear[3 * v + v] = c;
    linear[3 * u + v] = -s; /* of row u */
    linear[3 * v + u] = s;
    viewer->ring_angle += angle;
    lsf_viewer_transform_node(viewer, viewer->node, linear);
}

/* Twice as large for a drag as long as the arrows. */
static void scale(lsf_viewer *viewer)
{
    double pixels = (viewer->input->dx - viewer->input->dy) * M_SQRT1_2;
    double times = exp2(pixels / (ARROW * (double)viewer->area.height));
    const double linear[9] = {times, 0, 0, 0, times, 0, 0, 0, times};
    lsf_viewer_transform_node(viewer, viewer->node, linear);
}

void lsf_viewer_drag_handle(lsf_viewer *viewer)
{
    if (viewer->input->dx == 0.0 && viewer->input->dy == 0.0)
        return;
    if (viewer->dragged < RINGS)
        move(viewer, viewer->dragged);
    else if (viewer->dragged < SCALE)
        rotate(viewer, viewer->dragged - RINGS);
    else
        scale(viewer);
}

/* --- drawing --- */

static const lsf_ui_color colors[] = {LSF_UI_RED, LSF_UI_GREEN, LSF_UI_BLUE};

static uint32_t color_of(int handle, int under)
{
    lsf_ui_color color = handle == SCALE ? LSF_UI_TEXT : colors[handle % 3];
    return lsf_ui_rgba(handle == under ? LSF_UI_ACCENT : color);
}

static void draw_arrow(const lsf_viewer *viewer, int axis, uint32_t color)
{
    static const char *const labels[] = {"handle X", "handle Y", "handle Z"};
    double a[2], b[2];
    if (!arrow(viewer, axis, a, b))
        return;
    double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
    lsf_ui_mark(labels[axis], (float)(a[0] + 0.9 * dx), (float)(a[1] + 0.9 * dy),
                viewer->dragged == ARROWS + axis);
    lsf_ui_draw_line((float)a[0], (float)a[1], (float)b[0], (float)b[1], color,
                     3.0f * viewer->input->scale);
    double size = 9.0 * (double)viewer->input->scale;
    if (length <= size)
        return;
    double ux = dx / length * size, uy = dy / length * size;
    const float head[6] = {(float)(b[0] + ux),       (float)(b[1] + uy),
                           (float)(b[0] - 0.5 * uy), (float)(b[1] + 0.5 * ux),
                           (float)(b[0] + 0.5 * uy), (float)(b[1] - 0.5 * ux)};
    lsf_ui_draw_triangle(head, color);
}

static void draw_ring(const lsf_viewer *viewer, int axis, uint32_t color)
{
    static const char *const labels[] = {"ring X", "ring Y", "ring Z"};
    double a[2], b[2];
    for (int i = 0; i < SEGMENTS; i++) {
        double from = 2.0 * M_PI * i / SEGMENTS, step = 2.0 * M_PI / SEGMENTS;
        if (on_ring(viewer, axis, from, a) && on_ring(viewer, axis, from + step, b))
            lsf_ui_draw_line((float)a[0], (float)a[1], (float)b[0], (float)b[1], color,
                             1.5f * viewer->input->scale);
    }
    if (on_ring(viewer, axis, 0.25 * M_PI, a)) /* where no other ring is */
        lsf_ui_mark(labels[axis], (float)a[0], (float)a[1], viewer->dragged == RINGS + axis);
}

static void draw_square(const lsf_viewer *viewer, uint32_t color)
{
    double xy[2];
    float side = 10.0f * viewer->input->scale;
    if (!square(viewer, xy))
        return;
    const lsf_rect rect = {(float)xy[0] - 0.5f * side, (float)xy[1] - 0.5f * side, side, side};
    lsf_ui_draw_rect(rect, color, true, 2.0f);
    lsf_ui_mark("handle scale", (float)xy[0], (float)xy[1], viewer->dragged == SCALE);
}

void lsf_viewer_draw_handles(const lsf_viewer *viewer)
{
    double angle;
    int under =
        viewer->dragged >= 0 ? viewer->dragged : lsf_viewer_handle_under_cursor(viewer, &angle);
    for (int axis = 0; axis < 3; axis++) {
        draw_ring(viewer, axis, color_of(RINGS + axis, under));
        draw_arrow(viewer, axis, color_of(ARROWS + axis, under));
    }
    draw_square(viewer, color_of(SCALE, under));
}
