void launch(uvec2 pixel)
{
    if (pixel == uvec2(0u))
        launches[0]++; // one invocation alone
}
