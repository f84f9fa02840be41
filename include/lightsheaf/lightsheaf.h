/* Lightsheaf: global illumination by rasterisation. Includes the whole public API. */
#ifndef LIGHTSHEAF_H
#define LIGHTSHEAF_H

#include <stdbool.h>
#include <stdint.h>

#include <lightsheaf/bench.h>
#include <lightsheaf/build.h>
#include <lightsheaf/compare.h>
#include <lightsheaf/context.h>
#include <lightsheaf/edit.h>
#include <lightsheaf/error.h>
#include <lightsheaf/image.h>
#include <lightsheaf/log.h>
#include <lightsheaf/reference.h>
#include <lightsheaf/renderer.h>
#include <lightsheaf/sandbox.h>
#include <lightsheaf/scene.h>

#ifdef __cplusplus
extern "C" {
#endif
#if defined(__GNUC__)
#pragma GCC visibility push(default)
#endif

#define LSF_VERSION_MAJOR 0
#define LSF_VERSION_MINOR 1
#define LSF_VERSION_PATCH 0

/* Whether these headers belong to a version, or to a later one; for #if. */
#define LSF_VERSION_AT_LEAST(major, minor, patch)                                                  \
    (LSF_VERSION_MAJOR > (major) ||                                                                \
     (LSF_VERSION_MAJOR == (major) &&                                                              \
      (LSF_VERSION_MINOR > (minor) ||                                                              \
       (LSF_VERSION_MINOR == (minor) && LSF_VERSION_PATCH >= (patch)))))

/* "major.minor.patch" of the library that is running. */
const char *lsf_version(void);
/* Whether the library that is running has the ABI of the headers of this version: below 1.0, of the
 * same minor version; from then on, of the same major one and not an older one. */
bool lsf_version_fits(uint32_t major, uint32_t minor);
/* The same for the headers that the program was compiled with. */
#define LSF_VERSION_FITS() lsf_version_fits(LSF_VERSION_MAJOR, LSF_VERSION_MINOR)

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
