/* What each feature of a scene costs: its plan with and without it. */
#ifndef LSF_TOOLS_PRICES_H
#define LSF_TOOLS_PRICES_H

#include <lightsheaf/renderer.h>

#include "sweep/measurement.h"
#include "tools/json.h"

typedef struct lsf_feature_price {
    lsf_feature feature;
    lsf_price price;
    lsf_estimate milliseconds; /* of a frame, that it saves; NAN: not measured */
} lsf_feature_price;

typedef struct lsf_prices {
    const char *technique; /* of the parameters */
    uint32_t width, height;
    lsf_feature_price features[LSF_FEATURE_COUNT];
    uint32_t count;
} lsf_prices;

/* The plan whose parts are counted, of a scene. NULL: it cannot be made. */
typedef lsf_plan *lsf_prices_plan(const void *user, const lsf_scene *scene, lsf_error *error);

/* Prices all features that the scene has and can do without. `prices` is to be finished either
 * way. */
bool lsf_prices_make(lsf_prices *prices, const lsf_scene *scene, const lsf_render_params *params,
                     lsf_error *error);
/* The same of other plans than those of a technique; `params` say what the prices are called. */
bool lsf_prices_make_of(lsf_prices *prices, const lsf_scene *scene, const lsf_render_params *params,
                        lsf_prices_plan *plan, const void *user, lsf_error *error);
void lsf_prices_finish(lsf_prices *prices);

void lsf_prices_add_text(lsf_string *text, const lsf_prices *prices);
/* An object, or null where nothing was priced. */
void lsf_prices_add_json(lsf_json *json, const char *name, const lsf_prices *prices);

#endif
