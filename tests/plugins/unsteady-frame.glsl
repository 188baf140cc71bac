void frame(uvec2 pixel)
{
    if (pixel == uvec2(0u))
        frames[0]++; // one invocation alone
}
