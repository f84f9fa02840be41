/* The file of weights that the library is built with, and nothing where there is none. */
#include "denoiser/net.h"

extern const unsigned char lsf_net_built_in[], lsf_net_built_in_end[];

__asm__(".pushsection .rodata\n"
        ".balign 16\n"
        ".hidden lsf_net_built_in\n"
        ".hidden lsf_net_built_in_end\n"
        ".globl lsf_net_built_in\n"
        ".globl lsf_net_built_in_end\n"
        "lsf_net_built_in:\n"
#ifdef LSF_NET_FILE
        ".incbin \"" LSF_NET_FILE "\"\n"
#endif
        "lsf_net_built_in_end:\n"
        ".byte 0\n"
        ".popsection\n");
