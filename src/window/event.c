#include "window/event.h"

#include "base/base.h"
#include "window/window.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* The kind of argument that follows an event's word. */
typedef enum event_form {
    FORM_ALONE,
    FORM_KEY,
    FORM_CODE,
    FORM_X,
    FORM_XY,
    FORM_XY_TEXT,
    FORM_TEXT
} event_form;

static const struct {
    const char *word;
    event_form form;
} forms[LSF_EVENT_COUNT] = {
    [LSF_EVENT_KEY_DOWN] = {"key", FORM_KEY},
    [LSF_EVENT_KEY_UP] = {"key-up", FORM_KEY},
    [LSF_EVENT_TEXT] = {"text", FORM_CODE},
    [LSF_EVENT_MOVE] = {"move", FORM_XY},
    [LSF_EVENT_BUTTON_DOWN] = {"button", FORM_CODE},
    [LSF_EVENT_BUTTON_UP] = {"button-up", FORM_CODE},
    [LSF_EVENT_SCROLL] = {"scroll", FORM_X},
    [LSF_EVENT_DROP] = {"drop", FORM_TEXT},
    [LSF_EVENT_SIZE] = {"size", FORM_XY},
    [LSF_EVENT_STEP] = {"step", FORM_X},
    [LSF_EVENT_CLOSE] = {"close", FORM_ALONE},
    [LSF_EVENT_PRESS] = {"press", FORM_TEXT},
    [LSF_EVENT_DRAG] = {"drag", FORM_XY_TEXT},
    [LSF_EVENT_SET] = {"set", FORM_TEXT},
    [LSF_EVENT_SETTLE] = {"settle", FORM_ALONE},
    [LSF_EVENT_SNAPSHOT] = {"snapshot", FORM_TEXT},
    [LSF_EVENT_MINIMISE] = {"minimise", FORM_ALONE},
    [LSF_EVENT_LOSE] = {"lose-context", FORM_ALONE},
};

static const struct {
    int key;
    const char *name;
} named_keys[] = {
    {' ', "Space"},
    {LSF_KEY_ESCAPE, "Escape"},
    {LSF_KEY_ENTER, "Enter"},
    {LSF_KEY_TAB, "Tab"},
    {LSF_KEY_BACKSPACE, "Backspace"},
    {LSF_KEY_DELETE, "Delete"},
    {LSF_KEY_RIGHT, "Right"},
    {LSF_KEY_LEFT, "Left"},
    {LSF_KEY_DOWN, "Down"},
    {LSF_KEY_UP, "Up"},
    {LSF_KEY_PAGE_UP, "PageUp"},
    {LSF_KEY_PAGE_DOWN, "PageDown"},
    {LSF_KEY_HOME, "Home"},
    {LSF_KEY_END, "End"},
    {LSF_KEY_PAD_ENTER, "PadEnter"},
    {340, "Shift"},
    {341, "Control"},
    {342, "Alt"},
    {344, "RightShift"},
    {345, "RightControl"},
    {346, "RightAlt"},
};

const char *lsf_key_name(int key)
{
    static const char letters[] = "!\"#$%&'()*+,-./0123456789:;<=>?@ABCDEFGHIJKLMNOPQRSTUVWXYZ"
                                  "[\\]^_`";
    static char printed[2 * sizeof letters];
    static const char *const functions[] = {"F1", "F2", "F3", "F4",  "F5",  "F6",
                                            "F7", "F8", "F9", "F10", "F11", "F12"};
    static const char *const pad[] = {"Pad0", "Pad1", "Pad2", "Pad3", "Pad4",
                                      "Pad5", "Pad6", "Pad7", "Pad8", "Pad9"};
    for (size_t i = 0; i < LSF_COUNT(named_keys); i++)
        if (named_keys[i].key == key)
            return named_keys[i].name;
    if (key >= LSF_KEY_F1 && key <= LSF_KEY_F12)
        return functions[key - LSF_KEY_F1];
    if (key >= LSF_KEY_PAD_0 && key <= LSF_KEY_PAD_0 + 9)
        return pad[key - LSF_KEY_PAD_0];
    if (key < '!' || key > '`')
        return NULL;
    char *name = &printed[2 * (key - '!')];
    name[0] = letters[key - '!'];
    return name;
}

static int key_of(const char *name)
{
    for (int key = ' '; key < LSF_KEY_LIMIT; key++)
        if (lsf_key_name(key) && strcmp(lsf_key_name(key), name) == 0)
            return key;
    return -1;
}

