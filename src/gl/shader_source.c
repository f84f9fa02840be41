/* From files below glsl/ to the text of one stage: #version, defines, the file and its includes.
 *
 * Where each line of the text came from is kept in a table. #line would be the language's own way,
 * but Mesa forgets its file number at many expressions (22.3.6 names file 0 for an undeclared
 * identifier), and graphics debuggers show the text as one. */
#include "gl/context.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define FILE_LIMIT (1u << 20) /* bytes of one shader file */

/* A file that is being read, and the line of the file that includes it. */
typedef struct open_file {
    const char *path;
    const char *folder; /* where its #include "..." begins; NULL: it is below glsl/ */
    uint64_t line;      /* number of the line read last */
    const struct open_file *parent;
} open_file;

typedef struct builder {
    const char *shader_dir;
    lsf_shader_source *source;
    lsf_error *error;
} builder;

static bool out_of_memory(const builder *b)
{
    return lsf_error_set(b->error, LSF_ERROR_RENDER, "out of memory while reading shaders");
}

/* Adds " (included at passes/x.frag.glsl:3)", or nothing for a file that a program names. */
static void describe_includer(const open_file *file, char *text, size_t size)
{
    text[0] = '\0';
    if (file->parent)
        snprintf(text, size, " (included at %s:%llu)", file->parent->path,
                 (unsigned long long)file->parent->line);
}

static char *read_embedded(const char *path)
{
    for (const lsf_embedded_file *file = lsf_embedded_files; file->path; file++)
        if (!strcmp(file->path, path))
            return strndup((const char *)file->bytes, file->length);
    return NULL;
}

static bool leaves_folder(const char *path)
{
    for (const char *at = path; (at = strstr(at, "..")); at += 2)
        if ((at == path || at[-1] == '/') && (at[2] == '/' || at[2] == '\0'))
            return true;
    return path[0] == '/';
}

static char *read_foreign(const builder *b, const open_file *file)
{
    lsf_error reason = {0};
    size_t length = 0;
    char *text = lsf_file_read(file->path, FILE_LIMIT, &length, &reason);
    if (!text)
        lsf_error_set(b->error, LSF_ERROR_FILE, "%.256s:%llu: #include: %.3000s",
                      file->parent->path, (unsigned long long)file->parent->line, reason.message);
    return text;
}

static char *read_file(const builder *b, const open_file *file)
{
    char includer[256];
    if (file->folder)
        return read_foreign(b, file);
    describe_includer(file, includer, sizeof includer);
    if (leaves_folder(file->path)) {
        lsf_error_set(b->error, LSF_ERROR_RENDER, "%s: a shader's path must stay below glsl/%s",
                      file->path, includer);
        return NULL;
    }
    if (!b->shader_dir) {
        char *text = read_embedded(file->path);
        if (!text)
            lsf_error_set(b->error, LSF_ERROR_RENDER,
                          "%s: there is no such shader in the library%s", file->path, includer);
        return text;
    }
    lsf_error reason = {0};
    char *path = lsf_format("%s/%s", b->shader_dir, file->path);
    size_t length = 0;
    char *text = path ? lsf_file_read(path, FILE_LIMIT, &length, &reason) : NULL;
    if (!path)
        out_of_memory(b);
    else if (!text)
        lsf_error_set(b->error, LSF_ERROR_FILE,
                      "%.3000s%s. The shader folder must hold the whole of glsl/", reason.message,
                      includer);
    free(path);
    return text;
}

/* Whether a line's comments leave it inside a block comment. */
static bool ends_in_comment(const char *line, size_t length, bool inside)
{
    for (size_t i = 0; i + 1 < length; i++) {
        if (inside && line[i] == '*' && line[i + 1] == '/') {
            inside = false;
            i++;
        } else if (!inside && line[i] == '/' && line[i + 1] == '*') {
            inside = true;
            i++;
        } else if (!inside && line[i] == '/' && line[i + 1] == '/') {
            return false;
        }
    }
    return inside;
}

