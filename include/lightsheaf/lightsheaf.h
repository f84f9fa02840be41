/* Lightsheaf: global illumination by rasterisation. Includes the whole public API. */
#ifndef LIGHTSHEAF_H
#define LIGHTSHEAF_H

#include <lightsheaf/bench.h>
#include <lightsheaf/compare.h>
#include <lightsheaf/context.h>
#include <lightsheaf/edit.h>
#include <lightsheaf/error.h>
#include <lightsheaf/image.h>
#include <lightsheaf/log.h>
#include <lightsheaf/reference.h>
#include <lightsheaf/renderer.h>
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

/* "major.minor.patch" of the library that is running. */
const char *lsf_version(void);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif
#ifdef __cplusplus
}
#endif
#endif
