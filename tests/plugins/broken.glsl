void resolve(uvec2 pixel)
{
    this_function_does_not_exist(pixel);
}
