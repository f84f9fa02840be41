/* Completions of the command line in shells, made from the option table. */
#ifndef LSF_TOOLS_COMPLETION_H
#define LSF_TOOLS_COMPLETION_H

#include "base/base.h"

void lsf_completion_add_bash(lsf_string *page);
void lsf_completion_add_fish(lsf_string *page);
void lsf_completion_add_zsh(lsf_string *page);

#endif
