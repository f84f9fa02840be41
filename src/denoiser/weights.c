/* The file of weights that the library is built with, and those that users name. */
#include <stdlib.h>

#include "denoiser/net.h"

#define FILE_BYTES_MAX ((uint64_t)64 << 20)

/* Of the built-in file. */
extern const unsigned char lsf_net_built_in[], lsf_net_built_in_end[];

__asm__(".pushsection .rodata\n"
        ".balign 16\n"
        ".hidden lsf_net_built_in\n"
        ".hidden lsf_net_built_in_end\n"
        ".globl lsf_net_built_in\n"
        ".globl lsf_net_built_in_end\n"
        "lsf_net_built_in:\n"
        ".incbin \"" LSF_NET_FILE "\"\n"
        "lsf_net_built_in_end:\n"
        ".byte 0\n"
        ".popsection\n");

lsf_net *lsf_net_load(const char *path, lsf_error *error)
{
    if (path) {
        size_t length;
        char *bytes = lsf_file_read(path, FILE_BYTES_MAX, &length, error);
        lsf_net *net = bytes ? lsf_net_read(bytes, length, path, error) : NULL;
        free(bytes);
        return net;
    }
    return lsf_net_read(lsf_net_built_in, (size_t)(lsf_net_built_in_end - lsf_net_built_in),
                        "the built-in weights", error);
}
