#include "tools/machine.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/utsname.h>
#include <unistd.h>

/* "model name" of Linux' list of processors; malloc'ed, NULL: not known. */
static char *processor_name(void)
{
    FILE *file = fopen("/proc/cpuinfo", "r");
    char *line = NULL, *name = NULL;
    size_t size = 0;
    while (file && !name && getline(&line, &size, file) > 0) {
        char *colon = strchr(line, ':');
        if (strncmp(line, "model name", strlen("model name")) != 0 || !colon)
            continue;
        line[strcspn(line, "\n")] = '\0';
        name = strdup(colon + 1 + strspn(colon + 1, " \t"));
    }
    free(line);
    if (file)
        fclose(file);
    return name;
}

void lsf_machine_add(lsf_json *json)
{
    struct utsname system;
    char *processor = processor_name();
    long cores = sysconf(_SC_NPROCESSORS_ONLN), pages = sysconf(_SC_PHYS_PAGES);
    lsf_json_begin(json, "machine", '{');
    lsf_json_string(json, "processor", processor);
    lsf_json_integer(json, "cores", cores > 0 ? (uint64_t)cores : 0);
    lsf_json_integer(json, "memory_bytes",
                     pages > 0 ? (uint64_t)pages * (uint64_t)sysconf(_SC_PAGESIZE) : 0);
    if (uname(&system) == 0) {
        char *text = lsf_format("%s %s %s", system.sysname, system.release, system.machine);
        lsf_json_string(json, "system", text);
        free(text);
    }
    lsf_json_end(json, '}');
    free(processor);
}
