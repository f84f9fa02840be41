/* Clicks on the picture, and three arrows by which what is chosen is moved. */
#include "view/app.h"

#include <math.h>
#include <string.h>

#define ARROW 0.16       /* length, in heights of the picture */
#define NEAR_ARROW 7.0   /* pixels on a screen of usual density */
#define CLICK 4.0        /* pixels that a click may go */
#define OFF_SURFACE 0.06 /* a new light from the surface, in extents */

static double aspect(const lsf_viewer *viewer)
{
    return (double)viewer->area.width / (double)viewer->area.height;
}

/* The cursor's place in the picture, -1..1, y upwards. */
static bool over_picture(const lsf_viewer *viewer, double xy[2])
{
    const lsf_rect *area = &viewer->area;
    xy[0] = 2.0 * (viewer->input->x - (double)area->x) / (double)area->width - 1.0;
    xy[1] = 1.0 - 2.0 * (viewer->input->y - (double)area->y) / (double)area->height;
    return fabs(xy[0]) <= 1.0 && fabs(xy[1]) <= 1.0;
}

bool lsf_viewer_pick(const lsf_viewer *viewer, lsf_hit *hit)
{
    double xy[2], origin[3], direction[3];
    if (!viewer->scene || !over_picture(viewer, xy))
        return false;
    lsf_viewer_camera_ray(&viewer->camera, xy[0], xy[1], aspect(viewer), origin, direction);
    return lsf_scene_trace(viewer->scene, viewer->time, origin, direction, hit, NULL) &&
           hit->node != LSF_NONE;
}

void lsf_viewer_choose_node(lsf_viewer *viewer, uint32_t node)
{
    double world[16];
    lsf_node_info info;
    viewer->node = node;
    if (node == LSF_NONE ||
        !lsf_scene_get_node_world(viewer->scene, node, viewer->time, world, NULL) ||
        !lsf_scene_get_node_info(viewer->scene, node, &info, NULL))
        return;
    memcpy(viewer->anchor, world + 12, sizeof viewer->anchor);
    if (info.light != LSF_NONE)
        viewer->light = info.light;
}

/* --- handles --- */

/* A point of the scene in the window. */
static bool to_window(const lsf_viewer *viewer, const double point[3], double xy[2])
{
    if (!lsf_viewer_camera_project(&viewer->camera, point, aspect(viewer), xy))
        return false;
    xy[0] = (double)viewer->area.x + 0.5 * (xy[0] + 1.0) * (double)viewer->area.width;
    xy[1] = (double)viewer->area.y + 0.5 * (1.0 - xy[1]) * (double)viewer->area.height;
    return true;
}

/* Length of the arrows in the scene, so that they are as long wherever they are. */
static double arrow_length(const lsf_viewer *viewer)
{
    double axes[3][3], ahead = 0.0;
    const lsf_viewer_camera *camera = &viewer->camera;
    if (camera->shown_height > 0.0f)
        return ARROW * (double)camera->shown_height;
    lsf_viewer_camera_axes(camera, axes);
    for (int i = 0; i < 3; i++)
        ahead += (viewer->anchor[i] - (double)camera->position[i]) * axes[2][i];
    return 2.0 * ARROW * ahead * tan(0.5 * (double)camera->shown_fov_y * M_PI / 180.0);
}

/* Both ends of an arrow in the window. */
static bool arrow(const lsf_viewer *viewer, int axis, double from[2], double to[2])
{
    double tip[3];
    memcpy(tip, viewer->anchor, sizeof tip);
    tip[axis] += arrow_length(viewer);
    return viewer->node != LSF_NONE && to_window(viewer, viewer->anchor, from) &&
           to_window(viewer, tip, to);
}

static int arrow_under_cursor(const lsf_viewer *viewer)
{
    double nearest = NEAR_ARROW * (double)viewer->input->scale;
    int found = -1;
    for (int axis = 0; axis < 3; axis++) {
        double a[2], b[2];
        if (!arrow(viewer, axis, a, b))
            continue;
        double dx = b[0] - a[0], dy = b[1] - a[1], length2 = fmax(dx * dx + dy * dy, 1e-9);
        double along = ((viewer->input->x - a[0]) * dx + (viewer->input->y - a[1]) * dy) / length2;
        along = fmax(0.15, fmin(1.1, along));
        double distance =
            hypot(viewer->input->x - a[0] - along * dx, viewer->input->y - a[1] - along * dy);
        if (distance < nearest) {
            nearest = distance;
            found = axis;
        }
    }
    return found;
}