void lsf_event_write(FILE *file, uint64_t frame, const lsf_event *event)
{
    char numbers[64] = "";
    const char *words = event->text;
    switch (forms[event->kind].form) {
    case FORM_ALONE:
        words = "";
        break;
    case FORM_KEY:
        words = lsf_key_name(event->code);
        break;
    case FORM_CODE:
        lsf_print(numbers, sizeof numbers, "%d", event->code);
        break;
    case FORM_X:
        lsf_print(numbers, sizeof numbers, "%.9g", event->x);
        break;
    case FORM_XY:
    case FORM_XY_TEXT: /* of a replay alone */
        lsf_print(numbers, sizeof numbers, "%.9g %.9g", event->x, event->y);
        break;
    case FORM_TEXT:
        break;
    }
    if (words || numbers[0])
        fprintf(file, "%" PRIu64 " %s %s\n", frame, forms[event->kind].word,
                numbers[0] ? numbers : words);
}

/* --- reading --- */

static bool read_words(lsf_event *event, const char *words)
{
    char *end = NULL;
    switch (forms[event->kind].form) {
    case FORM_ALONE:
        return *words == '\0';
    case FORM_KEY:
        event->code = key_of(words);
        return event->code >= 0;
    case FORM_CODE:
        event->code = (int)strtol(words, &end, 10);
        return end != words && *end == '\0' && event->code >= 0 &&
               (event->kind == LSF_EVENT_TEXT || event->code < LSF_BUTTON_COUNT);
    case FORM_X:
        event->x = lsf_read_number(words, &end);
        return end != words && *end == '\0';
    case FORM_XY:
    case FORM_XY_TEXT:
        event->x = lsf_read_number(words, &end);
        if (end == words || *end != ' ')
            return false;
        words = end + 1;
        event->y = lsf_read_number(words, &end);
        if (end == words)
            return false;
        event->text = end + 1;
        return forms[event->kind].form == FORM_XY ? *end == '\0' : *end == ' ' && end[1] != '\0';
    case FORM_TEXT:
        event->text = words;
        return *words != '\0';
    }
    return false;
}

/* FRAME WORD [ARGUMENT]... */
static bool read_line(struct lsf_replay_line *line, char *text)
{
    char *end;
    line->frame = strtoull(text, &end, 10);
    if (end == text || *end != ' ')
        return false;
    char *word = end + 1, *rest = word + strcspn(word, " ");
    if (*rest == ' ')
        *rest++ = '\0';
    for (int kind = 0; kind < LSF_EVENT_COUNT; kind++)
        if (strcmp(forms[kind].word, word) == 0) {
            line->event = (lsf_event){.kind = (lsf_event_kind)kind};
            return read_words(&line->event, rest);
        }
    return false;
}

bool lsf_replay_load(lsf_replay *replay, const char *path, lsf_error *error)
{
    size_t length;
    *replay = (lsf_replay){0};
    replay->content = lsf_file_read(path, 1 << 26, &length, error);
    if (!replay->content)
        return false;
    uint64_t frame = 0, number = 0;
    char *rest = replay->content;
    for (char *text; (text = strsep(&rest, "\n"));) {
        number++;
        if (*text == '\0' || *text == '#')
            continue;
        struct lsf_replay_line line;
        if (!read_line(&line, text) || line.frame < frame)
            return lsf_error_set(error, LSF_ERROR_FILE,
                                 "%s:%" PRIu64 ": not an interaction: expected a frame's number, "
                                 "not below the one before, and what is done, as in `12 key F12`",
                                 path, number);
        frame = line.frame;
        if (!lsf_grow((void **)&replay->lines, &replay->capacity, replay->count + 1, sizeof line))
            return lsf_error_set(error, LSF_ERROR_RENDER, "%s: no memory left", path);
        replay->lines[replay->count++] = line;
    }
    return true;
}

const lsf_event *lsf_replay_take(lsf_replay *replay, uint64_t frame)
{
    if (lsf_replay_ended(replay) || replay->lines[replay->next].frame > frame)
        return NULL;
    return &replay->lines[replay->next++].event;
}

bool lsf_replay_ended(const lsf_replay *replay)
{
    return replay->next == replay->count;
}

void lsf_replay_finish(lsf_replay *replay)
{
    free(replay->lines);
    free(replay->content);
    *replay = (lsf_replay){0};
}
