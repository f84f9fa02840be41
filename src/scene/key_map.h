/* A hash map from three 32-bit words to a number, for finding vertices and edges that triangles
 * share. */
#ifndef LSF_SCENE_KEY_MAP_H
#define LSF_SCENE_KEY_MAP_H

#include <stdbool.h>
#include <stdint.h>

typedef struct lsf_key {
    uint32_t word[3];
} lsf_key;

typedef struct lsf_key_entry {
    lsf_key key;
    uint32_t value, used;
} lsf_key_entry;

/* Zeroed: empty. */
typedef struct lsf_key_map {
    lsf_key_entry *entries;
    uint64_t capacity, count; /* capacity: 0 or a power of two */
} lsf_key_map;

/* The value at `key`; `fresh` is set when there was none, and the key is added. */
bool lsf_key_map_find(lsf_key_map *map, lsf_key key, uint32_t fresh, uint32_t *value);
void lsf_key_map_clear(lsf_key_map *map);
void lsf_key_map_finish(lsf_key_map *map);

#endif
