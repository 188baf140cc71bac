// Iteration i writes stencil 2 + i into sample i, by fixed function alone.
void route(uvec2 pixel)
{
}
