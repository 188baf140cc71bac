#include "list_markdown.h"

#include <string.h>

#include "model/feeds.h"
#include "plan/plan.h"

static const char *const keeps_words[] = {
    [FM_KEEPS_K_NEAREST] = "k nearest",
    [FM_KEEPS_ALL] = "all",
    [FM_KEEPS_NEAREST] = "the nearest",
    [FM_KEEPS_ALL_IN_K] = "all, in k places",
};
_Static_assert(sizeof keeps_words / sizeof keeps_words[0] == FM_KEEPS_COUNT, "one each");

/* Traits that say what a method is like; those that say what it gets wrong make up `image`. */
static const struct trait_words {
    uint32_t trait;
    const char *words;
} trait_words[] = {
    { FM_TRAIT_BOUNDED, "bounded" },
    { FM_TRAIT_SORTS_IN_RESOLVE, "sorts in resolve" },
    { FM_TRAIT_EMITS_BACK, "emits from the back" },
    { FM_TRAIT_EMITS_EITHER, "emits either way" },
    { FM_TRAIT_CONTROL, "control" },
    { 0 },
}, image_words[] = {
    { FM_TRAIT_EXACT, "exact" },
    { FM_TRAIT_APPROXIMATE, "approximate" },
    { FM_TRAIT_SORTED_INPUT, "needs sorted input" },
    { FM_TRAIT_RACY, "fragments race" },
    { FM_TRAIT_LOSES_TIES, "loses ties" },
    { FM_TRAIT_LOSES_DEPTH_ONE, "loses depth 1" },
    { FM_TRAIT_FLOOR, "none: the floor" },
    { 0 },
};

/* What goes before the next word: `before` if there were none. */
static const char *put_words(FILE *out, uint32_t traits, const struct trait_words *words,
                             const char *before)
{
    for (; words->trait != 0; words++) {
        if ((traits & words->trait) == 0)
            continue;
        fprintf(out, "%s%s", before, words->words);
        before = ", ";
    }
    return before;
}

void list_markdown_traits(FILE *out, uint32_t traits)
{
    put_words(out, traits, trait_words, put_words(out, traits, image_words, ""));
}

/* A citation with each "doi:..." as a link. */
static void put_citation(FILE *out, const char *text)
{
    const char *doi;
    while ((doi = strstr(text, "doi:")) != NULL) {
        const char *name = doi + 4;
        const int length = (int)strcspn(name, " ,;");
        fprintf(out, "%.*s[%.*s](https://doi.org/%.*s)", (int)(doi - text), text, length, name,
                length, name);
        text = name + length;
    }
    fputs(text, out);
}

static void put_feeds(FILE *out, const fm_method_desc *method)
{
    const char *feeds[FM_FEED_COUNT + 1];
    if (method_feeds(method) == FM_FEEDS_FRAGMENTS) {
        fputs("raster, compute", out);
        return;
    }
    const size_t count = feed_names(feeds, method_feeds(method));
    for (size_t i = 0; i < count; i++)
        fprintf(out, "%s%s", i > 0 ? ", " : "", feeds[i]);
}

static void put_row(FILE *out, const char *id, const fm_method_desc *method)
{
    const uint32_t traits = method->traits;
    fprintf(out, "| [`%s`](%s/README.md) | %s | ", id, id,
            method->title != NULL ? method->title : id);
    put_citation(out, method->citation != NULL ? method->citation : "");
    fprintf(out, " | %s | ", (traits & FM_TRAIT_FLOOR) != 0 ? "-" : keeps_words[method->keeps]);
    put_words(out, traits, image_words, "");
    fputs(" | ", out);
    put_words(out, traits, trait_words, "");
    fputs(" | ", out);
    put_feeds(out, method);
    fputs(" |\n", out);
}

void list_markdown(FILE *out, const fm_plugin_list *plugins)
{
    fputs("| id | title | paper | keeps | image | traits | feeds |\n"
          "|---|---|---|---|---|---|---|\n",
          out);
    for (size_t i = 0; i < plugins->count; i++)
        if (plugins->entries[i].plugin != NULL)
            put_row(out, plugins->entries[i].id, plugins->entries[i].plugin->method);
}
