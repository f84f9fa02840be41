/* A window with the program's own context, which orbits a scene on the GPU; C and C++ alike. */
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <lightsheaf/lightsheaf.h>
#include <math.h>
#include <stdio.h>

enum { WIDTH = 96, HEIGHT = 72, NO_WINDOW = 77 };

static void (*find_function(void *user, const char *name))(void)
{
    (void)user;
    return glfwGetProcAddress(name);
}

static GLFWwindow *open_window(void)
{
    glfwInit();
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 5);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    GLFWwindow *window = glfwCreateWindow(WIDTH, HEIGHT, "Orbit", NULL, NULL);
    glfwMakeContextCurrent(window);
    return window;
}

/* In front of the scene, swinging from side to side. */
static bool draw(lsf_renderer *renderer, const lsf_requirements *scene, int k, lsf_error *error)
{
    const int32_t viewport[4] = {0, 0, WIDTH, HEIGHT};
    const double angle = 0.5 * sin(0.2 * k), distance = 2.0 / scene->scale;
    lsf_view view = {{0, scene->center[1], 0}, {0, 0, 0}, {0, 1, 0}, 40, 0, 0};
    view.position[0] = scene->center[0] + distance * sin(angle);
    view.position[2] = scene->center[2] + distance * cos(angle);
    view.forward[0] = (float)-sin(angle), view.forward[2] = (float)-cos(angle);
    lsf_frame frame = {LSF_FRAME_DEFAULTS};
    frame.view = &view;
    return lsf_renderer_begin_frame(renderer, &frame, error) &&
           lsf_renderer_iterate(renderer, error) &&
           lsf_renderer_present(renderer, 0, viewport, 0, LSF_TONE_CURVE_NEUTRAL, error);
}

static void print_sum(void)
{
    static unsigned char texels[WIDTH * HEIGHT * 4];
    unsigned long sum = 0;
    void (*read)(int, int, int, int, unsigned, unsigned, void *);
    *(GLFWglproc *)&read = glfwGetProcAddress("glReadPixels");
    read(0, 0, WIDTH, HEIGHT, 0x1908, 0x1401, texels); /* GL_RGBA, GL_UNSIGNED_BYTE */
    for (size_t i = 0; i < sizeof texels; i++)
        sum += texels[i];
    printf("%lu\n", sum); /* for the test, which cannot see the window */
}

int main(int argc, char **argv)
{
    lsf_error error = {LSF_OK, ""};
    GLFWwindow *window = open_window();
    if (argc != 2 || !window)
        return NO_WINDOW;
    lsf_context_wrap_params own = {LSF_CONTEXT_WRAP_PARAMS_DEFAULTS};
    own.get_proc_address = find_function;
    lsf_render_params params = {LSF_RENDER_PARAMS_DEFAULTS};
    params.width = WIDTH, params.height = HEIGHT, params.present = true, params.bounces = 1;
    lsf_context *context = lsf_context_wrap(&own, &error);
    lsf_scene *scene = context ? lsf_scene_load(argv[1], NULL, &error) : NULL;
    lsf_renderer *renderer = scene ? lsf_renderer_create(context, scene, &params, &error) : NULL;
    bool good = renderer != NULL;
    for (int k = 0; good && k < 4 && !glfwWindowShouldClose(window); k++) {
        good = draw(renderer, lsf_scene_get_requirements(scene), k, &error);
        print_sum();
        glfwSwapBuffers(window);
        glfwPollEvents();
    }
    lsf_renderer_destroy(renderer);
    lsf_scene_destroy(scene);
    lsf_context_destroy(context);
    fprintf(stderr, "%s", good ? "" : error.message);
    return !good;
}
