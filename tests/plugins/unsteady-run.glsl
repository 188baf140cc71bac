void run(uvec2 pixel)
{
    if (pixel == uvec2(0u))
        runs[0]++; // one invocation alone
}
