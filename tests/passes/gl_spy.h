/* What the programs of a picture are given, told before each draw and dispatch. */
#ifndef LSF_TESTS_GL_SPY_H
#define LSF_TESTS_GL_SPY_H

#include "../gl/gl_test.h"

/* The most of a command. */
enum { GL_SPY_USES = 256 };

typedef enum gl_spy_role {
    GL_SPY_TEXTURE,  /* sampled or fetched, buffer textures, too */
    GL_SPY_IMAGE,    /* an image variable */
    GL_SPY_UNIFORMS, /* a uniform block */
    GL_SPY_STORAGE,  /* a shader storage block */
    GL_SPY_VERTICES, /* a vertex attribute */
} gl_spy_role;

typedef struct gl_spy_use {
    gl_spy_role role;
    GLenum kind;       /* GL_TEXTURE or GL_BUFFER; a buffer texture is its buffer */
    GLuint name;       /* 0: nothing is bound */
    char declared[64]; /* the variable's or the block's name, "" for vertices */
} gl_spy_use;

typedef struct gl_spy_command {
    GLuint program;
    char pass[64]; /* the program's label */
    bool draws;    /* else it dispatches */
    bool indirect, indexed;
    const gl_spy_use *uses;
    size_t use_count;
} gl_spy_command;

/* Puts spies before the functions of the current context; `on_command` is called before GL is. */
void gl_spy_start(void (*on_command)(const gl_spy_command *command));

/* The label of an object, "" where it has none. */
void gl_spy_label(GLenum kind, GLuint name, char label[static 64]);

/* Replaces a function of the current context by `spy`, and keeps it in `original`. */
#define GL_SPY(member, original, spy)                                                              \
    do {                                                                                           \
        original = glad_current->member;                                                           \
        glad_current->member = spy;                                                                \
    } while (0)

#endif