typedef enum include_kind {
    NO_INCLUDE,
    INCLUDE,
    SYSTEM_INCLUDE, /* <...>: below glsl/ meant for C, in the headers that C shares */
    BAD_INCLUDE,
} include_kind;

/* The text between the quotes, or the angle brackets, that `line` begins with. */
static bool take_name(const char *line, const char *end, char close, char path[static 256])
{
    const char *last = line < end ? memchr(line + 1, close, (size_t)(end - line - 1)) : NULL;
    if (!last || last == line + 1 || last - line > 256)
        return false;
    memcpy(path, line + 1, (size_t)(last - line - 1));
    path[last - line - 1] = '\0';
    return true;
}

static include_kind parse_include(const char *line, size_t length, char path[static 256])
{
    const char *end = line + length;
    while (line < end && isspace((unsigned char)*line))
        line++;
    if (line == end || *line++ != '#')
        return NO_INCLUDE;
    while (line < end && isspace((unsigned char)*line))
        line++;
    if ((size_t)(end - line) < 7 || strncmp(line, "include", 7))
        return NO_INCLUDE;
    line += 7;
    while (line < end && isspace((unsigned char)*line))
        line++;
    if (line < end && *line == '<')
        return take_name(line, end, '>', path) ? SYSTEM_INCLUDE : BAD_INCLUDE;
    if (line == end || *line != '"' || !take_name(line, end, '"', path))
        return BAD_INCLUDE;
    return INCLUDE;
}

/* The file's index, from 1; 0 when it was not read yet. */
static uint64_t find_path(const lsf_shader_source *source, const char *path)
{
    for (uint64_t i = 1; i < source->path_count; i++)
        if (!strcmp(source->paths[i], path))
            return i;
    return 0;
}

static bool add_path(const builder *b, const char *path)
{
    lsf_shader_source *source = b->source;
    void *paths = source->paths;
    if (!lsf_grow(&paths, &source->path_capacity, source->path_count + 1, sizeof(char *)))
        return out_of_memory(b);
    source->paths = paths;
    source->paths[source->path_count] = strdup(path);
    return source->paths[source->path_count++] != NULL || out_of_memory(b);
}

static bool check_cycle(const builder *b, const open_file *from, const char *path)
{
    for (const open_file *file = from; file; file = file->parent)
        if (!strcmp(file->path, path))
            return lsf_error_set(b->error, LSF_ERROR_RENDER,
                                 "%s:%llu: %s includes itself; break the circle", from->path,
                                 (unsigned long long)from->line, path);
    return true;
}

static bool add_file(const builder *b, const open_file *opened);

/* `file` is the index of the path that `from` has. */
static void add_line(const builder *b, const char *line, size_t length, const open_file *from,
                     uint64_t file)
{
    lsf_shader_source *source = b->source;
    void *origins = source->origins;
    if (!lsf_grow(&origins, &source->line_capacity, source->line_count + 1,
                  sizeof(lsf_shader_origin))) {
        source->text.failed = true;
        return;
    }
    source->origins = origins;
    source->origins[source->line_count++] =
        (lsf_shader_origin){(uint32_t)file, (uint32_t)from->line, from->folder != NULL};
    lsf_string_add_bytes(&source->text, line, length);
    lsf_string_add_bytes(&source->text, "\n", 1);
}

/* The line of the include stays as a comment, for readers of the whole text. */
static bool add_include(const builder *b, const open_file *from, uint64_t from_index,
                        const open_file *included)
{
    if (!check_cycle(b, from, included->path))
        return false;
    bool again = find_path(b->source, included->path) != 0;
    char comment[300];
    snprintf(comment, sizeof comment, "// %s %s", again ? "above:" : "begin", included->path);
    add_line(b, comment, strlen(comment), from, from_index);
    if (again)
        return true;
    if (!add_file(b, included))
        return false;
    snprintf(comment, sizeof comment, "// end %s", included->path);
    add_line(b, comment, strlen(comment), from, from_index);
    return true;
}

