#include "sandbox/text.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/base.h"
#include "gl/shader_source.h"
#include "sandbox/scan.h"

#define FILE_LIMIT (1u << 20) /* bytes of a shader */

static bool out_of_memory(lsf_error *error)
{
    return lsf_error_set(error, LSF_ERROR_RENDER, "out of memory while reading a shader");
}

const char *lsf_sandbox_pass_name(uint32_t pass)
{
    static const char *const names[LSF_SANDBOX_PASSES] = {"a", "b", "c", "d", "image"};
    return names[pass];
}

/* --- files --- */

lsf_sandbox_stamp lsf_sandbox_stamp_of(const char *path)
{
    struct stat status;
    if (!path || stat(path, &status) != 0)
        return (lsf_sandbox_stamp){-1, -1, -1, -1};
    return (lsf_sandbox_stamp){status.st_mtim.tv_sec, status.st_mtim.tv_nsec,
                               (int64_t)status.st_ino, status.st_size};
}

bool lsf_sandbox_text_watch(lsf_sandbox_text *text, const char *path)
{
    for (uint64_t i = 0; i < text->file_count; i++)
        if (strcmp(text->files[i].path, path) == 0)
            return true;
    void *files = text->files;
    if (!lsf_grow(&files, &text->file_capacity, text->file_count + 1, sizeof *text->files))
        return false;
    text->files = files;
    lsf_sandbox_file *file = &text->files[text->file_count];
    file->path = strdup(path);
    if (!file->path)
        return false;
    file->stamp = lsf_sandbox_stamp_of(path);
    text->file_count++;
    return true;
}

bool lsf_sandbox_text_changed(const lsf_sandbox_text *text)
{
    for (uint64_t i = 0; i < text->file_count; i++) {
        const lsf_sandbox_file *file = &text->files[i];
        const lsf_sandbox_stamp now = lsf_sandbox_stamp_of(file->path);
        if (memcmp(&now, &file->stamp, sizeof now) != 0)
            return true;
    }
    return false;
}

static bool ends_with(const char *path, const char *ending)
{
    size_t length = strlen(path), end = strlen(ending);
    return length > end && strcmp(path + length - end, ending) == 0;
}

/* --- passes --- */

static bool set_part(lsf_shader_part *part, const lsf_sandbox_text *text, const char *path,
                     const char *content, size_t length, uint32_t line)
{
    *part = (lsf_shader_part){.path = strdup(path),
                              .text = strndup(content, length),
                              .folder = strdup(text->folder),
                              .line = line};
    return part->path && part->text && part->folder;
}

static void free_part(lsf_shader_part *part)
{
    free((char *)part->path);
    free((char *)part->text);
    free((char *)part->folder);
    *part = (lsf_shader_part){0};
}

/* What "// @buffer a" and its like begin: a pass, LSF_SANDBOX_PASSES for what is common to all, or
 * -1 for any other line. */
static int section_of(const char *line, size_t length)
{
    char word[16], name[4];
    int end = 0;
    while (length > 0 && isspace((unsigned char)*line)) {
        line++;
        length--;
    }
    char start[64];
    snprintf(start, sizeof start, "%.*s", (int)length, line);
    int count = sscanf(start, "// @%15[a-z] %n%3s", word, &end, name);
    if (count >= 1 && strcmp(word, "common") == 0)
        return LSF_SANDBOX_PASSES;
    if (count >= 1 && strcmp(word, "image") == 0)
        return LSF_SANDBOX_IMAGE;
    if (count == 2 && strcmp(word, "buffer") == 0 && name[1] == '\0' && name[0] >= 'a' &&
        name[0] <= 'd')
        return name[0] - 'a';
    return -1;
}

static lsf_shader_part *part_of(lsf_sandbox_text *text, int section)
{
    return section == LSF_SANDBOX_PASSES ? &text->common : &text->passes[section].part;
}

static bool end_section(lsf_sandbox_text *text, const char *path, int section, const char *start,
                        const char *end, uint32_t line, lsf_error *error)
{
    lsf_shader_part *part = part_of(text, section);
    if (part->text)
        return lsf_error_set(
            error, LSF_ERROR_RENDER, "%s:%u: %s is there already", path, line - 1,
            section == LSF_SANDBOX_PASSES ? "@common" : lsf_sandbox_pass_name((uint32_t)section));
    return set_part(part, text, path, start, (size_t)(end - start), line) || out_of_memory(error);
}

/* What stands before the first section is common to all; without sections, all is the picture's. */
static bool split(lsf_sandbox_text *text, const char *path, const char *content, lsf_error *error)
{
    int section = LSF_SANDBOX_PASSES;
    const char *start = content;
    uint32_t line = 1, start_line = 1;
    bool divided = false;
    for (const char *at = content; *at; line++) {
        size_t length = strcspn(at, "\n");
        const char *next = at + length + (at[length] == '\n');
        int begins = section_of(at, length);
        if (begins >= 0) {
            bool leading = !divided && begins == LSF_SANDBOX_PASSES; /* they are one */
            if (!leading && !end_section(text, path, section, start, at, start_line, error))
                return false;
            section = begins;
            start = leading ? content : next;
            start_line = leading ? 1 : line + 1;
            divided = true;
        }
        at = next;
    }
    return end_section(text, path, divided ? section : LSF_SANDBOX_IMAGE, start,
                       content + strlen(content), start_line, error);
}

