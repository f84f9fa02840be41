/* The text of a shader, put together from files below glsl/ and from those of users, with the
 * place that each of its lines came from. It makes no call of OpenGL. */
#ifndef LSF_GL_SHADER_SOURCE_H
#define LSF_GL_SHADER_SOURCE_H

#include "base/base.h"
#include "gl/gl.h"

typedef struct lsf_embedded_file {
    const char *path; /* below glsl/; NULL ends the table */
    const unsigned char *bytes;
    size_t length;
} lsf_embedded_file;
extern const lsf_embedded_file lsf_embedded_files[];

typedef struct lsf_shader_origin {
    uint32_t file; /* in paths */
    uint32_t line; /* from 1 */
    bool foreign;  /* a user's file, none of the library */
} lsf_shader_origin;

typedef struct lsf_shader_source {
    lsf_string text;
    char **paths; /* [0] stands for #version and the defines */
    uint64_t path_count, path_capacity;
    lsf_shader_origin *origins; /* where each line of the text came from */
    uint64_t line_count, line_capacity;
} lsf_shader_source;

/* Puts together #version, the defines, then the file with its includes. */
bool lsf_shader_source_build(const char *shader_dir, const char *path, const lsf_define *defines,
                             uint32_t define_count, lsf_shader_source *source, lsf_error *error);
/* Does the same with parts, one after the other. */
bool lsf_shader_source_build_parts(const char *shader_dir, const lsf_define *defines,
                                   uint32_t define_count, const lsf_shader_part *parts,
                                   uint32_t part_count, lsf_shader_source *source,
                                   lsf_error *error);
void lsf_shader_source_free(lsf_shader_source *source);
/* A line of a linker's log, which names no place, gets the place where a user's text first has
 * the name that it quotes. */
void lsf_shader_source_map_name(const lsf_shader_source *source, const char *message,
                                lsf_string *mapped);
/* A driver's log, with every place as path:line:, and below it the line itself if it is a
 * user's. */
void lsf_shader_source_map_log(const lsf_shader_source *source, const char *log,
                               lsf_string *mapped);

#endif