static bool bad_include(const builder *b, const open_file *file)
{
    return lsf_error_set(b->error, LSF_ERROR_RENDER,
                         file->folder ? "%s:%llu: write #include \"file\", or #include "
                                        "<lightsheaf/file> for one of the library"
                                      : "%s:%llu: write #include \"path\", the path below glsl/",
                         file->path, (unsigned long long)file->line);
}

/* A user's file, by its path relative to the file that names it. */
static bool include_foreign(const builder *b, open_file *file, uint64_t index, const char *name)
{
    bool alone = name[0] == '/' || strcmp(file->folder, ".") == 0;
    char *path = alone ? strdup(name) : lsf_format("%s/%s", file->folder, name);
    const char *slash = path ? strrchr(path, '/') : NULL;
    char *folder = slash ? strndup(path, (size_t)(slash - path)) : strdup(".");
    open_file included = {.path = path, .folder = folder, .parent = file};
    bool good = path && folder ? add_include(b, file, index, &included) : out_of_memory(b);
    free(path);
    free(folder);
    return good;
}

/* <lightsheaf/...>: a file that the library offers to shaders of users. */
static bool include_offered(const builder *b, open_file *file, uint64_t index, const char *name)
{
    static const char *const folders[] = {"lib", "shared"};
    static const char prefix[] = "lightsheaf/";
    char path[300];
    if (strncmp(name, prefix, strlen(prefix)) != 0)
        return bad_include(b, file);
    for (size_t i = 0; i < LSF_COUNT(folders); i++) {
        snprintf(path, sizeof path, "%s/%s", folders[i], name + strlen(prefix));
        char *embedded = read_embedded(path); /* --shader-dir holds the same files */
        free(embedded);
        open_file included = {.path = path, .parent = file};
        if (embedded)
            return add_include(b, file, index, &included);
    }
    return lsf_error_set(b->error, LSF_ERROR_RENDER,
                         "%s:%llu: #include <%s>: the library has no such file; "
                         "glsl/lib and glsl/shared hold what there is",
                         file->path, (unsigned long long)file->line, name);
}

static bool begins_with_directive(const char *line, size_t length, const char *name)
{
    size_t at = 0;
    while (at < length && (isspace((unsigned char)line[at]) || line[at] == '#'))
        at++;
    return at > 0 && memchr(line, '#', at) && length - at >= strlen(name) &&
           strncmp(line + at, name, strlen(name)) == 0;
}

/* Adds text behind the version: GLSL wants extensions there, and the library's declarations
 * stand before the user's text. */
static void hoist(const builder *b, const char *line, size_t length, const open_file *from,
                  uint64_t file)
{
    lsf_shader_source *source = b->source;
    add_line(b, line, length, from, file);
    if (source->text.failed)
        return;
    char *text = source->text.text;
    size_t head = strcspn(text, "\n") + 1, moved = length + 1;
    memmove(text + head + moved, text + head, source->text.length - head - moved);
    memcpy(text + head, line, length);
    text[head + length] = '\n';
    lsf_shader_origin origin = source->origins[source->line_count - 1];
    memmove(source->origins + 2, source->origins + 1,
            (source->line_count - 2) * sizeof *source->origins);
    source->origins[1] = origin;
}

/* Handles directives of a user's file that the text has above it already, or has to have there. */
static void add_foreign_line(const builder *b, const char *line, size_t length,
                             const open_file *file, uint64_t index)
{
    bool version = begins_with_directive(line, length, "version");
    bool extension = begins_with_directive(line, length, "extension");
    if (extension)
        hoist(b, line, length, file, index);
    add_line(b, line, version || extension ? 0 : length, file, index);
}

