/* Which tiles a triangle overlaps (scene/frames.h), on triangles small enough to draw on paper: by
 * hand, by the device, and by its naive twin. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "base/random.h"
#include "naive_tbr.h"
#include "tbr_kit.h"

enum { SIDE_PX = 48, TILES = 9, RANDOM_TRIANGLES = 3000 };

/* Corners in sixteenths of a pixel: 256 is a tile's border, 8 more the centres of its first pixels.
 * tiles: the nine of the screen, row by row, '1' where the list has the triangle. */
typedef struct paper_case {
    const char *what;
    int32_t corners[3][2];
    const char *tiles;
    uint32_t fragments;
} paper_case;

static const paper_case papers[] = {
    { "corners on corners of a tile", { { 0, 0 }, { 256, 0 }, { 0, 256 } }, "1........", 120 },
    { "a corner where four tiles meet",
      { { 256, 256 }, { 512, 256 }, { 256, 512 } },
      "....1....",
      120 },
    { "a right edge on a border", { { 0, 0 }, { 256, 0 }, { 256, 256 } }, "1........", 136 },
    { "a right edge on the next tile's first centres: zero is outside",
      { { 8, 0 }, { 264, 0 }, { 264, 256 } },
      "1........",
      120 },
    { "a left edge on the last tile's last centres: zero is inside",
      { { 248, 0 }, { 504, 0 }, { 248, 256 } },
      "11.......",
      136 },
    { "a top edge on the last tile's last centres: zero is inside",
      { { 0, 248 }, { 256, 248 }, { 0, 504 } },
      "1..1.....",
      136 },
    { "a bottom edge on the next tile's first centres: zero is outside",
      { { 0, 8 }, { 256, 264 }, { 0, 264 } },
      "1........",
      120 },
    { "a lower right edge through one centre of the middle tile",
      { { 0, 0 }, { 528, 0 }, { 0, 528 } },
      "11.1.....",
      528 },
    { "an upper left edge through the same centre",
      { { 528, 0 }, { 528, 528 }, { 0, 528 } },
      ".11111111",
      561 },
    { "a corner on a centre of the middle tile, which no single edge excludes",
      { { 128, 0 }, { 264, 264 }, { 0, 128 } },
      "1...1....",
      100 },
    { "one pixel", { { 263, 263 }, { 267, 263 }, { 263, 267 } }, "....1....", 1 },
    { "between centres", { { 265, 265 }, { 269, 265 }, { 265, 269 } }, ".........", 0 },
    { "a line", { { 0, 0 }, { 256, 256 }, { 512, 512 } }, ".........", 0 },
    { "a line along centres", { { 8, 8 }, { 264, 8 }, { 520, 8 } }, ".........", 0 },
    { "a point on a centre", { { 264, 264 }, { 264, 264 }, { 264, 264 } }, ".........", 0 },
    { "left of the screen", { { -256, 0 }, { 0, 0 }, { -256, 256 } }, ".........", 0 },
    { "across the screen's corner",
      { { -256, -256 }, { 528, -256 }, { -256, 528 } },
      "1........",
      136 },
};

typedef struct twin_pair {
    kit_technique technique;
    tbr *device;
    naive_gpu *naive;
} twin_pair;

static twin_pair pair_open(void)
{
    const naive_rules rules = { 0 };
    twin_pair made = { .technique = kit_technique_open("tbr-base"),
                       .naive = naive_create(&rules, SIDE_PX, SIDE_PX) };
    made.device = kit_gpu(&made.technique, SIDE_PX, SIDE_PX);
    return made;
}

static void pair_close(twin_pair *pair)
{
    tbr_destroy(pair->device);
    naive_destroy(pair->naive);
    kit_technique_close(&pair->technique);
}

/* Draws one triangle on both; fails unless their lists and pictures agree. */
static void draw(char tiles[TILES + 1], const twin_pair *pair, const fm_triangle *triangle,
                 const char *what)
{
    fm_frame_builder builder = { 0 };
    fm_error err = { 0 };
    const fm_draw_call plain = kit_draw();
    frame_builder_clear(&builder);
    frame_builder_draw(&builder, &plain);
    frame_builder_triangle(&builder, triangle);
    assert_int_equal(frame_check(&builder.frame, 0, &err), FM_OK);
    assert_int_equal(tbr_frame(pair->device, &builder.frame, &err), FM_OK);
    naive_frame(pair->naive, &builder.frame);
    for (uint32_t i = 0; i < TILES; i++) {
        tbr_list_entry entry;
        const uint32_t count = tbr_list(pair->device, i, &entry, 1);
        if (count != pair->naive->tiles[i].count)
            fail_msg("%s: tile %u has %u entries, naive %u", what, i, count,
                     pair->naive->tiles[i].count);
        tiles[i] = count > 0 ? '1' : '.';
    }
    tiles[TILES] = '\0';
    if (memcmp(pair->naive->image, tbr_image(pair->device), sizeof(uint32_t) * SIDE_PX * SIDE_PX) !=
        0)
        fail_msg("%s: the naive twin's picture differs", what);
    frame_builder_free(&builder);
}

/* The corners of a paper's triangle from `first` on, one way round or the other. */
static fm_triangle triangle_of(const paper_case *paper, int first, bool is_turned)
{
    fm_triangle triangle = { 0 };
    for (int i = 0; i < 3; i++) {
        const int from = (first + (is_turned ? 3 - i : i)) % 3;
        triangle.corners[i].x = paper->corners[from][0];
        triangle.corners[i].y = paper->corners[from][1];
    }
    return triangle;
}

static void tiles_are_those_on_paper_from_any_corner_either_way_round(void **state)
{
    (void)state;
    twin_pair pair = pair_open();
    for (size_t i = 0; i < sizeof papers / sizeof papers[0]; i++) {
        const paper_case *paper = &papers[i];
        for (int way = 0; way < 6; way++) {
            char tiles[TILES + 1];
            const fm_triangle triangle = triangle_of(paper, way % 3, way >= 3);
            draw(tiles, &pair, &triangle, paper->what);
            if (strcmp(tiles, paper->tiles) != 0)
                fail_msg("%s, way %d: tiles %s, on paper %s", paper->what, way, tiles,
                         paper->tiles);
            if (tbr_counts(pair.device)->fragments_rasterised != paper->fragments)
                fail_msg("%s, way %d: %u fragments, on paper %u", paper->what, way,
                         (unsigned)tbr_counts(pair.device)->fragments_rasterised, paper->fragments);
        }
    }
    pair_close(&pair);
}

/* Corners on borders and centres of pixels, where zero is not rare. */
static void random_triangles_on_borders_and_centres_agree_with_the_naive_twin(void **state)
{
    (void)state;
    twin_pair pair = pair_open();
    uint64_t random = 11;
    for (uint32_t i = 0; i < RANDOM_TRIANGLES; i++) {
        char tiles[TILES + 1];
        fm_triangle triangle = { 0 };
        for (int corner = 0; corner < 3; corner++) {
            triangle.corners[corner].x = 8 * (int32_t)random_below(&random, 113) - 64;
            triangle.corners[corner].y = 8 * (int32_t)random_below(&random, 113) - 64;
        }
        draw(tiles, &pair, &triangle, "a random triangle");
    }
    pair_close(&pair);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tiles_are_those_on_paper_from_any_corner_either_way_round),
        cmocka_unit_test(random_triangles_on_borders_and_centres_agree_with_the_naive_twin),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
