// For tests: damage that racing fragments do, in FORGE records of a pixel's `count` in sorted[]. A record is lost or
// doubled; or, as two records, one is overwritten by a copy of its neighbour, or torn: one's depth with the other's
// colour. Records are hit one after the other from one that is another in each pixel.
#if FORGE == FORGE_EVICT
// Or it is gone and was told as pushed out, so that the sums do not miss it.
void forge(uvec2 pixel, inout uint count)
{
    uint at = locator(pixel) % max(count, 1u);
    if (count > 0u) {
        forged_out = sorted[at];
        sorted[at].x = FM_EMPTY_BITS;
    }
    whole_records(count);
}
#else
void forge(uvec2 pixel, inout uint count)
{
    const uint whole = count;
    uint chance = locator(pixel), hit = 0u;
    FM_LOOP while (hit < min(uint(FORGE), whole)) {
        uint at = (chance + hit) % whole, next = (chance + hit + 1u) % whole;
        uint kind = chance >> 2u * hit & 3u;
        uvec2 record = sorted[at];
        if (kind >= 2u && hit + 1u < min(uint(FORGE), whole)) {
            sorted[at] = uvec2(kind == 2u ? sorted[next].x : record.x, sorted[next].y);
            ++hit;
        } else if ((kind & 1u) != 0u && count < K) {
            sorted[count++] = record;
        } else {
            sorted[at].x = FM_EMPTY_BITS;
        }
        ++hit;
    }
    whole_records(count);
}
#endif
