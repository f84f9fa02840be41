/* A camera that orbits its target, as the user drags it; scene units. Position and target are
 * floats, as `lightsheaf render` takes them: what is shown can be rendered to the same bits. */
#ifndef LSF_VIEW_CAMERA_H
#define LSF_VIEW_CAMERA_H

#include <lightsheaf/lightsheaf.h>

typedef struct lsf_viewer_camera {
    bool own;                        /* moved by the user; else the file's camera, wherever it is */
    float position[3], target[3];    /* not the same point */
    float fov_y;                     /* degrees; NAN: the file's camera's own */
    float extent;                    /* half the diagonal of the scene: the unit of steps */
    float shown_fov_y, shown_height; /* those of the picture, wherever they come from; height 0:
                                      * perspective */
} lsf_viewer_camera;

/* The file's camera that `params` choose, as they choose it. */
bool lsf_viewer_camera_reset(lsf_viewer_camera *camera, const lsf_scene *scene,
                             const lsf_render_params *params, lsf_error *error);

/* `dx`, `dy`: movement of the cursor, in heights of the picture. */
void lsf_viewer_camera_orbit(lsf_viewer_camera *camera, double dx, double dy);
void lsf_viewer_camera_pan(lsf_viewer_camera *camera, double dx, double dy);
void lsf_viewer_camera_look(lsf_viewer_camera *camera, double dx, double dy);
/* Zooms in by so many notches. */
void lsf_viewer_camera_zoom(lsf_viewer_camera *camera, double notches);
/* Moves along its own axes, in metres of a scene of extent 1. */
void lsf_viewer_camera_fly(lsf_viewer_camera *camera, double right, double up, double forward);
/* Orbits a point from now on, which moves to the middle. */
void lsf_viewer_camera_focus(lsf_viewer_camera *camera, const double point[3]);

typedef enum lsf_viewer_axis {
    LSF_VIEWER_FRONT,
    LSF_VIEWER_BACK,
    LSF_VIEWER_RIGHT,
    LSF_VIEWER_LEFT,
    LSF_VIEWER_TOP,
    LSF_VIEWER_BOTTOM
} lsf_viewer_axis;
/* Looks at the same point, from as far away. */
void lsf_viewer_camera_from(lsf_viewer_camera *camera, lsf_viewer_axis axis);
/* Shows all of the bounds from its current direction. */
void lsf_viewer_camera_frame(lsf_viewer_camera *camera, const lsf_requirements *scene,
                             double aspect);

/* The view that a renderer's frame takes. */
lsf_view lsf_viewer_camera_view(const lsf_viewer_camera *camera);
/* Sets the camera's parameters; they borrow it. */
void lsf_viewer_camera_params(const lsf_viewer_camera *camera, lsf_render_params *params);

/* Right, up and forward, unit vectors. */
void lsf_viewer_camera_axes(const lsf_viewer_camera *camera, double axes[3][3]);
/* The ray through a position in the picture: x, y from -1 to 1, y upwards. */
void lsf_viewer_camera_ray(const lsf_viewer_camera *camera, double x, double y, double aspect,
                           double origin[3], double direction[3]);
/* The position of a point in the picture, as above; false behind the camera. */
bool lsf_viewer_camera_project(const lsf_viewer_camera *camera, const double point[3],
                               double aspect, double xy[2]);

#endif
