#include "scene/key_map.h"

#include <stdlib.h>
#include <string.h>

#include "base/base.h"
#include "math/sampling.h"

/* The key's entry, or the free entry where it belongs. */
static lsf_key_entry *slot_of(const lsf_key_map *map, lsf_key key)
{
    uint64_t hash =
        lsf_hash64(((uint64_t)key.word[0] << 32 | key.word[1]) ^ lsf_hash64(key.word[2]));
    for (;; hash++) {
        lsf_key_entry *entry = &map->entries[hash & (map->capacity - 1)];
        if (!entry->used || memcmp(&entry->key, &key, sizeof key) == 0)
            return entry;
    }
}

static bool grow(lsf_key_map *map)
{
    lsf_key_map larger = {.capacity = map->capacity ? 2 * map->capacity : 64, .count = map->count};
    larger.entries = lsf_alloc(larger.capacity, sizeof *larger.entries);
    if (!larger.entries)
        return false;
    for (uint64_t i = 0; i < map->capacity; i++)
        if (map->entries[i].used)
            *slot_of(&larger, map->entries[i].key) = map->entries[i];
    free(map->entries);
    *map = larger;
    return true;
}

bool lsf_key_map_find(lsf_key_map *map, lsf_key key, uint32_t fresh, uint32_t *value)
{
    /* It is at most half full, so that probes stay short. */
    if (2 * map->count >= map->capacity && !grow(map))
        return false;
    lsf_key_entry *entry = slot_of(map, key);
    if (!entry->used) {
        *entry = (lsf_key_entry){key, fresh, 1};
        map->count++;
    }
    *value = entry->value;
    return true;
}

void lsf_key_map_clear(lsf_key_map *map)
{
    if (map->count)
        memset(map->entries, 0, map->capacity * sizeof *map->entries);
    map->count = 0;
}

void lsf_key_map_finish(lsf_key_map *map)
{
    free(map->entries);
    *map = (lsf_key_map){0};
}