static bool include(const builder *b, open_file *file, uint64_t index, include_kind kind,
                    const char *name)
{
    open_file below = {.path = name, .parent = file};
    if (kind == BAD_INCLUDE)
        return bad_include(b, file);
    if (file->folder)
        return kind == INCLUDE ? include_foreign(b, file, index, name)
                               : include_offered(b, file, index, name);
    if (kind == INCLUDE)
        return add_include(b, file, index, &below);
    add_line(b, "", 0, file, index);
    return true;
}

static bool add_lines(const builder *b, open_file *file, uint64_t index, const char *content)
{
    static const char mark[] = "\xef\xbb\xbf"; /* the byte order mark of UTF-8, with which some
                                                * editors begin files */
    bool in_comment = false;
    char name[256];
    if (file->folder && strncmp(content, mark, strlen(mark)) == 0)
        content += strlen(mark);
    for (const char *line = content; *line;) {
        size_t length = strcspn(line, "\n"), next = length + (line[length] == '\n');
        if (length > 0 && line[length - 1] == '\r')
            length--;
        include_kind kind = in_comment ? NO_INCLUDE : parse_include(line, length, name);
        file->line++;
        if (kind != NO_INCLUDE) {
            if (!include(b, file, index, kind, name))
                return false;
        } else if (file->folder && !in_comment) {
            add_foreign_line(b, line, length, file, index);
        } else {
            add_line(b, line, length, file, index);
        }
        in_comment = ends_in_comment(line, length, in_comment);
        line += next;
    }
    return true;
}

static bool add_file(const builder *b, const open_file *opened)
{
    open_file file = *opened;
    char *content = read_file(b, &file);
    if (!content)
        return false;
    bool added = add_path(b, file.path) && add_lines(b, &file, b->source->path_count - 1, content);
    free(content);
    return added;
}

static bool add_part(const builder *b, const lsf_shader_part *part)
{
    open_file file = {.path = part->path, .folder = part->folder};
    if (!part->text)
        return add_file(b, &file);
    file.line = part->line > 0 ? part->line - 1 : 0;
    return add_path(b, file.path) && add_lines(b, &file, b->source->path_count - 1, part->text);
}

static bool add_preamble(const builder *b, const lsf_define *defines, uint32_t define_count)
{
    static const char version[] = "#version 450 core";
    open_file file = {.line = 1};
    if (!add_path(b, "defines"))
        return false;
    add_line(b, version, strlen(version), &file, 0);
    for (uint32_t i = 0; i < define_count; i++) {
        char *line = lsf_format("#define %s %d", defines[i].name, defines[i].value);
        if (!line)
            return out_of_memory(b);
        file.line++;
        add_line(b, line, strlen(line), &file, 0);
        free(line);
    }
    return true;
}

bool lsf_shader_source_build_parts(const char *shader_dir, const lsf_define *defines,
                                   uint32_t define_count, const lsf_shader_part *parts,
                                   uint32_t part_count, lsf_shader_source *source, lsf_error *error)
{
    *source = (lsf_shader_source){0};
    builder b = {shader_dir, source, error};
    bool built = add_preamble(&b, defines, define_count);
    for (uint32_t i = 0; built && i < part_count; i++)
        built = add_part(&b, &parts[i]);
    if (built && source->text.failed)
        built = out_of_memory(&b);
    if (!built)
        lsf_shader_source_free(source);
    return built;
}

bool lsf_shader_source_build(const char *shader_dir, const char *path, const lsf_define *defines,
                             uint32_t define_count, lsf_shader_source *source, lsf_error *error)
{
    const lsf_shader_part file = {.path = path};
    return lsf_shader_source_build_parts(shader_dir, defines, define_count, &file, 1, source,
                                         error);
}

void lsf_shader_source_free(lsf_shader_source *source)
{
    for (uint64_t i = 0; i < source->path_count; i++)
        free(source->paths[i]);
    free(source->paths);
    free(source->origins);
    free(source->text.text);
    *source = (lsf_shader_source){0};
}

