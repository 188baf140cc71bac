// The heap sort of sort_in_place.glsl in runs of a pass (FM_RESUMES), each within the loop iterations that
// the device allows, and before it the choice of the nearest `kept` of a pixel's `count` fragments: they
// come to the first places. The others stay, so that the pass may run again from its start. Steps of a
// pixel, numbered through, so that a run knows from its number where it goes on:
//   build    kept / 2       the first `kept` become a heap with the farthest at its root
//   choose   count - kept   each other one that is nearer than the root changes places with it
//   sort     kept - 1       the root changes places with the heap's last one, which leaves the heap
//   emit     kept
// A method may define, before it includes this:
#ifndef SORT_MOST
#define SORT_MOST N // the most that are kept
#endif
#ifndef SORT_SPENT
#define SORT_SPENT 0u // iterations of a run before it sorts
#endif
#ifndef SORT_ACCESS
#define SORT_ACCESS 0u // iterations of fragment_at() and put_fragment()
#endif

// A step sifts through each level of the heap, with three accesses at each and six besides.
uint steps_of_run()
{
    uint each = (uint(findMSB(uint(SORT_MOST))) + 3u) * (1u + 3u * SORT_ACCESS) + 6u * SORT_ACCESS;
    return (uint(FM_RUN_ITERATIONS) - min(SORT_SPENT, uint(FM_RUN_ITERATIONS) / 2u)) / each;
}

void heap_step(uvec2 pixel, uint step, uint count, uint kept)
{
    uint choose = kept / 2u, sort = choose + count - kept, root = 0u, end = kept;
    if (step < choose) {
        root = choose - 1u - step;
    } else {
        uint other = step < sort ? kept + step - choose : kept - 1u - (step - sort);
        uvec2 farthest = fragment_at(pixel, 0u), item = fragment_at(pixel, other);
        if (step >= sort || item.x < farthest.x) {
            put_fragment(pixel, 0u, item);
            put_fragment(pixel, other, farthest);
        }
        end = step < sort ? kept : other;
    }
    sift_down(pixel, root, end);
}

void emit_in_runs(uvec2 pixel, uint count, uint kept)
{
    uint emit = kept / 2u + count - kept + max(kept, 1u) - 1u, all = emit + kept;
    uint each = steps_of_run(), first = fm_run * each;
    FM_LOOP for (uint step = first; step < min(first + each, all); ++step) {
        if (step < emit) {
            heap_step(pixel, step, count, kept);
        } else {
            uint rank = FM_RANK(step - emit, kept);
            uvec2 fragment = fragment_at(pixel, rank);
            if (fragment.x != FM_EMPTY_BITS)
                fm_emit(pixel, int(rank), uintBitsToFloat(fragment.x), fragment.y);
        }
    }
    if (first + each < all)
        fm_go_on();
}
