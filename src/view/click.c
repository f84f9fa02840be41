/* Clicks on the picture: choosing, turning about a point, placing lights. */
#include "view/app.h"

#include <math.h>
#include <string.h>

#define CLICK 4.0        /* pixels that a click may go */
#define OFF_SURFACE 0.06 /* a new light from the surface, in extents */

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
    lsf_viewer_camera_ray(&viewer->camera, xy[0], xy[1], lsf_viewer_aspect(viewer), origin,
                          direction);
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
    lsf_viewer_reach(LSF_VIEWER_CLICK);
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
        lsf_viewer_reach(LSF_VIEWER_DOUBLE_CLICK);
        lsf_viewer_touch(viewer);
        return true;
    }
    if (input->pressed[LSF_BUTTON_LEFT]) {
        viewer->press_x = input->x;
        viewer->press_y = input->y;
        viewer->dragged = over_picture(viewer, xy) && !viewer->placing
                              ? lsf_viewer_handle_under_cursor(viewer, &viewer->ring_angle)
                              : -1;
    }
    bool held = viewer->dragged >= 0;
    if (held && input->down[LSF_BUTTON_LEFT])
        lsf_viewer_drag_handle(viewer);
    bool clicked = input->released[LSF_BUTTON_LEFT] && input->down[LSF_BUTTON_LEFT] && !held &&
                   hypot(input->x - viewer->press_x, input->y - viewer->press_y) < CLICK;
    if (clicked && input->modifiers == 0)
        click(viewer);
    if (!input->down[LSF_BUTTON_LEFT] || input->released[LSF_BUTTON_LEFT])
        viewer->dragged = -1;
    return held;
}