/* The place that a log line begins with, and where the message goes on:
 *   Mesa    0:12(5): error: ...      NVIDIA  0(12) : error C1008: ...
 *   others  ERROR: 0:12: ...
 * The 0 counts source strings, of which there is one. Returns NULL when the line names no place. */
static const char *parse_origin(const char *line, uint64_t *number)
{
    char *end;
    bool parenthesis = line[0] == '0' && line[1] == '(';
    if (line[0] != '0' || (line[1] != ':' && !parenthesis) || !isdigit((unsigned char)line[2]))
        return NULL;
    *number = strtoull(line + 2, &end, 10);
    if (parenthesis) {
        if (*end++ != ')')
            return NULL;
    } else if (*end == '(') {
        end += strcspn(end, ")\n"); /* skips Mesa's column, which counts in the preprocessed text */
        if (*end++ != ')')
            return NULL;
    }
    while (*end == ' ')
        end++;
    if (*end++ != ':')
        return NULL;
    while (*end == ' ')
        end++;
    return end;
}

/* The text's line of that number, from 1. */
static void add_line_of_text(const lsf_shader_source *source, uint64_t number, lsf_string *mapped)
{
    const char *line = source->text.text;
    for (uint64_t i = 1; i < number; i++)
        line += strcspn(line, "\n") + 1;
    line += strspn(line, " \t");
    int length = (int)strcspn(line, "\n");
    if (length > 0)
        lsf_string_add(mapped, "    %.*s\n", length, line);
}

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static bool holds_word(const char *line, size_t length, const char *word, size_t word_length)
{
    for (size_t i = 0; i + word_length <= length; i++)
        if (memcmp(line + i, word, word_length) == 0 && (i == 0 || !is_word(line[i - 1])) &&
            (i + word_length == length || !is_word(line[i + word_length])))
            return true;
    return false;
}

/* Mesa quotes `so'. */
void lsf_shader_source_map_name(const lsf_shader_source *source, const char *message,
                                lsf_string *mapped)
{
    const char *name = strchr(message, '`'), *line = source->text.text;
    size_t length = 0;
    while (name && is_word(name[1 + length]))
        length++;
    for (uint64_t i = 0; length > 0 && i < source->line_count; i++) {
        size_t line_length = strcspn(line, "\n");
        lsf_shader_origin origin = source->origins[i];
        if (origin.foreign && holds_word(line, line_length, name + 1, length)) {
            lsf_string_add(mapped, "%s:%u: %s\n", source->paths[origin.file], origin.line, message);
            add_line_of_text(source, i + 1, mapped);
            return;
        }
        line += line_length + 1;
    }
    lsf_string_add(mapped, "%s\n", message);
}

void lsf_shader_source_map_log(const lsf_shader_source *source, const char *log, lsf_string *mapped)
{
    uint64_t shown = 0; /* line of the text: several messages may be about one */
    static const char *const severities[][2] = {{"ERROR: ", "error: "}, {"WARNING: ", "warning: "}};
    for (const char *line = log; *line;) {
        size_t length = strcspn(line, "\n");
        const char *next = line + length + (line[length] == '\n');
        const char *severity = "", *at = line;
        for (size_t i = 0; i < LSF_COUNT(severities); i++) {
            size_t prefix = strlen(severities[i][0]);
            if (!strncmp(line, severities[i][0], prefix)) {
                severity = severities[i][1];
                at = line + prefix;
            }
        }
        uint64_t number;
        const char *message = parse_origin(at, &number);
        if (message && message <= line + length && number >= 1 && number <= source->line_count) {
            lsf_shader_origin origin = source->origins[number - 1];
            lsf_string_add(mapped, "%s:%u: %s%.*s\n", source->paths[origin.file], origin.line,
                           severity, (int)(line + length - message), message);
            if (origin.foreign && number != shown)
                add_line_of_text(source, number, mapped);
            shown = number;
        } else if (length)
            lsf_string_add(mapped, "%.*s\n", (int)length, line);
        line = next;
    }
}