static void drag_handle(lsf_viewer *viewer)
{
    double a[2], b[2], by[3] = {0};
    const lsf_input *input = viewer->input;
    if (!arrow(viewer, viewer->dragged, a, b) || (input->dx == 0.0 && input->dy == 0.0))
        return;
    double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    if (length2 < 1.0) /* it points at the viewer */
        return;
    by[viewer->dragged] = arrow_length(viewer) * (input->dx * dx + input->dy * dy) / length2;
    lsf_viewer_move_node(viewer, viewer->node, by);
}

void lsf_viewer_draw_handles(const lsf_viewer *viewer)
{
    static const lsf_ui_color colors[] = {LSF_UI_RED, LSF_UI_GREEN, LSF_UI_BLUE};
    static const char *const labels[] = {"handle X", "handle Y", "handle Z"};
    int under = viewer->dragged >= 0 ? viewer->dragged : arrow_under_cursor(viewer);
    for (int axis = 0; axis < 3; axis++) {
        double a[2], b[2];
        if (!arrow(viewer, axis, a, b))
            continue;
        uint32_t color = axis == under ? lsf_ui_rgba(LSF_UI_ACCENT) : lsf_ui_rgba(colors[axis]);
        double dx = b[0] - a[0], dy = b[1] - a[1], length = hypot(dx, dy);
        lsf_ui_mark(labels[axis], (float)(a[0] + 0.7 * dx), (float)(a[1] + 0.7 * dy));
        lsf_ui_draw_line((float)a[0], (float)a[1], (float)b[0], (float)b[1], color,
                         3.0f * viewer->input->scale);
        double size = 9.0 * (double)viewer->input->scale;
        if (length > size) {
            double ux = dx / length * size, uy = dy / length * size;
            const float head[6] = {(float)(b[0] + ux),       (float)(b[1] + uy),
                                   (float)(b[0] - 0.5 * uy), (float)(b[1] + 0.5 * ux),
                                   (float)(b[0] + 0.5 * uy), (float)(b[1] - 0.5 * ux)};
            lsf_ui_draw_triangle(head, color);
        }
    }
}

/* --- clicks --- */

static void click(lsf_viewer *viewer)
{
    lsf_hit hit;
    bool met = lsf_viewer_pick(viewer, &hit);
    if (!met) {
        viewer->node = LSF_NONE;
        return;
    }
    if (viewer->placing) {
        double position[3];
        for (int i = 0; i < 3; i++)
            position[i] = hit.position[i] +
                          OFF_SURFACE * (double)viewer->camera.extent * (double)hit.normal[i];
        viewer->placing = false;
        lsf_viewer_add_light(viewer, position);
        return;
    }
    lsf_viewer_choose_node(viewer, hit.node);
    memcpy(viewer->anchor, hit.position, sizeof viewer->anchor);
    viewer->material = hit.material;
}

bool lsf_viewer_point(lsf_viewer *viewer)
{
    lsf_hit hit;
    double xy[2];
    const lsf_input *input = viewer->input;
    if (input->double_clicked && lsf_viewer_pick(viewer, &hit)) {
        lsf_viewer_camera_focus(&viewer->camera, hit.position);
        lsf_viewer_touch(viewer);
        return true;
    }
    if (input->pressed[LSF_BUTTON_LEFT]) {
        viewer->press_x = input->x;
        viewer->press_y = input->y;
        viewer->dragged = over_picture(viewer, xy) ? arrow_under_cursor(viewer) : -1;
    }
    bool held = viewer->dragged >= 0;
    if (held && input->down[LSF_BUTTON_LEFT])
        drag_handle(viewer);
    bool clicked = input->released[LSF_BUTTON_LEFT] && input->down[LSF_BUTTON_LEFT] && !held &&
                   hypot(input->x - viewer->press_x, input->y - viewer->press_y) < CLICK;
    if (clicked && input->modifiers == 0)
        click(viewer);
    if (!input->down[LSF_BUTTON_LEFT] || input->released[LSF_BUTTON_LEFT])
        viewer->dragged = -1;
    return held;
}
