#include "tools/measure_answer.h"

#include <math.h>
#include <stdlib.h>

/* Digits that the interval leaves. */
static void add_error(lsf_string *text, lsf_estimate error)
{
    lsf_string_add(text, "relMSE %.3g", error.value);
    if (isfinite(error.low) && isfinite(error.high))
        lsf_string_add(text, " (95 %%: %.3g to %.3g)", error.low, error.high);
}

/* "relMSE 0.0123 (95 %: 0.011 to 0.014) in 87 ms" */
static void add_finding(lsf_string *text, const lsf_answer *answer)
{
    add_error(text, answer->error);
    lsf_string_add(text, " in %.4g ms", answer->milliseconds);
}

static void add_question(lsf_string *text, const lsf_answer *answer)
{
    if (isnan(answer->relmse))
        lsf_string_add(text, "a frame in %g ms", answer->budget_ms);
    else
        lsf_string_add(text, "relMSE %g", answer->relmse);
}

static void add_certainty(lsf_string *text, const lsf_answer *answer)
{
    double per_cent = floor(100.0 * answer->confidence);
    lsf_string_add(text, "%u candidates, %u to the end; ", answer->candidates, answer->finalists);
    if (isnan(answer->relmse))
        lsf_string_add(text, "the probability that none of these is better by 10 %% is %.0f %%\n",
                       per_cent);
    else
        lsf_string_add(text, "the probability that its error is no larger is %.0f %%\n", per_cent);
}

void lsf_measure_add_answer(lsf_string *text, const lsf_measurement *measurement)
{
    const lsf_answer *answer = &measurement->answer;
    if (answer->met) {
        lsf_string_add(text, measurement->interrupted ? "Best so far for " : "Best for ");
        add_question(text, answer);
        lsf_string_add(text, ": ");
        add_finding(text, answer);
        lsf_string_add(text, "\n");
        if (!isnan(answer->confidence))
            add_certainty(text, answer);
    } else {
        lsf_string_add(text, "No measurement gives ");
        add_question(text, answer);
        lsf_string_add(text, "; the nearest: ");
        add_finding(text, answer);
        lsf_string_add(text, "\n");
    }
    if (measurement->interrupted)
        lsf_string_add(
            text, "The search was interrupted before it was certain; --resume continues it.\n");
    lsf_string_add(text, "\n    %s\n", answer->command);
}

bool lsf_measure_save_preset(const char *path, const lsf_settings *settings,
                             const lsf_measurement *measurement, lsf_error *error)
{
    const lsf_answer *answer = &measurement->answer;
    const lsf_configuration *configuration = &measurement->configurations[answer->configuration];
    lsf_string text = {0};
    lsf_string_add(&text, "# %s\n# ", measurement->command);
    add_finding(&text, answer);
    lsf_string_add(&text, ", at %ux%u\n", measurement->width, measurement->height);
    lsf_string_add(&text, "technique=%s\nsamples=%u\n", configuration->technique, answer->samples);
    if (settings->raw)
        lsf_string_add(&text, "raw\n");
    if (settings->bounces != LSF_BOUNCES_AUTO)
        lsf_string_add(&text, "bounces=%u\n", settings->bounces);
    for (uint32_t i = 0; i < settings->defines.count; i++)
        lsf_string_add(&text, "define=%s\n", settings->defines.items[i]);
    for (uint32_t i = 0; i < configuration->option_count; i++)
        lsf_string_add(&text, "define=%s\n", configuration->options[i]);
    bool good = !text.failed || lsf_error_set(error, LSF_ERROR_RENDER, "no memory left");
    good = good && lsf_file_write(path, text.text, text.length, error);
    free(text.text);
    return good;
}
