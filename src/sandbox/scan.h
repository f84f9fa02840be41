/* Names and annotations in a shader's text. */
#ifndef LSF_SANDBOX_SCAN_H
#define LSF_SANDBOX_SCAN_H

#include "gl/shader_source.h"
#include "sandbox/text.h"

/* Notes the names and annotations in lines of files that are not the library's. LSF_ERROR_RENDER
 * names path and line of an annotation that makes no sense. */
bool lsf_sandbox_scan(lsf_sandbox_text *text, lsf_sandbox_pass_text *pass,
                      const lsf_shader_source *source, lsf_error *error);

#endif