/* "name.a.frag" beside "name.frag"; there need be none. */
static bool read_beside(lsf_sandbox_text *text, const char *stem, const char *ending,
                        lsf_shader_part *part, lsf_error *error)
{
    char *path = lsf_format("%s%s", stem, ending);
    char *content = NULL;
    size_t length = 0;
    struct stat status;
    if (!path || !lsf_sandbox_text_watch(text, path)) {
        free(path);
        return out_of_memory(error);
    }
    bool good = true;
    if (stat(path, &status) == 0) {
        content = lsf_file_read(path, FILE_LIMIT, &length, error);
        good = content != NULL;
        if (good && part->text)
            good = lsf_error_set(error, LSF_ERROR_RENDER,
                                 "%s: the same is a section of the shader; leave one of them out",
                                 path);
        good = good && (set_part(part, text, path, content, length, 1) || out_of_memory(error));
    }
    free(content);
    free(path);
    return good;
}

static bool read_beside_all(lsf_sandbox_text *text, const char *path, lsf_error *error)
{
    const char *dot = strrchr(path, '.');
    if (!dot || strchr(dot, '/'))
        return true;
    char *stem = strndup(path, (size_t)(dot - path));
    bool good = stem && read_beside(text, stem, ".common.glsl", &text->common, error);
    for (uint32_t i = 0; good && i < LSF_SANDBOX_IMAGE; i++) {
        lsf_sandbox_pass_text *pass = &text->passes[i];
        char ending[16];
        snprintf(ending, sizeof ending, ".%c.frag", 'a' + (int)i);
        good = read_beside(text, stem, ending, &pass->part, error);
        snprintf(ending, sizeof ending, ".%c.comp", 'a' + (int)i);
        good = good && read_beside(text, stem, ending, &pass->part, error);
    }
    free(stem);
    return good;
}

static bool watch_included(lsf_sandbox_text *text, const lsf_shader_source *source)
{
    bool good = true;
    for (uint64_t i = 0; i < source->line_count && good; i++)
        if (source->origins[i].foreign)
            good = lsf_sandbox_text_watch(text, source->paths[source->origins[i].file]);
    return good;
}

/* What the pass names, by its text and that of the files that it includes. */
static bool scan_pass(lsf_sandbox_text *text, uint32_t index, const char *shader_dir,
                      lsf_error *error)
{
    lsf_sandbox_pass_text *pass = &text->passes[index];
    lsf_shader_part parts[2];
    uint32_t count = 0;
    if (!pass->part.text)
        return true;
    if (text->common.text)
        parts[count++] = text->common;
    parts[count++] = pass->part;
    pass->compute = ends_with(pass->part.path, ".comp");
    lsf_shader_source source;
    if (!lsf_shader_source_build_parts(shader_dir, NULL, 0, parts, count, &source, error))
        return false;
    bool good = (watch_included(text, &source) || out_of_memory(error)) &&
                lsf_sandbox_scan(text, pass, &source, error);
    lsf_shader_source_free(&source);
    if (good && !pass->main && !pass->main_image)
        good = lsf_error_set(error, LSF_ERROR_RENDER,
                             "%s:%u: there is neither void mainImage(out vec4 fragColor, in vec2 "
                             "fragCoord) nor void main()",
                             pass->part.path, pass->part.line);
    if (good && pass->compute && !pass->main)
        good = lsf_error_set(error, LSF_ERROR_RENDER, "%s:%u: a compute shader needs void main()",
                             pass->part.path, pass->part.line);
    text->needs |= pass->needs;
    return good;
}

bool lsf_sandbox_text_read(lsf_sandbox_text *text, const char *shader_dir, const char *path,
                           const char *content, lsf_error *error)
{
    *text = (lsf_sandbox_text){0};
    const char *slash = strrchr(path, '/');
    text->folder = slash ? strndup(path, slash == path ? 1 : (size_t)(slash - path)) : strdup(".");
    if (!text->folder || (!content && !lsf_sandbox_text_watch(text, path)))
        return out_of_memory(error);
    size_t length;
    char *read = content ? NULL : lsf_file_read(path, FILE_LIMIT, &length, error);
    if (!content && !read)
        return false;
    bool good = split(text, path, content ? content : read, error);
    free(read);
    good = good && (content || read_beside_all(text, path, error));
    if (good && !text->passes[LSF_SANDBOX_IMAGE].part.text)
        good = lsf_error_set(error, LSF_ERROR_RENDER,
                             "%s: there are buffers, but no picture; begin its section with // "
                             "@image",
                             path);
    for (uint32_t i = 0; good && i < LSF_SANDBOX_PASSES; i++)
        good = scan_pass(text, i, shader_dir, error);
    return good;
}

static void free_pass(lsf_sandbox_pass_text *pass)
{
    free_part(&pass->part);
    for (size_t i = 0; i < LSF_SANDBOX_NAMES; i++)
        free(pass->locations[i].path);
    for (size_t i = 0; i < LSF_SANDBOX_CHANNELS; i++) {
        free(pass->channels[i].source);
        free(pass->channels[i].location.path);
    }
}

void lsf_sandbox_text_finish(lsf_sandbox_text *text)
{
    free(text->folder);
    free_part(&text->common);
    for (size_t i = 0; i < LSF_SANDBOX_PASSES; i++)
        free_pass(&text->passes[i]);
    for (uint64_t i = 0; i < text->define_count; i++)
        free(text->defines[i]);
    for (uint64_t i = 0; i < text->uniform_count; i++)
        free(text->uniforms[i].name);
    for (uint64_t i = 0; i < text->file_count; i++)
        free(text->files[i].path);
    free(text->light_location.path);
    free(text->defines);
    free(text->uniforms);
    free(text->files);
    *text = (lsf_sandbox_text){0};
}
