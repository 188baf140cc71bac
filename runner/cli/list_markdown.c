#include "list_markdown.h"

#include <string.h>

#include "model/family.h"
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
static const uint32_t like_traits = FM_TRAIT_BOUNDED | FM_TRAIT_SORTS_IN_RESOLVE |
                                    FM_TRAIT_EMITS_BACK | FM_TRAIT_EMITS_EITHER | FM_TRAIT_CONTROL;
static const uint32_t image_traits = FM_TRAIT_EXACT | FM_TRAIT_APPROXIMATE | FM_TRAIT_SORTED_INPUT |
                                     FM_TRAIT_RACY | FM_TRAIT_LOSES_TIES |
                                     FM_TRAIT_PASSES_LOSE_TIES | FM_TRAIT_LOSES_DEPTH_ONE |
                                     FM_TRAIT_MULTISAMPLED | FM_TRAIT_FLOOR;

/* What goes before the next word: `before` if there were none. */
static const char *put_words(FILE *out, uint32_t traits, const char *before)
{
    for (unsigned bit = 0; trait_words(bit) != NULL; bit++) {
        if ((traits & 1u << bit) == 0)
            continue;
        fprintf(out, "%s%s", before, trait_words(bit));
        before = ", ";
    }
    return before;
}

void list_markdown_traits(FILE *out, uint32_t traits)
{
    put_words(out, traits & like_traits, put_words(out, traits & image_traits, ""));
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
    put_words(out, traits & image_traits, "");
    fputs(" | ", out);
    put_words(out, traits & like_traits, "");
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
