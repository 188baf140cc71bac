// After a method that emits from both ends: the front over the back.
void combine(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    vec4 front = fm_output[i];
    fm_output[i] = front + fm_output_back[i] * (1.0 - front.a);
}
