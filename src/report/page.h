/* The page that a report is filled into, UTF-8: what stands before the data, and what follows. */
#ifndef LSF_REPORT_PAGE_H
#define LSF_REPORT_PAGE_H

#include <stddef.h>

extern const unsigned char lsf_report_head[], lsf_report_tail[];
extern const size_t lsf_report_head_length, lsf_report_tail_length;

#endif
