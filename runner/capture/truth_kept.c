#include "truth_kept.h"

#include "code/code_now.h"
#include "model/feeds.h"

/* As truths of one run are shared. */
static const char *shared_feed(const char *name)
{
    const fm_feed_info *feed = feed_info(feed_from_name(name));
    return feed != NULL && feed->is_of_rasteriser ? "" : name;
}

cache_key truth_key(fm_code *glsl, const fm_cache *cache, const truth_origin *origin)
{
    char scene[17];
    const char *const none[] = { NULL };
    const fm_code_places places = { .plugins = { "", "" }, .common = origin->common };
    cache_key key = cache_key_begin(cache, CACHE_TRUTH);
    code_guess(glsl, &places, none);
    settings_scene_hash(scene, origin->settings);
    cache_key_add_text(&key, scene);
    cache_key_add_text(&key, shared_feed(origin->feed));
    cache_key_add_text(&key, origin->caps->name);
    cache_key_add_number(&key, origin->driver);
    cache_key_add_number(&key, code_part(glsl, FM_CODE_SHADERS));
    return key;
}
